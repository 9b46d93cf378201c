"""The generated class as a program: what it refuses, it refuses in one line."""

import pytest
from make_class import main

USAGE = "usage: python tests/make_class.py FOLDER STUDENTS"


@pytest.mark.parametrize(
    "arguments",
    [[], ["clones"], ["clones", "many"], ["clones", "-1"], ["clones", "2", "3"]],
)
def test_a_command_line_that_it_cannot_read_ends_in_one_line(
    arguments, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert str(ended.value).startswith(USAGE)  # Python prints it and exits with 1
    assert "\n" not in str(ended.value)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_with_files_is_left_alone(tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(SystemExit) as ended:
        main([str(tmp_path), "2"])
    assert "new or an empty folder" in str(ended.value)
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_it_prints_who_is_in_the_class(tmp_path, capsys):
    main([str(tmp_path / "clones"), "2"])
    assert capsys.readouterr().out.startswith("right: ")
    assert len(list((tmp_path / "clones").iterdir())) == 2
