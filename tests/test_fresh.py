"""A clone of the last commit gives the same numbers, or it is said what it lacks."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import replace
from functools import partial

import pytest
from restored import Restored

from conftest import ROOT, SKIPPED, copy_kit, keep_first_day, need, run_copy
from labkit.commands import fresh as command
from labkit.fresh import clone as cloning
from labkit.fresh.compare import faults, same
from labkit.fresh.missing import findings
from labkit.lesson.day import find_day
from labkit.lesson.metric import Metric
from labkit.report.series import Series, series_of
from labkit.report.week_labs import LabResult
from robo47.errors import Robo47Error

FRESH = "scripts/fresh.py"
WEEK = "w1-foundations"
BLANK = re.compile(r"\*\(your \w+\)\*")
DIARY = "# Mine\n<!-- numbers -->\n{}\n<!-- end -->\n"
TWO = "1. *(your words)*\n\n2. Mine.\n"
WHO = {
    f"GIT_{r}_{f}": "a@b" for r in ("AUTHOR", "COMMITTER") for f in ("NAME", "EMAIL")
}


def git(folder, *words):
    subprocess.run(["git", *words], cwd=folder, env={**os.environ, **WHO}, check=True)


def commit(folder):
    git(folder, "add", "-A")
    git(folder, "commit", "-qm", "x")


def hand_in(day):
    """Fill a day's worksheet and the week's retrospective in, and draw its figure."""
    if day.worksheet:
        sheet = day.folder / day.worksheet
        sheet.write_text(BLANK.sub("mine", sheet.read_text("utf-8")), "utf-8")
    if day.figure:
        (day.folder / day.figure).parent.mkdir(exist_ok=True)
        (day.folder / day.figure).write_bytes(b"x")
    for diary in (day.folder / "docs").glob("RETRO_*.md"):
        diary.write_text(DIARY.format("| 1 |") + "mine\n", "utf-8")


@pytest.fixture(scope="module")
def handed_in(tmp_path_factory):
    """A student's clone with the day solved, its sheets filled in, all committed."""
    clone = keep_first_day(copy_kit(tmp_path_factory.mktemp("kit") / "clone"))
    for name in (".gitignore", "pyproject.toml", "constraints.txt"):
        (clone / name).write_bytes((ROOT / name).read_bytes())
    day = find_day(1, clone)
    day.work.parent.mkdir()
    for name in ("kit.py", day.script):
        text = day.source.with_name(name).read_text("utf-8")
        day.work.with_name(name).write_text(text + "# mine\n", "utf-8")
    hand_in(day)
    git(clone, "init", "-q")
    git(clone, "config", "core.autocrlf", "false")
    assert run_copy(clone, "scripts/run_day.py", "1").returncode == 0
    commit(clone)
    return Restored(clone)


@pytest.fixture
def student(handed_in):
    """That clone, as it was then."""
    return handed_in.put_back()


@pytest.fixture(scope="module")
def without_code(handed_in, tmp_path_factory):
    """The same week alone, in a repository of its own: a tenth of the files."""
    clone, whole = tmp_path_factory.mktemp("week") / "clone", handed_in.put_back()
    for name in (WEEK, "metrics"):
        shutil.copytree(whole / name, clone / name, ignore=SKIPPED)
    shutil.copytree(whole / WEEK / "work", clone / WEEK / "work")
    shutil.copy(whole / ".gitignore", clone)
    git(clone, "init", "-q")
    git(clone, "config", "core.autocrlf", "false")
    commit(clone)
    return Restored(clone)


@pytest.fixture
def run_in(student):
    """Run a script of that copy as the student would."""
    return partial(run_copy, student)


@pytest.fixture
def lacks(student, tmp_path):
    """Return what a clone of the student's last commit lacks."""

    def look(*later):
        sha, into = cloning.head_of(student), tmp_path / "fresh"
        if not into.exists():
            cloning.clone_commit(sha, into, student)
        return findings([find_day(1, into), *later], into, student)

    return look


@pytest.mark.parametrize(
    ("before", "now", "equal"),
    [
        (3e-15, 9e-11, True),  # rounding: within its limit, and that was asked before
        (0.0, 0.0, True),
        (4.7, 9.3, True),
        (4.7, 9.5, False),
        (4.7, 2.3, False),
        (1e-9, 0.0, False),
        (0.5, float("nan"), False),
    ],
)
def test_a_number_is_the_same_within_a_factor_of_two(before, now, equal):
    assert same(before, now) == equal


def ran(day, value, *, mine=False):
    metric = day.metrics[0]
    number = Series(1, metric)
    number.add({"value": value, "n_failures": 0, "n_trials": 1, "notes": ""})
    return LabResult(replace(day, metrics=(metric,)), mine, [number], "")


def test_the_kits_own_numbers_have_no_row_and_must_pass(clone):
    day = find_day(1, clone)
    assert faults(ran(day, 1e-15), clone) == []
    (fault,) = faults(ran(day, 0.5), clone)
    assert "0.5 in the clone; it must be under" in fault
    (fault,) = faults(ran(day, 1e-15, mine=True), clone)
    assert "no committed row of this file" in fault
    other = replace(day, metrics=(Metric("gone", "x", max=1.0),))
    (fault,) = faults(LabResult(other, False, series_of(other, []), ""), clone)
    assert "recorded no such number" in fault
    (fault,) = faults(LabResult(day, True, [], "to do: 1.4"), clone)
    assert fault == "day 1, the lab does not pass: to do: 1.4"


def test_without_a_commit_it_cannot_run(tmp_path):
    with pytest.raises(Robo47Error, match="git rev-parse"):
        cloning.head_of(tmp_path)


@pytest.mark.kit
class TestWhatIsMissing:
    @pytest.fixture
    def student(self, without_code):
        return without_code.put_back()

    def test_is_nothing_where_all_is_committed(self, lacks):
        assert lacks() == []

    def test_is_what_git_does_not_have(self, student, lacks):
        (student / WEEK / "work" / "notes.txt").write_text("x")
        (student / WEEK / "docs" / "day1.md").write_text("x")
        assert lacks() == [
            f"{WEEK}/docs/day1.md: changed since the commit",
            f"{WEEK}/work/notes.txt: not committed",
        ]

    def test_is_a_figure_that_git_ignores(self, student, lacks):
        with (student / ".gitignore").open("a") as file:
            file.write("day1*.png\n")
        day = find_day(1, student)
        git(student, "rm", "-q", "--cached", f"{WEEK}/{day.figure}")
        commit(student)
        (line,) = lacks()
        assert line.startswith(f"{WEEK}/{day.figure}: ignored by git (.gitignore, line")

    def test_is_a_module_that_the_script_imports(self, student, lacks):
        day = find_day(1, student)
        text = day.work.read_text("utf-8")
        counts = "def counted():\n    n = 0\n    def more():\n        nonlocal n\n"
        day.work.write_text(f"from helper import x\n{text}{counts}", "utf-8")
        commit(student)
        day.work.with_name("helper.py").write_text("x = 1\n")
        found = f"{WEEK}/work/helper.py: {day.script} imports it; not in the commit"
        assert lacks() == [found]

    def test_is_what_nobody_drew_or_wrote(self, student, lacks):
        day = find_day(1, student)
        git(student, "rm", "-q", f"{WEEK}/{day.figure}")
        with (day.folder / day.worksheet).open("a") as file:
            file.write("*(your words)*\n\n   *(your answer)*\nnot *(this)* one\n")
            file.write("*(see the photo above)*\n")
            file.write("| sag | 19 | *(your number)* | *(your reason)* |\n")
        (day.folder / "docs" / "RETRO_w1.md").write_text(DIARY.format("| 1 |") + TWO)
        commit(student)
        assert lacks() == [
            f"{WEEK}/docs/RETRO_w1.md: 1 place still to fill in",
            f"{WEEK}/docs/day1.md: 4 places still to fill in",
            f"{WEEK}/{day.figure}: not there; day 1 hands it in",
        ]

    def test_is_told_in_one_round_whatever_is_not_committed_yet(self, student, lacks):
        diary = student / WEEK / "docs" / "RETRO_w1.md"
        diary.write_text(DIARY.format("") + TWO)
        assert lacks() == [
            f"{WEEK}/docs/RETRO_w1.md: 1 place still to fill in",
            f"{WEEK}/docs/RETRO_w1.md: changed since the commit",
            f"{WEEK}/docs/RETRO_w1.md: its numbers are not filled in yet; make report",
        ]

    def test_is_not_what_make_report_filled_in_since(self, student, lacks):
        diary = student / WEEK / "docs" / "RETRO_w1.md"
        diary.write_text(DIARY.format("| 2 |") + "mine\n", "utf-8")
        assert lacks() == []

    def test_is_the_weeks_numbers_at_its_end_alone(self, student, lacks):
        diary = student / WEEK / "docs" / "RETRO_w1.md"
        diary.write_text(DIARY.format("") + "mine\n", "utf-8")
        commit(student)
        diary.write_text(DIARY.format("| 1 |") + "mine\n", "utf-8")
        said = f"{WEEK}/docs/RETRO_w1.md: its numbers are not committed yet"
        assert lacks() == [said]
        assert lacks(find_day(2)) == []  # a day is still to come

    def test_is_no_sheet_of_a_day_that_is_not_begun(self, student, lacks):
        git(student, "rm", "-rq", f"{WEEK}/work", f"{WEEK}/docs/day1.md")
        (student / WEEK / "docs" / "RETRO_w1.md").write_text(DIARY.format("") + TWO)
        commit(student)
        assert lacks() == []

    def test_is_a_path_that_only_this_machine_has(self, student, lacks):
        day = find_day(1, student)
        with day.work.open("a") as file:
            file.write(
                'A = "/home/ada/a.csv"\nB = "C:\\\\Users\\\\a"\nC = "m/s"\nD = "/"\n'
            )
        with (day.folder / day.worksheet).open("a") as file:
            file.write("![me](/home/ada/me.png) ![ok](../figures/me.png)\n")
        commit(student)
        code, other, sheet = lacks()
        assert "'/home/ada/a.csv' is a path of this machine alone" in code
        assert r"'C:\\Users\\a'" in other
        assert sheet.startswith(f"{WEEK}/docs/day1.md, line ")


@pytest.mark.kit
class TestTheCommand:
    def test_passes_where_the_clone_gives_the_same_numbers(self, student, run_in):
        before = (student / "metrics" / "metrics.csv").read_bytes()
        done = run_in(FRESH, "--quick")
        assert done.returncode == 0, done.stdout + done.stderr
        last = done.stdout.splitlines()[-1]
        assert last.startswith("PASS  a clone of your last commit gives your numbers: ")
        assert (student / "metrics" / "metrics.csv").read_bytes() == before

    def test_fails_where_a_committed_row_says_something_else(self, student, run_in):
        log = student / "metrics" / "metrics.csv"
        rows = log.read_text("utf-8").splitlines(keepends=True)
        log.write_text("".join(rows[:-1]), "utf-8")
        commit(student)
        done = run_in(FRESH, "--quick")
        assert done.returncode == 1
        assert "no committed row of this file" in " ".join(done.stdout.split())
        assert done.stdout.splitlines()[-1].startswith("FAIL  1 thing to fix")

    def test_fails_where_the_committed_file_is_wrong(self, student, run_in):
        day = find_day(1, student)
        right = day.work.read_text("utf-8")
        day.work.write_text("raise SystemExit('error: half a thought')\n")
        commit(student)
        day.work.write_text(right, "utf-8")
        done = run_in(FRESH, "--quick")
        text = " ".join(done.stdout.split())
        assert done.returncode == 1
        assert "does not pass: error: half a thought" in text
        assert "day1_transforms.py: changed since the commit" in text

    def test_runs_the_kits_labs_where_nothing_is_begun(self, student, run_in):
        git(student, "rm", "-rq", f"{WEEK}/work")
        commit(student)
        done = run_in(FRESH, "--quick")
        assert done.returncode == 0, done.stdout + done.stderr
        assert "the kit's own; there are no rows to compare" in done.stdout

    def test_takes_the_week_that_was_begun_last_whichever_it_is(self, student, run_in):
        toy = "day46_toy.py"
        shutil.copytree(ROOT / "tests" / "toyday" / "w9-toy", student / "w9-toy")
        (student / "w9-toy" / "work").mkdir()
        for name in ("kit.py", toy):
            copy = student / "w9-toy" / "work" / name
            copy.write_bytes((student / "w9-toy" / "src" / name).read_bytes() + b"#\n")
        hand_in(find_day(46, student))
        assert run_in("scripts/run_day.py", "46").returncode == 0
        run_in("scripts/check_day.py", "46")  # the report itself runs nothing
        report = run_in("scripts/report_metrics.py")
        assert "wrote metrics/report-week9.html" in report.stdout
        page = (student / "metrics" / "report-week9.html").read_text("utf-8")
        assert "toy_right_share" in page
        assert "7 of 7" in page  # the side quest is not counted
        commit(student)
        done = run_in(FRESH, "--quick")
        assert done.returncode == 0, done.stdout + done.stderr
        assert "PASS  day 46, your lab" in done.stdout
        assert done.stdout.splitlines()[-1].endswith("your numbers: 1 lab, 2 rows")

    def test_cannot_run_outside_a_repository(self, student, run_in):
        need(not (student.parent / ".git").exists(), "a folder outside any repository")
        shutil.rmtree(student / ".git")
        done = run_in(FRESH)
        assert done.returncode == 2
        assert done.stderr.startswith("error: git rev-parse: ")


@pytest.mark.kit
def test_what_a_killed_run_left_behind_the_next_one_removes(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(sys, "argv", ["fresh.py"])
    monkeypatch.setattr(command, "head_of", lambda: "0" * 40)
    left, at_work = (tmp_path / f"robo47-fresh-{name}" for name in ("a", "b"))
    for folder in (left, at_work):
        (folder / "clone").mkdir(parents=True)
    os.utime(left, (1_000_000_000, 1_000_000_000))
    with pytest.raises(Robo47Error):
        command.main()
    assert list(tmp_path.iterdir()) == [at_work]
