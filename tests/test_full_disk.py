"""A disk that is full costs what was to be written, and leaves no half of it."""

import sys

import pytest

from conftest import ROOT, need, run_copy
from labkit.base import store
from labkit.lesson.day import find_day

pytestmark = [
    pytest.mark.kit,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs a limit"),
]
# No file may be larger: what a full disk is for whoever writes one.
LIMITED = """
import resource, runpy, sys
sys.argv = {words!r}
sys.path.insert(0, "scripts")
resource.setrlimit(resource.RLIMIT_FSIZE, ({most}, {most}))
runpy.run_path(sys.argv[0], run_name="__main__")
"""


def limited(clone, most, *words):
    """Run a script of a copy of the kit where no file may be larger."""
    return run_copy(clone, "-c", LIMITED.format(words=[*map(str, words)], most=most))


def test_a_day_is_begun_whole_or_not_at_all(clone):
    day = find_day(1, clone)
    done = limited(clone, 1000, "scripts/start_day.py", 1)
    assert done.returncode == 2
    assert day.script in done.stderr
    assert not any(day.work.parent.glob("day1*"))
    assert run_copy(clone, "scripts/start_day.py", 1).returncode == 0
    before = day.work.read_bytes()
    done = limited(clone, 1000, "scripts/start_day.py", 1, "--reset", "1.2")
    assert done.returncode == 2
    assert day.work.read_bytes() == before
    assert [path.name for path in day.work.parent.glob("day1*")] == [day.script]


def test_an_edition_is_written_whole_or_not_at_all(tmp_path):
    need((ROOT / ".git").exists(), "the kit as a git repository")
    out = tmp_path / "edition"
    done = limited(ROOT, 20_000, "scripts/edition.py", out)
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert not out.exists()
    assert run_copy(ROOT, "scripts/edition.py", out).returncode == 0
    before = {path: path.read_bytes() for path in out.rglob("*.py")}
    assert limited(ROOT, 20_000, "scripts/edition.py", out).returncode == 2
    assert {path: path.read_bytes() for path in out.rglob("*.py")} == before
    assert run_copy(ROOT, "scripts/edition.py", out).returncode == 0


def test_a_file_is_replaced_whole_and_named_where_it_cannot_be(tmp_path, monkeypatch):
    path = tmp_path / "x"
    path.write_text("old")
    monkeypatch.setattr(store.os, "fsync", lambda _: 1 / 0)
    path.chmod(0o600)
    with pytest.raises(ZeroDivisionError):
        store.replace(path, b"new", sync=True)
    monkeypatch.undo()
    (tmp_path / "y.new").mkdir()
    with pytest.raises(OSError, match="y") as caught:
        store.replace(tmp_path / "y", b"new")
    assert caught.value.filename == str(tmp_path / "y")
    assert path.read_text() == "old"
