"""Grading a class as a program: the generated class, killed, resumed, and again."""

import contextlib
import csv
import datetime
import html
import io
import json
import os
import re
import shutil
import subprocess
import sys
import time
import warnings
from collections import Counter
from types import SimpleNamespace
from urllib.parse import unquote

import pytest
from make_class import DAY, DEADLINE, KINDS, NAMES, SOLVED, WEEK, commit, make_class
from test_report import MEASURE
from test_week import titles

from labkit.base import cli
from labkit.commands import grade as command
from labkit.grade import engine
from labkit.grade.journal import Journal
from labkit.sandbox.process import Wall
from robo47.errors import Robo47Error
from robo47.paths import ROOT

pytestmark = pytest.mark.kit
LINUX = sys.platform.startswith("linux")  # where memory has a limit, not a watch
WINDOWS = sys.platform == "win32"
SCRIPT = "scripts/grade_class.py"
# What decides the bytes that are written: the deadline and the fresh inputs.
IN_TIME = ("--deadline", "2026-09-04T16:00:00+00:00", "--seed", "4711")
MINUTES = "minutes_since_commit_own_clock"
ALL = len(DAY.tasks)
# What each kind gets: tasks passed, first mistake, and what the column error holds.
EXPECTED = {
    "right": (ALL, "", ""),
    "wrong inverse": (ALL - 1, "1.3 t-negated", ""),
    "under way": (3, "", ""),
    "not started": (0, "", ""),
    "no file": (0, "", "is not there. Begin with: make start DAY=1"),
    "empty": (0, "", "is not there"),
    "exits": (0, "1.1 does-not-load", "it ends Python while it is loaded"),
    "exits at once": (0, "1.1 does-not-load", "it ended Python"),
    "loops": (ALL - 1, "1.8 stopped", ""),
    "eats memory": (3, "1.1 raises" if LINUX else "1.1 stopped", ""),
    "forks": (3, "1.1 raises" if WINDOWS else "1.1 refused", ""),
    "forges": (3, "1.1 shape", ""),
    "names the time": (3, "1.1 raises", ""),
    "own kit": (2, "", ""),
    "no python": (0, "1.1 does-not-load", "SyntaxError"),
    "binary": (0, "1.1 does-not-load", "not in UTF-8"),
    "no git": (ALL, "", ""),
    "corrupt git": (ALL, "", ""),
    "300 MB": (0, "1.1 does-not-load", "has 300.0 MB – at most 100 kB is looked at"),
    "link loop": (0, "1.1 does-not-load", "no file" if WINDOWS else "behind a link"),
    "uncommitted": (ALL, "", ""),
    "git with a program": (ALL, "", ""),
    "copied": (ALL, "", ""),
    "copyist": (ALL, "", ""),
}


def command_of(root, out, *arguments):
    """Return the command that grades a class, whoever asks: CI may be root."""
    fixed = ("--out", out / "grades.csv", "--i-know-them")
    if "--day" not in arguments:
        fixed = (*fixed, "--day", 1)
    return [sys.executable, *map(str, (ROOT / SCRIPT, root, *fixed, *arguments))]


def grade(root, out, *arguments):
    """Grade a class; return the finished process."""
    done = subprocess.run(
        command_of(root, out, *arguments),
        capture_output=True,
        cwd=ROOT,
        encoding="utf-8",
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
        timeout=600,
        check=False,
    )
    assert "Traceback" not in done.stderr, done.stderr
    return done


def grade_here(root, out, *arguments):
    """Grade a class as `grade` does, in this process; its graders stay for the next."""
    said, complained = io.StringIO(), io.StringIO()
    with pytest.MonkeyPatch.context() as patch, contextlib.ExitStack() as stack:
        patch.setattr(sys, "argv", command_of(root, out, *arguments)[1:])
        patch.setattr(warnings, "formatwarning", warnings.formatwarning)
        patch.setattr(engine, "close_graders", lambda: None)
        stack.enter_context(contextlib.redirect_stdout(said))
        stack.enter_context(contextlib.redirect_stderr(complained))
        ended = stack.enter_context(pytest.raises(SystemExit))
        cli.run(command.main)
    return SimpleNamespace(
        returncode=ended.value.code,
        stdout=said.getvalue(),
        stderr=complained.getvalue(),
    )


def rows(out):
    """Return the table as {folder: row}."""
    text = (out / "grades.csv").read_bytes().decode("utf-8-sig")
    return {row["folder"].lstrip("'"): row for row in csv.DictReader(io.StringIO(text))}


def outputs(out):
    """Return every file that a class gets, but for the journal."""
    return {
        path.relative_to(out).as_posix(): path.read_bytes()
        for path in sorted(out.rglob("*"))
        if path.is_file() and path.name != "grading.jsonl"
    }


def journalled(out):
    """Return how often each folder stands in the journal."""
    lines = (out / "grading.jsonl").read_text("ascii").splitlines()
    return Counter(json.loads(line).get("folder") for line in lines if line)


def kill_at(root, out, number, *arguments):
    """Start grading and kill it, as `kill -9` does, once so many are graded."""
    process = subprocess.Popen(
        command_of(root, out, *arguments),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    journal = out / "grading.jsonl"
    deadline = time.monotonic() + 120
    while not journal.exists() or journal.read_bytes().count(b"\n") <= number:
        assert process.poll() is None, "it ended before it could be killed"
        assert time.monotonic() < deadline
        time.sleep(0.02)
    process.kill()
    process.wait()


@pytest.fixture(scope="module", autouse=True)
def graders():
    """End the graders that were kept."""
    yield
    engine.close_graders()


@pytest.fixture(scope="module")
def graded(tmp_path_factory):
    """A class of one student of each kind, graded in one go, by one process."""
    place = tmp_path_factory.mktemp("class")
    clones, out = place / "clones", place / "out"
    kinds = {kind: names[0] for kind, names in make_class(clones, len(KINDS)).items()}
    done = grade(clones, out, *IN_TIME, "--processes", 1)
    assert done.returncode == 0, done.stderr
    row = {kind: rows(out)[name.lstrip("'")] for kind, name in kinds.items()}
    return SimpleNamespace(
        clones=clones,
        out=out,
        kinds=kinds,
        row=row,
        said=done.stdout,
        page=(out / "class.html").read_text("utf-8"),
    )


class TestTheClass:
    @pytest.mark.parametrize("kind", EXPECTED)
    def test_gives_each_kind_of_student_a_row_that_says_what_it_is(self, graded, kind):
        row, (passed, mistake, error) = graded.row[kind], EXPECTED[kind]
        assert (int(row["tasks_passed"]), row["first_mistake"]) == (passed, mistake)
        assert error in row["error"]
        assert bool(error) == bool(row["error"])

    def test_judges_what_is_handed_in_too(self, graded):
        row = graded.row
        assert row["right"]["deliverables_passed"] == "5"
        assert row["corrupt git"]["deliverables_passed"] == "4"
        assert row["corrupt git"]["commit"] == "todo"
        assert row["300 MB"]["figure"] == "wrong"
        assert row["no git"]["deliverables_passed"] == "0"

    def test_counts_minutes_from_the_last_commit_to_the_deadline(self, graded):
        kinds = ("right", "wrong inverse", "empty")
        minutes = [graded.row[kind][MINUTES] for kind in kinds]
        assert minutes == ["0", "61", ""]

    def test_runs_nothing_of_a_clone_and_leaves_it_as_it_is(self, graded):
        clones = graded.clones
        assert not list(clones.parent.rglob("pwned"))  # what git was to run
        assert len(list(clones.iterdir())) == len(KINDS)
        left = [
            p for p in clones.rglob("*") if "robo47-" in p.name or p.suffix == ".pyc"
        ]
        assert left == []

    def test_guards_the_table_against_formulas(self, graded):
        table = (graded.out / "grades.csv").read_text("utf-8-sig")
        cells = [cell for row in csv.reader(io.StringIO(table)) for cell in row]
        assert "'" + NAMES["not started"] in cells
        assert not [c for c in cells if c and c[0] in "=+-@" and not c[1:].isdigit()]

    def test_tells_each_student_what_make_check_tells_them(self, graded, run):
        name = graded.kinds["wrong inverse"]
        work = graded.clones / name / WEEK / "work" / DAY.script
        tasks = run("scripts/check_day.py", "--file", work).stdout.split("\n\n")[1]
        text = (graded.out / "feedback" / f"{name}.txt").read_text("utf-8")
        assert "your translation has the wrong sign" in tasks
        of_a_check = re.findall(r"^ +All arguments: make check .*\n", tasks, re.M)
        for line in of_a_check:  # a reader of the feedback has the call in it
            tasks = tasks.replace(line, "")
        assert set(tasks.splitlines()) <= set(text.splitlines())
        assert "- call: inverse(T)" in text  # what it takes to appeal
        assert text.startswith(name)
        assert max(map(len, text.splitlines())) <= 80

    def test_has_no_path_of_this_machine_in_anything_it_writes(self, graded):
        for name, content in outputs(graded.out).items():
            assert b"robo47-check-" not in content, name
            assert b"robo47-grade" not in content, name

    def test_lists_the_copyist_beside_who_was_copied(self, graded):
        page, kinds = graded.page, graded.kinds
        alike = page[page.index("Similar submissions") : page.index("Everyone")]
        kits = [li for li in alike.split("<li>") if "the kit's solution, " in li]
        pairs = [li for li in alike.split("<li>")[1:] if li not in kits]
        assert any(kinds["copied"] in li and kinds["copyist"] in li for li in pairs)
        assert not any(kinds["wrong inverse"] in li for li in pairs)
        assert any(kinds["right"] in li for li in kits)  # the kit's, to the letter
        assert not any(kinds["not started"] in li for li in kits)

    def test_is_told_in_a_few_lines(self, graded):
        lines = graded.said.splitlines()
        assert lines[0].startswith("wall: ")
        kit = next(i for i, line in enumerate(lines) if line.startswith("kit: "))
        assert all(len(line) < 80 for line in lines[:kit])  # the wall is described
        lines[1:kit] = []
        assert lines[1].startswith("kit: ")
        assert lines[2].startswith(f"Day 1, {len(KINDS)} students: 7 done")
        assert lines[3] == f"graded now: {len(KINDS)}; unchanged since: 0"
        assert lines[-1].endswith("class.html")


class TestGradingAgain:
    def test_does_nothing_where_nothing_changed(self, graded):
        files = [path for path in graded.out.rglob("*") if path.is_file()]
        before = {p: (p.stat().st_mtime_ns, p.read_bytes()) for p in files}
        done = grade_here(graded.clones, graded.out)
        assert f"graded now: 0; unchanged since: {len(KINDS)}" in done.stdout
        files = [path for path in graded.out.rglob("*") if path.is_file()]
        assert {p: (p.stat().st_mtime_ns, p.read_bytes()) for p in files} == before

    def test_by_two_processes_after_a_kill_gives_the_same_bytes(self, graded, tmp_path):
        two = ("--processes", 2)
        kill_at(graded.clones, tmp_path, 5, *IN_TIME, *two)
        kept = len(journalled(tmp_path)) - 1
        assert not (tmp_path / "grades.csv").exists()
        with (tmp_path / "grading.jsonl").open("ab") as journal:
            journal.write(b'\n{"folder": "stu')  # as a power cut leaves it
        done = grade_here(graded.clones, tmp_path, *two)
        assert f"unchanged since: {kept}" in done.stdout
        assert outputs(tmp_path) == outputs(graded.out)


@pytest.fixture(scope="module")
def three(tmp_path_factory):
    """A class of three, graded, that stays as it is."""
    place = tmp_path_factory.mktemp("three")
    make_class(place / "clones", 3)
    assert grade_here(place / "clones", place / "out", *IN_TIME).returncode == 0
    return place


@pytest.fixture
def small(three, tmp_path):
    """A copy of it: students who may be changed, and where their grades are."""
    shutil.copytree(three, tmp_path, symlinks=True, dirs_exist_ok=True)
    return tmp_path / "clones", tmp_path / "out"


def test_only_who_changed_is_graded_again(small):
    clones, out = small
    later = ("--deadline", "2026-09-04T16:30:00+00:00")
    for words in (later, ()):  # a new deadline needs no new grades, and is kept
        assert "graded now: 0; unchanged since: 3" in grade_here(*small, *words).stdout
        assert rows(out)["student 0001"][MINUTES] == "91"
    commit(clones / "student 0001", DEADLINE + 60)
    assert "graded now: 1; unchanged since: 2" in grade_here(*small, *later).stdout
    assert rows(out)["student 0001"][MINUTES] == "29"
    (clones / "student 0001" / WEEK / "work" / DAY.script).write_text(SOLVED)
    assert "graded now: 1; unchanged since: 2" in grade_here(*small).stdout
    row = rows(out)["student 0001"]
    assert (row["tasks_passed"], row["commit"]) == (str(ALL), "todo")
    assert "graded now: 3" in grade_here(*small, "--again").stdout


class TestTheRoster:
    def test_gives_names_and_order_and_says_who_has_no_folder(self, small):
        clones, out = small
        (clones / "roster.csv").write_text(
            "Name;Folder;Git URL\n=Grace;student 0001;\n\nAda;nobody;\nUp;../..;\n",
            "utf-8-sig",
        )
        done = grade_here(clones, out)
        assert done.returncode == 0
        found = rows(out)
        assert list(found) == ["student 0001", "nobody", "../.."]
        assert found["student 0001"]["name"] == "'=Grace"
        assert found["nobody"]["error"] == "there is no such folder"
        assert found["../.."]["error"] == "''../..' is no name of a folder"
        assert found["nobody"]["1.1"] == "ungraded"

    @pytest.mark.parametrize("out", ["", "/proc/nowhere/grades.csv"])
    def test_is_written_nowhere_but_in_a_file(self, small, out):
        done = grade_here(*small, "--out", out)
        assert done.returncode == 2
        assert len(done.stderr.splitlines()) == 1

    def test_is_refused_in_a_line_where_it_is_wrong(self, small):
        (small[0] / "roster.csv").write_bytes(b"name,git\nAda,x\n")
        done = grade_here(*small)
        assert done.returncode == 2
        assert "no column folder" in done.stderr

    def test_brings_clones_and_updates_them(self, tmp_path):
        make_class(tmp_path / "origin", 2)
        clones, out = tmp_path / "clones", tmp_path / "out"
        clones.mkdir()
        first = tmp_path / "origin" / "Zoë Ångström"
        second = tmp_path / "origin" / "student 0001"
        roster = f"name,folder,git\nZoë,zoe,{first}\nTwo,two,{second}\nNo,no,/none\n"
        (clones / "roster.csv").write_text(roster, "utf-8")
        done = grade_here(clones, out, "--pull")
        assert done.returncode == 1
        assert rows(out)["zoe"]["tasks_passed"] == str(ALL)
        assert "not pulled: fatal" in rows(out)["no"]["error"]
        (second / WEEK / "work" / DAY.script).write_text(SOLVED)
        commit(second, DEADLINE)
        with (clones / "zoe" / ".git" / "config").open("a") as config:
            config.write('[core]\n\tsshCommand = "touch pwned"\n')
        done = grade_here(clones, out, "--pull")
        assert rows(out)["two"]["tasks_passed"] == str(ALL)
        assert "git configuration was changed since" in rows(out)["zoe"]["error"]
        assert not (clones / "zoe" / "pwned").exists()
        assert rows(out)["zoe"]["tasks_passed"] == str(ALL)


class TestNamesThatLead:
    def test_out_of_the_folder_of_feedback_do_not(self, small):
        clones, out = small
        odd = ["../../escaped", "/etc", "a/b", "c\\b", "./student 0001"]
        odd += ["student 0001/"]
        text = "name,folder\n" + "".join(f"M,{name}\n" for name in odd)
        (clones / "roster.csv").write_text(text + "S,student 0001\n")
        out = out.with_name("own")
        before = set(out.parent.rglob("*"))
        assert grade_here(clones, out).returncode == 0
        made = {p for p in out.parent.rglob("*") if p.is_file()} - before
        assert {p.parent for p in made} <= {out, out / "feedback"}
        assert len(list((out / "feedback").iterdir())) == len(odd) + 1
        assert (out / "feedback" / "student 0001.txt").read_text().startswith("S\n")


class TestFaultsOfTheMachine:
    @pytest.mark.skipif(not LINUX, reason="needs prlimit")
    def test_are_no_result_and_tried_again(self, small):
        """Nothing but the few bytes of the table and the journal can be written."""
        import resource

        clones, out = small[0], small[1].with_name("own")
        hard = resource.getrlimit(resource.RLIMIT_FSIZE)[1]
        full = f"""
import resource, runpy, subprocess, sys
from labkit.grade import engine  # before Popen is another
start = subprocess.Popen
def limited(*a, **k):
    it = start(*a, **k)
    resource.prlimit(it.pid, resource.RLIMIT_FSIZE, (0, {hard}))
    return it
subprocess.Popen = limited
sys.argv = {command_of(clones, out)[1:]!r}
sys.path.insert(0, {str(ROOT / "scripts")!r})
runpy.run_path(sys.argv[0], run_name="__main__")
"""
        done = subprocess.run(
            [sys.executable, "-c", full],
            capture_output=True,
            encoding="utf-8",
            timeout=300,
            check=False,
        )
        assert done.returncode == 1, done.stderr
        assert "this machine failed: 3; run the same command again" in done.stdout
        assert "this machine failed (" in rows(out)["student 0001"]["error"]
        assert set(journalled(out)) == {None}
        done = grade_here(clones, out)
        assert done.returncode == 0
        assert "graded now: 3; unchanged since: 0" in done.stdout
        assert rows(out)["Zoë Ångström"]["tasks_passed"] == str(ALL)


@pytest.mark.parametrize(
    ("wall", "root", "container", "why"),
    [
        ("bubblewrap", True, False, "you are root"),
        ("landlock", True, False, "you are root"),
        ("landlock", True, True, ""),
        ("none", True, False, "your rights"),
        ("none", True, True, "with your rights"),
        ("none", False, False, "with your rights, use a container"),
        ("none", False, True, "with your rights"),  # Toolbox, Distrobox: your home
        ("bubblewrap", False, False, ""),
        ("landlock", False, False, ""),
    ],
)
def test_strangers_code_runs_behind_a_wall_or_because_one_says_so(
    monkeypatch, capsys, wall, root, container, why
):
    stands = Wall(wall, f"it is {wall}")
    monkeypatch.setattr(command, "wall", lambda: stands)
    monkeypatch.setattr(engine, "wall", lambda: stands)
    monkeypatch.setattr(engine, "in_container", lambda: container)
    monkeypatch.setattr(os, "geteuid", lambda: 0 if root else 1000, raising=False)
    monkeypatch.setattr(sys, "argv", ["grade_class.py", "class"])
    refused = pytest.raises(Robo47Error, match=rf"{why}.*--i-know-them")
    with refused if why else contextlib.nullcontext():
        command.admit(command.parse())
    assert capsys.readouterr().out == f"wall: it is {wall}\n"
    sys.argv.append("--i-know-them")
    command.admit(command.parse())


class TestMistakesOfTheTeacher:
    def test_a_deadline_that_is_a_day_means_its_end(self, small):
        grade_here(*small, "--deadline", "2026-09-04")
        end = datetime.datetime(2026, 9, 5).timestamp()  # midnight here
        left = int(end - DEADLINE) // 60  # the last commit is at DEADLINE
        assert rows(small[1])["Zoë Ångström"][MINUTES] == str(left)

    def test_another_one_is_at_work_or_has_another_day_in_the_same_place(self, small):
        clones, out = small
        with contextlib.closing(Journal(out / "grading.jsonl", DAY)):
            done = grade_here(clones, out)
        assert done.returncode == 2
        assert "another make grade is at work there" in done.stderr
        head = {"kind": "robo47 grading", "days": [2], "reference": 0}
        (out / "grading.jsonl").write_text(json.dumps(head))
        done = grade_here(clones, out)
        assert done.returncode == 2
        assert "holds day 2: give each day a folder of its own" in done.stderr

    def test_a_folder_that_is_none_or_is_a_clone(self, tmp_path):
        assert "is no folder" in grade_here(tmp_path / "none", tmp_path).stderr
        assert "is itself a clone" in grade_here(ROOT, tmp_path).stderr
        assert "has no folders" in grade_here(tmp_path, tmp_path).stderr

    def test_a_place_that_cannot_be_written_or_a_value_that_means_nothing(self, small):
        clones, out = small
        done = grade_here(clones, out / "grades.csv")
        assert done.returncode == 2
        assert "cannot be" in done.stderr
        for words in ("deadline soon", "deadline 9999-12-31", "processes 0", "day 9"):
            name, value = words.split()
            assert grade_here(*small, f"--{name}", value).returncode == 2

    def test_help_fits_80_columns(self, tmp_path, monkeypatch):
        monkeypatch.setenv("COLUMNS", "80")
        said = grade_here(tmp_path, tmp_path, "--help").stdout
        assert max(map(len, said.splitlines())) <= 80
        assert "--dask tls://" in said


@pytest.mark.soak
def test_a_class_of_200_gives_the_same_bytes_however_it_is_graded(tmp_path):
    clones = tmp_path / "clones"
    make_class(clones, 200)
    whole, two, killed = (tmp_path / name for name in ("whole", "two", "killed"))
    grade(clones, whole, *IN_TIME, "--processes", 1)
    assert len(rows(whole)) == 200
    again = grade(clones, whole, *IN_TIME)
    assert "graded now: 0; unchanged since: 200" in again.stdout
    grade(clones, two, *IN_TIME, "--processes", 2)
    for number in (40, 90, 150):
        kill_at(clones, killed, number, *IN_TIME)
    grade(clones, killed)
    assert outputs(two) == outputs(whole)
    assert outputs(killed) == outputs(whole)
    assert max(n for folder, n in journalled(killed).items() if folder) == 1


@pytest.mark.browser
def test_the_page_fits_and_runs_nothing_in_a_real_browser(graded, tmp_path, chromium):
    widths, page = (390, 1280), html.escape(graded.page)
    pages = [MEASURE.format(width=width, page=page) for width in widths]
    found = titles(chromium, tmp_path, *pages)
    for width, counted in zip(widths, found, strict=True):
        title, scroll_width, too_wide, *_, made = counted.rsplit(maxsplit=5)
        assert title == f"Day 1: {DAY.title}"
        assert int(scroll_width) <= width
        assert (too_wide, made) == ("0", "0")


def test_the_page_asks_for_nothing_from_outside_and_holds_no_markup(graded):
    assert not re.search(r"https?:|url\(|@import|<script|<link|<img", graded.page)
    links = re.findall(r'href="([^"]*)"', graded.page)
    assert 'id="alike"' in graded.page  # where the first of them leads
    links.remove("#alike")
    assert len(links) >= len(KINDS)
    for link in links:  # to the students' own files, and nowhere else
        assert re.fullmatch(r"feedback/[^/:]*\.txt", link)
        assert (graded.out / unquote(link)).is_file()
    assert "&lt;img src=x onerror=alert(1)&gt;" in graded.page


def test_copies_of_one_file_get_one_grade_and_one_failing_call(run, tmp_path):
    """A bug that few inputs reach is found for all of them or for none."""
    rare = "    if theta > 2.9:\n        return np.diag([-1.0, -1.0, 1.0])\n"
    _, marker, _ = DAY.source.read_text("utf-8").partition("    # region 1.2\n")
    text = DAY.source.read_text("utf-8").replace(marker, marker + rare)
    for i in range(3):
        work = tmp_path / "clones" / f"s{i:02}" / WEEK / "work"
        work.mkdir(parents=True)
        (work / DAY.script).write_text(f"{text}# {i}\n", "utf-8")
    done = grade_here(tmp_path / "clones", tmp_path, "--seed", "4711")
    table = [row.values() for row in rows(tmp_path).values()]
    assert len({tuple(row)[3:] for row in table}) == 1  # but for id, name and folder
    told = [path.read_text("utf-8") for path in (tmp_path / "feedback").iterdir()]
    assert len({text.partition("\n")[2] for text in told}) == 1
    assert "--seed 4711" in done.stdout
    call = re.search(r"(Rz\(.+\))\[\d, \d\] returned (\S+); expected (\S+)\.", told[0])
    mine = tmp_path / "clones" / "s00" / WEEK / "work" / DAY.script
    asked = ("1", "--task", "1.2", "--file", mine, "--seed", "4711")
    again = run("scripts/check_day.py", *asked)
    assert call[0] in again.stdout  # on the student's machine
    assert float(call[2]) != pytest.approx(float(call[3]))
    theta = float(call[1][3:-1])
    assert theta > 2.9
