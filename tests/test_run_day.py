"""Running a lab, one's own or the kit's, and a week; the kit's is known as such."""

import pytest
from restored import Restored

from conftest import copy_kit, keep_first_day, run_copy
from labkit.lesson.day import days_of, find_day
from labkit.lesson.starter import is_kits, require_kits
from robo47.errors import Robo47Error
from robo47.paths import ROOT

pytestmark = pytest.mark.kit

RUN, WEEK, START = "scripts/run_day.py", "scripts/run_week.py", "scripts/start_day.py"


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """Return a copy of the kit with its first day alone, put back after each test."""
    return Restored(keep_first_day(copy_kit(tmp_path_factory.mktemp("kit") / "clone")))


@pytest.fixture
def day(clone):
    return find_day(1, clone)


def test_ones_own_lab_runs_and_not_a_module_beside_it(run_in, day):
    day.work.parent.mkdir()
    day.work.write_text("import sys\nprint('the lab', sys.argv[1:])\n")
    day.work.with_name("day1_helpers.py").write_text("print('a helper')\n")
    done = run_in(RUN, "1", "--no-log")
    assert (done.returncode, done.stdout) == (0, "the lab ['--no-log']\n")


def test_a_lab_that_is_not_begun_is_told_with_the_command(run_in, day):
    done = run_in(RUN)
    assert done.returncode == 2
    assert done.stderr.endswith("is not there; first: make start DAY=1\n")


@pytest.mark.parametrize(
    ("command", "says"),
    [
        ((RUN, "0"), "there is no day 0 yet"),
        ((RUN, "46"), "there is no day 46 yet"),
        ((WEEK, "7"), "there is no week 7 yet"),
        (("scripts/check_day.py", "1", "--task", "2.1"), "2.1 is of day 2, not of"),
        ((START, "0"), "there is no day 0 yet"),
        (("scripts/check_day.py", "0"), "there is no day 0 yet"),
        (("scripts/report_metrics.py", "--day", "99"), "there is no day 99 yet"),
        ((RUN, "x"), "'x' is no day; expected its number"),
        (("scripts/borrow.py", "1.1", "--day", "x"), "'x' is no day"),
    ],
)
def test_what_is_not_there_is_refused_by_all_in_one_line(command, says):
    done = run_copy(ROOT, *command)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert says in done.stderr


@pytest.mark.parametrize(
    "command", [(RUN, "1"), ("scripts/check_day.py", "1"), (START, "--reset", "1.1")]
)
def test_an_empty_file_is_told_how_to_begin(run_in, day, command):
    day.work.parent.mkdir()
    day.work.write_text("\n")
    done = run_in(*command)
    assert done.returncode == 2
    assert "is empty. Delete it, then: make start DAY=1" in done.stderr


def test_a_bug_is_three_lines_with_the_command_that_names_it(run_in, day):
    assert run_in(START, "1").returncode == 0
    text = day.source.read_text("utf-8").replace("make_T(R.T, -R.T @ t)", "R.t")
    day.work.write_text(text, "utf-8")
    day.work.with_name("kit.py").unlink()  # and comes back
    done = run_in(RUN, "1", "--no-log")
    where, what, remedy = done.stderr.splitlines()
    assert done.returncode == 1
    assert "in inverse: return R.t" in where
    assert what.startswith("AttributeError: ")
    assert remedy.endswith("make check DAY=1")


def test_the_exit_code_is_the_labs(run_in, day):
    day.work.parent.mkdir()
    day.work.write_text("raise SystemExit(1)\n")
    assert run_in(RUN, "1").returncode == 1


OTHERS = ["", "print('the handout')\n", "\xff", None]


@pytest.mark.parametrize("text", OTHERS)
def test_a_script_that_is_not_the_kits_is_refused_in_a_line(run_in, day, text):
    if text is None:
        day.source.unlink()
    else:
        day.source.write_text(text, "latin-1")
    assert not is_kits(day)
    for command in ((RUN, "1", "--kit"), (START, "1"), (START, "--reset", "1.1")):
        done = run_in(*command)
        assert done.returncode == 2
        assert "is not the kit's" in done.stderr
        assert "git checkout -- w1-foundations/src/day1_transforms.py" in done.stderr
        assert done.stderr.count("\n") == 1
    assert not day.work.exists()


def test_the_kits_own_is_the_kits(day):
    require_kits(day)
    text = day.source.read_text("utf-8").replace("# region 1.8", "#", 1)
    day.source.write_text(text, "utf-8")
    with pytest.raises(
        Robo47Error,
        match=r"py, line \d+: endregion 1\.8, but no region is open\. Do you write",
    ):
        require_kits(day)


def test_the_week_is_one_table_of_numbers_and_limits(run_in, day):
    log = day.folder.parent / "metrics" / "metrics.csv"
    before = log.read_bytes()
    done = run_in(WEEK, "1")
    assert done.returncode == 0, done.stderr
    head, *lines, end = done.stdout.splitlines()
    assert head.split() == ["day", "whose", "check", "number", "limit"]
    assert end == f"PASS  1 lab, {len(lines)} numbers within their limits"
    assert len(lines) == sum(len(one.metrics) for one in days_of(day.week))
    assert all("kit's" in line and line.endswith("PASS") for line in lines)
    assert max(map(len, done.stdout.splitlines())) <= 80
    assert log.read_bytes() == before, "a look at the week is no record"


def test_the_week_shows_that_ones_own_lab_fails(run_in, day):
    assert run_in(START, "1").returncode == 0
    done = run_in(WEEK, "1")
    assert done.returncode == 1
    assert done.stdout.count("yours") == done.stdout.count("none") == len(day.metrics)
    assert "make run DAY=1" in done.stdout


def test_starting_brings_the_file_that_lets_any_python_run_the_lab(run_in, day):
    assert run_in(START, "1").returncode == 0
    assert day.work.with_name("kit.py").read_bytes() == (
        day.source.with_name("kit.py").read_bytes()
    )
    assert day.work.with_name("Makefile").read_bytes() == (
        (day.folder / "Makefile").read_bytes()
    )
    again = run_in(START, "1")
    assert "stays as it is" in again.stdout
    assert "move that file away" in again.stdout


def test_a_reset_keeps_the_files_line_ends(run_in, day):
    assert run_in(START, "1").returncode == 0
    mine = day.work.read_text("utf-8").replace("\n", "\r\n")
    day.work.write_text(mine, "utf-8", newline="")
    assert run_in(START, "--reset", "1.2").returncode == 0
    text = day.work.read_bytes()
    assert text.count(b"\r\n") == text.count(b"\n") > 0
