"""`make update`: a mid-term kit on a student's clone, and nothing of theirs is lost."""

import subprocess
from shutil import copytree, ignore_patterns

import pytest
from restored import Restored

from conftest import copy_kit, keep_first_day, run_copy
from labkit.lesson.day import find_day
from labkit.lesson.last_day import started_day
from labkit.lesson.merge import keep_both, keep_ours, merged, renewed
from labkit.lesson.starter import make_starter

pytestmark = pytest.mark.kit
DAY = find_day(1)
WEEK = DAY.folder.name
SRC, WORK = f"{WEEK}/src/{DAY.script}", f"{WEEK}/work/{DAY.script}"
NEW = "day1_poses.py"
SHEET = f"{WEEK}/{DAY.worksheet}"
ROW = "2026-09-01,day1_transforms,1,mine"


def git(folder, *arguments):
    who = ("-c", "user.name=A", "-c", "user.email=a@example.org")
    command = ["git", *who, "-c", "init.defaultBranch=main", *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def edit(path, *pairs):
    text = path.read_text("utf-8")
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    path.write_text(text, "utf-8")


def update(student, *arguments, **environment):
    """Run `make update` in a clone, as a student would."""
    return run_copy(student, "scripts/update.py", *arguments, **environment)


def state(student):
    """Return all that an update may change."""
    files = [p for p in student.rglob("*") if p.is_file() and ".git" not in p.parts]
    content = {
        p.relative_to(student).as_posix(): p.read_bytes()
        for p in files
        if ".robo47" not in p.parts and "__pycache__" not in p.parts
    }
    return content, git(student, "rev-parse", "HEAD"), git(student, "status", "-s")


@pytest.fixture(scope="module")
def begun(tmp_path_factory):
    """The kit as a repository, and the clone of a student half through Day 1."""
    place = tmp_path_factory.mktemp("begun")
    kit, clone = keep_first_day(copy_kit(place / "kit")), place / "student"
    (kit / ".gitignore").write_text("/w*/work/*.before-*.txt\n.robo47/\n__pycache__/\n")
    (kit / ".gitattributes").write_text("metrics.csv merge=union\n")
    (kit / "CHANGELOG.md").write_text("# Changelog\n\n- Day 1 is there.\n")
    git(kit, "init", "-q")
    commit(kit, "the kit")
    git(place, "clone", "-q", str(kit), str(clone))
    done = run_copy(clone, "scripts/start_day.py", 1)
    assert done.returncode == 0
    turn = 'def Rz(theta: float) -> np.ndarray:\n    """Return the turn by theta'
    half = 'def half(x):\n    """Mine."""\n    return x / 2\n\n\n'
    edit(
        clone / WORK,
        ("TRIALS = 1_000 ", "TRIALS = 500 "),
        (turn, f"{half}{turn}"),
        (gap(clone, "1.2"), "    return np.diag([half(2), 1.0, 1.0])  # mine\n"),
        (gap(clone, "1.3"), "    return np.linalg.inv(T)  # my inverse\n"),
    )
    edit(clone / SHEET, ("*(your words)*", "A pose says where a thing is and how."))
    add_row(clone, ROW)
    commit(clone, "my work")
    return Restored(place)


@pytest.fixture
def kit(begun):
    """The kit's repository, put back as it was."""
    return begun.put_back() / "kit"


@pytest.fixture
def student(kit):
    """The student's clone of it."""
    return kit.with_name("student")


def commit(folder, message):
    git(folder, "add", "-A")
    git(folder, "commit", "-qm", message)


def add_row(clone, row):
    with (clone / "metrics" / "metrics.csv").open("a") as file:
        file.write(f"{row}\n")


def gap(clone, task):
    """Return the lines of a gap of the starter."""
    lines = (clone / WORK).read_text("utf-8").splitlines(keepends=True)
    at = next(i for i, line in enumerate(lines) if f"# TODO {task}:" in line)
    return "".join(lines[at : at + 2])


def mid_term(kit):
    """Change the kit as a term does: a row, a task, a script, a heading, a fix."""
    own = kit / WEEK / "day1"
    edit(
        own / "day.toml",
        ('script = "day1_transforms.py"', f'script = "{NEW}"\nwas = ["{DAY.script}"]'),
        ('id = "1.3"', 'id = "1.3"\nwas = ["inverse"]'),
        ('functions = ["inverse"]', 'functions = ["undone"]'),
        ("[[tasks]]\nid = \"1.1\"", "[[metrics]]\ncheck = \"det_by_hand\"\n"
         "metric = \"det_err\"\nmax = 1e-9\n\n[[tasks]]\nid = \"1.1\""),
    )  # fmt: skip
    (own / "inverse.py").rename(own / "undone.py")
    (kit / SRC).rename(kit / WEEK / "src" / NEW)
    edit(
        kit / WEEK / "src" / NEW,
        ("def inverse(", "def undone("),
        ("\ndef main() -> int:", "\nDEGREES = 180.0 / np.pi\n\n\ndef main() -> int:"),
        ("    return lab.finish()", '    lab.record("det_by_hand", 0.0)\n'
         "    return lab.finish()"),
    )  # fmt: skip
    edit(kit / SHEET, ("### pose\n", "### Pose, in your own words\n"))
    edit(kit / "CHANGELOG.md", ("- Day 1", "- Day 1 has a row more. Run it.\n- Day 1"))
    add_row(kit, "2026-09-01,kits,1,theirs")
    commit(kit, "mid-term")


def test_a_mid_term_kit_comes_around_what_is_the_students(kit, student):
    mid_term(kit)
    edit(student / SHEET, ("*(your drawing)*", "![mine](../figures/mine.png)"))
    before = (student / WORK).read_text("utf-8")
    done = update(student)
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert not (student / WORK).exists()
    text = (student / WEEK / "work" / NEW).read_text("utf-8")
    mine = ("TRIALS = 500 ", "def half(x)", "half(2)", "my inverse", "def undone(")
    theirs = ("DEGREES = ", 'lab.record("det_by_hand"', "# TODO 1.4")
    assert [words for words in (*mine, *theirs) if words not in text] == []
    assert "inverse(T) @" not in text
    sheet = (student / SHEET).read_text("utf-8")
    assert "### Pose, in your own words" in sheet
    assert "A pose says where" in sheet  # committed
    assert "![mine]" in sheet  # not committed yet
    rows = (student / "metrics" / "metrics.csv").read_text("utf-8").splitlines()
    assert {ROW, "2026-09-01,kits,1,theirs"} <= set(rows)
    copies = list((student / WEEK / "work").glob("*.before-update-1.txt"))
    assert [copy.read_text("utf-8") for copy in copies] == [before]
    for says in (
        "Day 1 has a row more. Run it.",
        f"the lab {DAY.script} is called {NEW}",
        "inverse is called undone",
        "det_by_hand (det_err)",
        "a heading 'Pose, in your own words'",
        "Once more: make run DAY=1",
    ):
        assert says in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80
    assert git(student, "status", "-s") == ""
    again = update(student)
    assert "nothing has changed" in again.stdout


def test_a_second_week_comes_beside_the_first_and_both_keep_their_work(kit, student):
    second = find_day(8)
    copytree(second.folder, kit / second.folder.name, ignore=ignore_patterns("work"))
    commit(kit, "a second week")
    mine = (student / WORK).read_text("utf-8")
    assert update(student).returncode == 0
    assert run_copy(student, "scripts/start_day.py", 8).returncode == 0
    day = find_day(8, student)
    begun = day.work.read_text("utf-8")
    commit(student, "the second week is begun")
    edit(
        kit / day.source.relative_to(student),
        ("\ndef main(", "\nNEWER = 1\n\n\ndef main("),
    )
    edit(kit / SRC, ("\ndef main(", "\nNEWER = 1\n\n\ndef main("))
    commit(kit, "both weeks are newer")
    done = update(student)
    assert done.returncode == 0, done.stderr
    for lab, before in ((student / WORK, mine), (day.work, begun)):
        text = lab.read_text("utf-8")
        assert "NEWER = 1" in text
        assert set(before.splitlines()) <= set(text.splitlines())
    assert ROW in (student / "metrics" / "metrics.csv").read_text("utf-8")
    assert started_day(student) == 8  # what the kit merged is no edit of theirs


def test_without_a_network_everything_is_as_it_was(kit, student):
    mid_term(kit)
    kit.rename(kit.with_name("gone"))
    edit(student / SHEET, ("*(your drawing)*", "half done"))
    before = state(student)
    done = update(student)
    assert done.returncode == 2
    assert "Nothing of yours has changed" in done.stderr
    assert "Traceback" not in done.stderr
    assert state(student) == before


@pytest.mark.parametrize("at", ["merge.merge", "renew_labs", "merge.take"])
def test_a_run_that_is_killed_leaves_the_clone_for_the_next_one(kit, student, at):
    mid_term(kit)
    before = state(student)
    code = (
        "import os, sys; sys.argv = ['update.py']\n"
        "from labkit.commands import update\n"
        "from labkit.update import merge\n"
        f"def die(*_): os._exit(9)\n{'update.' + at} = die\n"
        "update.main()\n"
    )
    done = run_copy(student, "-c", code)
    assert done.returncode == 9
    changed = set(state(student)[0]) - set(before[0])
    assert all(".before-update-" in name for name in changed)
    assert state(student)[1:] == before[1:]
    assert update(student).returncode == 0
    assert "my inverse" in (student / WEEK / "work" / NEW).read_text("utf-8")


def test_a_kits_file_that_the_student_changed_in_the_same_place_is_named(kit, student):
    edit(student / SRC, ("TRIALS = 1_000 ", "TRIALS = 7 "))
    edit(kit / SRC, ("TRIALS = 1_000 ", "TRIALS = 2_000 "))
    git(kit, "commit", "-qam", "more trials")
    done = update(student)
    assert done.returncode == 0, done.stderr
    assert f"{SRC} is the kit's now; as you had it: git show" in done.stdout
    assert "TRIALS = 2_000 " in (student / SRC).read_text("utf-8")
    assert "TRIALS = 500 " in (student / WORK).read_text("utf-8")  # theirs: kept


@pytest.mark.parametrize("committed", [True, False])
def test_a_notebook_that_the_student_edited_outlives_the_kits(kit, student, committed):
    mine, other = (f"{WEEK}/notebooks/{name}.ipynb" for name in ("day1", "day2"))
    (kit / mine).parent.mkdir(exist_ok=True)
    for name in (mine, other):
        (kit / name).write_text('{"cells": ["the kit\'s"]}\n')
    git(kit, "add", "-f", mine, other)
    git(kit, "commit", "-qm", "notebooks")
    assert update(student).returncode == 0
    edit(student / mine, ("the kit's", "my own"))
    if committed:
        git(student, "commit", "-qam", "my notebook")
    with open(kit / ".gitignore", "a") as ignored:
        ignored.write("/w*/notebooks/\n")
    git(kit, "rm", "-q", mine, other)
    git(kit, "commit", "-qam", "notebooks are made")
    done = update(student)
    assert done.returncode == 0, done.stderr
    assert "my own" in (student / mine).read_text("utf-8")
    assert not (student / other).exists()
    assert update(student).returncode == 0
    assert "my own" in (student / mine).read_text("utf-8")


def test_a_tag_can_be_asked_for_and_a_place_is_remembered(kit, student):
    git(kit, "tag", "v1")
    mid_term(kit)
    git(student, "remote", "rename", "origin", "own")
    assert "make update FROM=" in update(student).stderr
    v1 = update(student, "--from", str(kit), "--to", "v1")
    assert "nothing has changed" in v1.stdout
    assert update(student, "--from", str(kit)).returncode == 0
    assert git(student, "remote", "get-url", "kit") == str(kit)
    assert "v9" in update(student, "--to", "v9").stderr


BASE = "# Day\n\n## Words\n\n*(yours)*\n"


def test_lines_that_both_changed_are_both_kept_and_a_heading_is_the_new_one():
    ours = BASE.replace("## Words\n\n*(yours)*", "## Words\nMine.")
    theirs = BASE.replace("## Words\n\n*(yours)*", "## In words\n\n*(yours)*\n\nMore.")
    assert "More." not in merged(BASE, ours, theirs, keep_ours)
    text = merged(BASE, ours, theirs, keep_both)
    assert "## In words\nMine." in text
    assert "More." in text
    assert "## Words" not in text


def test_a_text_that_only_one_changed_is_theirs():
    texts = ("a\nb\nc\n", "a\nb\nmine\n", "kit\nb\nc\n")
    assert merged(*texts, keep_ours) == "kit\nb\nmine\n"
    assert merged("a\n", "mine\n", "kit\n", keep_ours) == "mine\n"


def test_a_lab_is_renewed_from_the_version_that_it_was_begun_with():
    now = DAY.source.read_text("utf-8")
    older = now.replace("TRIALS = 1_000 ", "TRIALS = 10 ")
    oldest = older.replace("PATH = [", "WAY = [")
    text = make_starter(oldest, "x", 1).replace('"task 1.1: write make_T"', '"mine"')
    found = renewed(DAY, text, [older, oldest], now)
    assert "TRIALS = 1_000 " in found
    assert "PATH = [" in found
    assert '"mine"' in found
    assert renewed(DAY, text, [], now) == text
