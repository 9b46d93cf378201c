"""The kit's memory on the student's machine: kept whole, and never in the way."""

import pytest

from labkit.base import store


def test_what_is_remembered_is_read_back(tmp_path):
    store.write("a.json", {"1.1": 2}, tmp_path)
    store.write("a.json", {"1.1": 3}, tmp_path)
    store.add_lines("b", ["one"], tmp_path)
    store.add_lines("b", ["two"], tmp_path)
    assert store.read("a.json", tmp_path) == {"1.1": 3}
    assert store.read_text("b", tmp_path) == "one\ntwo\n"
    assert {path.name for path in (tmp_path / ".robo47").iterdir()} == {"a.json", "b"}


@pytest.mark.parametrize("text", ["", "{", "[1]", "null", "\ufeff{}", "[" * 100_000])
def test_what_cannot_be_read_is_forgotten(tmp_path, text):
    store.write_text("a.json", text, tmp_path)
    assert store.read("a.json", tmp_path) == {}


def test_a_folder_that_cannot_be_written_costs_the_memory_alone(tmp_path):
    (tmp_path / ".robo47").write_text("a file in the way")
    store.write("a.json", {"1.1": 2}, tmp_path)
    store.add_lines("b", ["one"], tmp_path)
    assert store.read("a.json", tmp_path) == {}
    assert store.read_text("b", tmp_path) == ""
