"""A practice file that has a module's name: one line says so, and the lab runs."""

import subprocess
import sys

import pytest

from conftest import environment_of, run_copy
from labkit.lesson.clash import clashes
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit

SAYS = " has the name of a Python module, so one can be imported in place of the other."
NAMES = ("random.py", "numpy.py", "json.py", "mujoco.py", "inspect.py", "types.py")
OWN = "w1-foundations/work/"


@pytest.fixture
def solved(one_day):
    """A clone whose student has written all of Day 1, beside practice files."""
    assert run_copy(one_day, "scripts/start_day.py", "1").returncode == 0
    day = find_day(1, one_day)
    day.work.write_bytes(day.source.read_bytes())
    for name in NAMES:
        (day.work.parent / name).write_text("colour = 'red'\n")
    return day


def named(stderr):
    """Return the files that notes name; there is no other line."""
    lines = stderr.splitlines()
    assert all(line.startswith(f"note: {OWN}") and SAYS in line for line in lines)
    return [line.removeprefix(f"note: {OWN}").partition(" ")[0] for line in lines]


def test_check_and_run_pass_and_name_the_files(one_day, solved):
    run = run_copy(one_day, "scripts/run_day.py", "1", "--no-log")
    assert run.returncode == 0, run.stderr
    assert named(run.stderr) == sorted(NAMES)
    check = run_copy(one_day, "scripts/check_day.py", "1", "--task", "1.4")
    assert check.returncode == 0, check.stdout
    assert named(check.stderr) == sorted(NAMES)
    assert "Rename your file, for example to my_random.py." in check.stderr


def test_a_lab_that_is_started_by_itself_runs_too(one_day, solved):
    done = run_copy(one_day, solved.work, "--no-log")
    assert done.returncode == 0, done.stderr
    assert "PASS" in done.stdout


def test_a_helper_of_ones_own_is_still_found(one_day, solved):
    solved.work.with_name("my_helper.py").write_text("HALF = 0.5\n")
    text = solved.work.read_text("utf-8")
    solved.work.write_text(
        text.replace("import kit", "import kit\nimport my_helper", 1)
    )
    assert run_copy(one_day, solved.work, "--no-log").returncode == 0


def test_an_import_that_fails_sends_nobody_to_make_check(one_day, solved):
    text = solved.work.read_text("utf-8")
    text = text.replace("import numpy as np", "from random import colour", 1)
    solved.work.write_text(text)
    done = run_copy(one_day, solved.work)
    assert done.returncode == 1
    where, what, *others = done.stderr.splitlines()
    assert "line 12, in <module>: from random import colour" in where
    assert what.startswith("ImportError: cannot import name 'colour'")
    assert any(f"{OWN}random.py{SAYS}" in line for line in others)
    assert "make check" not in done.stderr


def test_the_doctor_names_them(one_day, solved):
    code = "from labkit.commands import doctor; print(doctor.check_names({!r}))"
    done = subprocess.run(
        [sys.executable, "-c", code.format(sys.executable)],
        cwd=one_day,
        env=environment_of(one_day),
        capture_output=True,
        text=True,
        check=True,
    )
    assert "status='todo'" in done.stdout
    assert all(f"{OWN}{name}" in done.stdout for name in NAMES)


def test_what_labs_and_people_call_their_files_is_no_clash(tmp_path):
    for name in ("kit", "day1_transforms", "my_random", "practice", "tests", "metrics"):
        (tmp_path / f"{name}.py").touch()
    (tmp_path / "random").mkdir()  # without __init__.py it hides nothing
    assert clashes(tmp_path) == []
    (tmp_path / "scipy").mkdir()
    (tmp_path / "scipy" / "__init__.py").touch()
    (tmp_path / "labkit.py").touch()
    assert [path.name for path in clashes(tmp_path)] == ["labkit.py", "scipy"]
    assert clashes(tmp_path / "nowhere") == []
