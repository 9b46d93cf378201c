"""`make update`: a mid-term kit on a student's clone, and nothing of theirs is lost."""

import os
import shutil
import subprocess
import sys
from shutil import copytree, ignore_patterns

import pytest
from digests import imported_by
from restored import Restored

from conftest import ROOT, copy_kit, keep_first_day, run_copy
from labkit.lesson.day import find_day
from labkit.lesson.last_day import started_day
from labkit.lesson.merge import keep_both, keep_ours, merged, renewed
from labkit.lesson.starter import make_starter

pytestmark = pytest.mark.kit
DAY = find_day(1)
WEEK = DAY.folder.name
SRC, WORK = f"{WEEK}/src/{DAY.script}", f"{WEEK}/work/{DAY.script}"
NEW = "day1_poses.py"
SHEET, RETRO = f"{WEEK}/{DAY.worksheet}", f"{WEEK}/docs/RETRO_w1.md"
COMMANDS = ("update", "start")
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


def small(kit):
    """Return a copy of the kit with what `make update` and `make start` read of it.

    Git writes the kit twice in an update, and looks at all its files ten times.
    """
    begin = [ROOT / "labkit" / "commands" / f"{name}.py" for name in COMMANDS]
    begin += [ROOT / "labkit" / "update" / "labs.py", *(ROOT / "scripts").glob("*.py")]
    needed = {kit / path.relative_to(ROOT) for path in imported_by(begin, DAY)}
    needed |= {kit / name for name in (SRC, SHEET, RETRO)}
    needed |= {*(kit / WEEK / "day1").glob("*.*"), *(kit / WEEK).glob("*.toml")}
    needed |= {kit / "metrics" / "metrics.csv", kit / WEEK / "src" / "kit.py"}
    for path in [path for path in kit.rglob("*") if path.is_file()]:
        if path not in needed:
            path.unlink()
    return kit


@pytest.fixture(scope="module")
def begun(tmp_path_factory):
    """The kit as a repository, and the clone of a student half through Day 1."""
    place = tmp_path_factory.mktemp("begun")
    kit, clone = small(keep_first_day(copy_kit(place / "kit"))), place / "student"
    (kit / ".gitignore").write_text("/w*/work/*.before-*.txt\n.robo47/\n__pycache__/\n")
    (kit / ".gitattributes").write_text("metrics.csv merge=union\n")
    (kit / "CHANGELOG.md").write_text("# Changelog\n\n- Day 1 is there.\n")
    git(kit, "init", "-q")
    commit(kit, "the kit")
    git(place, "clone", "-q", str(kit), str(clone))
    done = run_copy(clone, "scripts/start_day.py", 1)
    assert done.returncode == 0
    turn = 'def Rz(theta: float) -> np.ndarray:\n    """Return the rotation matrix of'
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
        "Run again: make run DAY=1",
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


@pytest.mark.parametrize("at", ["merge.merge", "renew_labs", "last_step.take"])
def test_a_run_that_is_killed_leaves_the_clone_for_the_next_one(kit, student, at):
    mid_term(kit)
    before = state(student)
    code = (
        "import os, sys; sys.argv = ['update.py']\n"
        "from labkit.commands import update\n"
        "from labkit.update import last_step, merge\n"
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


# One run of an update that ends at a moment, by its number: before git is asked for
# the n-th time, or before the n-th file moves.
ENDS = """
import os, sys
sys.argv = ["update.py"]
from pathlib import Path
from labkit.base import git
from labkit.commands import update
from labkit.update import last_step
what, at = {what!r}, {at}
def ends(function):
    def counted(*a, **k):
        global at
        at -= 1
        if at == 0:
            os._exit(9)
        return function(*a, **k)
    return counted
if what == "git":
    take = last_step.take
    def taken(*a):
        git.run = ends(git.run)
        take(*a)
    last_step.take = taken
else:
    Path.replace = ends(Path.replace)
update.main()
"""


def whole(student):
    """Assert that a clone has the newer kit and all that was the student's."""
    text = (student / WEEK / "work" / NEW).read_text("utf-8")
    for words in ("TRIALS = 500 ", "half(2)", "my inverse", "DEGREES = "):
        assert text.count(words) == 1, words
    assert "A pose says where" in (student / SHEET).read_text("utf-8")
    rows = (student / "metrics" / "metrics.csv").read_text("utf-8").splitlines()
    assert rows.count(ROW) == rows.count("2026-09-01,kits,1,theirs") == 1
    assert not (student / WORK).exists()
    assert git(student, "status", "-s") == ""
    log = git(student, "log", "--format=%s")
    assert log.count("My work before the update") <= 1
    memory = {path.name for path in (student / ".robo47").iterdir()}
    assert not {name for name in memory if name.startswith("update-")}
    assert "update.json" not in memory
    git(student, "fsck", "--strict")


@pytest.mark.parametrize(
    ("what", "at"),
    [("git", n) for n in (1, 8, 11, 12, 13, 14)] + [("move", n) for n in (1, 2, 4, 6)],
)
def test_a_run_that_ends_in_its_last_step_is_put_right_by_the_next(
    kit, student, what, at
):
    mid_term(kit)
    edit(student / SHEET, ("*(your drawing)*", "not committed"))
    assert run_copy(student, "-c", ENDS.format(what=what, at=at)).returncode == 9
    assert "not committed" in (student / SHEET).read_text("utf-8")
    done = update(student)
    assert done.returncode == 0, done.stderr
    whole(student)
    assert "not committed" in (student / SHEET).read_text("utf-8")


@pytest.mark.parametrize("note", ["[1]", "{", '{"now": "HEAD", "own": "-x", "to": 5}',
    '{"now": "%s", "own": "%s", "to": "deadbeef"}'])  # fmt: skip
def test_a_note_that_means_nothing_is_left_behind(kit, student, note):
    mid_term(kit)
    head = git(student, "rev-parse", "HEAD")
    (student / ".robo47").mkdir(exist_ok=True)
    text = note % (head, head) if "%" in note else note
    (student / ".robo47" / "update.json").write_text(text)
    assert update(student).returncode == 0
    whole(student)


def test_what_is_edited_while_it_merges_is_told_and_kept(kit, student):
    mid_term(kit)
    code = (
        "import sys; sys.argv = ['update.py']\n"
        "from labkit.base import cli\nfrom labkit.commands import update\n"
        "from labkit.update import last_step\ntake = last_step.take\n"
        "def later(*a):\n"
        f"    open({str(student / SHEET)!r}, 'a').write('meanwhile\\n')\n"
        "    take(*a)\n"
        "last_step.take = later\ncli.run(update.main)\n"
    )
    done = run_copy(student, "-c", code)
    assert f"changed meanwhile: {SHEET}" in done.stderr
    assert update(student).returncode == 0
    assert "meanwhile" in (student / SHEET).read_text("utf-8")


def test_what_is_edited_after_a_run_that_ended_is_not_put_back(kit, student):
    mid_term(kit)
    assert run_copy(student, "-c", ENDS.format(what="move", at=6)).returncode == 9
    edit(student / SHEET, ("A pose says where", "A pose says where and when;"))
    assert update(student).returncode == 0
    assert "where and when;" in (student / SHEET).read_text("utf-8")


@pytest.mark.skipif(os.name == "nt", reason="a shell script stands in for git")
@pytest.mark.parametrize("command", ["read-tree", "update-ref", "worktree", "merge"])
def test_a_git_that_is_killed_changes_nothing_and_the_next_run_is_whole(
    kit, student, tmp_path, command
):
    mid_term(kit)
    before = state(student)
    real, shim = shutil.which("git"), tmp_path / "git"
    lock = "touch .git/index.lock .git/HEAD.lock; " if "-" in command else ""
    shim.write_text(
        f'#!/bin/sh\ncase " $* " in *" {command} "*) [ "$GIT_INDEX_FILE" ] || '
        f'{{ {lock}kill -9 $$; }};; esac\nexec {real} "$@"\n'
    )
    shim.chmod(0o755)
    path = f"{tmp_path}:{os.environ['PATH']}"
    for _ in range(2):  # a second try adds nothing
        done = update(student, PATH=path)
        assert done.returncode == 2
        assert "git was killed. Nothing of yours has changed." in done.stderr
        assert state(student) == before
    assert update(student).returncode == 0
    whole(student)


@pytest.mark.parametrize("ignored", [True, False])
@pytest.mark.parametrize("name", ["notes/f7.md", "notes", "metrics/mine.md"])
def test_a_file_of_the_students_is_never_written_over(kit, student, ignored, name):
    with open(kit / ".gitignore", "a") as file:
        file.write(f"/{name}\n" if ignored else "\n")
    commit(kit, "what is ignored")
    assert update(student).returncode == 0
    new = kit / ("notes/f7.md" if name == "notes" else name)
    new.parent.mkdir(exist_ok=True)
    new.write_text("kit")
    git(kit, "add", "-f", new.relative_to(kit).as_posix())
    git(kit, "commit", "-qm", "a file more")
    mine = student / name
    mine.parent.mkdir(exist_ok=True)
    mine.write_text("MINE")
    before = state(student)
    for _ in range(2):
        done = update(student)
        assert done.returncode == 2
        assert f"{new.relative_to(kit).as_posix()}. Move or rename" in done.stderr
        assert "Nothing of yours has changed." in done.stderr
        assert state(student) == before
    mine.write_text("kit")
    if name == "notes":
        mine.rename(student / "notes of mine")
    assert update(student).returncode == 0
    assert (student / new.relative_to(kit)).read_text() == "kit"


def test_a_log_that_an_editor_saved_in_latin_1_keeps_its_rows(kit, student):
    mid_term(kit)
    log = student / "metrics" / "metrics.csv"
    log.write_bytes(
        log.read_bytes() + "2026-09-02,day1,1,ge\xe4ndert\n".encode("latin-1")
    )
    done = update(student)
    assert done.returncode == 0, done.stderr
    assert log.read_bytes().count(b"ge\xe4ndert\n") == 1
    assert log.read_bytes().count(b"ndert") == 1


def test_a_lab_that_is_not_in_utf_8_is_named(kit, student):
    mid_term(kit)
    lab = student / WORK
    lab.write_bytes(lab.read_bytes().replace(b"# mine", b"# mine \xe4"))
    before = state(student)
    assert f"{WORK} is not in UTF-8: save it" in update(student).stderr
    assert state(student) == before


def test_what_it_says_of_the_clone_is_true_where_it_stops(kit, student):
    """A git that cannot write where the kit is; a reader who went away."""
    mid_term(kit)
    lock = student / ".git" / "config.lock"
    lock.touch()
    before = state(student)
    done = update(student, "--from", kit)
    assert "could not lock config file" in done.stderr
    assert "Nothing of yours has changed." in done.stderr
    assert state(student) == before
    lock.unlink()
    gone = "import os, sys, runpy; sys.path.insert(0, 'scripts')\n"
    gone += "reader, writer = os.pipe(); os.close(reader); os.dup2(writer, 1)\n"
    gone += "runpy.run_path('scripts/update.py', run_name='__main__')"
    done = run_copy(student, "-c", gone)
    assert "Nothing of yours" not in done.stderr
    whole(student)


def test_a_folder_that_may_not_be_written_is_named_and_not_ours_beside_it(kit, student):
    mid_term(kit)
    before = state(student)
    code = (
        "import sys; sys.argv = ['update.py']\nfrom pathlib import Path\n"
        "from labkit.base import cli\nfrom labkit.commands import update\n"
        "replace = Path.replace\n"
        "def no(self, to):\n"
        "    if to.name != 'day1.md' or '.robo47' not in str(self):\n"
        "        return replace(self, to)\n"
        "    Path.replace = replace\n"
        "    raise PermissionError(13, 'Permission denied', str(self), None, str(to))\n"
        "Path.replace = no\ncli.run(update.main)\n"
    )
    done = run_copy(student, "-c", code)
    assert f"student/{SHEET} cannot be written: Permission denied" in done.stderr
    assert "Nothing of yours has changed." in done.stderr
    assert state(student) == before


@pytest.mark.skipif(os.name == "nt", reason="a shell script stands in for a hook")
def test_a_hook_of_the_students_stops_no_update(kit, student):
    """Git LFS brings such a one, which fails where LFS is not installed."""
    mid_term(kit)
    for name in ("post-checkout", "pre-commit", "commit-msg", "reference-transaction"):
        hook = student / ".git" / "hooks" / name
        hook.parent.mkdir(exist_ok=True)
        hook.write_text("#!/bin/sh\nexit 2\n")
        hook.chmod(0o755)
    done = update(student)
    shutil.rmtree(student / ".git" / "hooks")
    assert done.returncode == 0, done.stderr
    whole(student)


@pytest.mark.skipif(os.name == "nt", reason="Windows asks for rights to link")
def test_nothing_is_written_through_a_link_of_the_students(kit, student, tmp_path):
    (kit / "notes").mkdir()
    (kit / "notes" / "f7.md").write_text("kit")
    commit(kit, "notes")
    (student / "notes").symlink_to(tmp_path)
    done = update(student)
    (student / "notes").unlink()
    assert (done.returncode, list(tmp_path.iterdir())) == (2, [])
    assert "notes/f7.md" in done.stderr


@pytest.mark.skipif(os.name == "nt", reason="Windows asks for rights to link")
def test_a_lab_that_is_a_link_is_not_written_through(kit, student, tmp_path):
    mid_term(kit)
    real = tmp_path / "lab.py"
    (student / WORK).rename(real)
    (student / WORK).symlink_to(real)
    before = real.read_bytes()
    done = update(student)
    mine = (student / WORK).read_bytes()
    (student / WORK).unlink()
    assert done.returncode == 0, done.stderr
    assert real.read_bytes() == mine == before


def test_a_lock_of_somebody_elses_git_is_named_and_left(kit, student):
    mid_term(kit)
    lock = student / ".git" / "index.lock"
    lock.touch()
    done = update(student)
    assert "index.lock is there" in done.stderr
    assert lock.exists()
    lock.unlink()
    assert update(student).returncode == 0
    whole(student)


def test_a_file_may_become_a_folder_and_a_folder_a_file(kit, student):
    (kit / "one").write_text("a file")
    (kit / "two" / "deep").mkdir(parents=True)
    (kit / "two" / "deep" / "x").write_text("x")
    commit(kit, "first")
    assert update(student).returncode == 0
    (kit / "one").unlink()
    shutil.rmtree(kit / "two")
    (kit / "one").mkdir()
    (kit / "one" / "y").write_text("y")
    (kit / "two").write_text("a file")
    commit(kit, "then")
    done = update(student)
    assert done.returncode == 0, done.stderr
    assert (student / "one" / "y").read_text() == "y"
    assert (student / "two").read_text() == "a file"
    assert git(student, "status", "-s") == ""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs a limit")
@pytest.mark.parametrize("most", [0, 500, 5_000, 50_000])
def test_a_full_disk_changes_nothing_and_the_next_run_is_whole(kit, student, most):
    """No file may be larger: what a full disk is for whoever writes one."""
    mid_term(kit)
    (kit / "large.txt").write_text("x" * 60_000)
    commit(kit, "a large file")
    before = state(student)
    code = (
        "import resource, sys; sys.argv = ['update.py']\n"
        f"resource.setrlimit(resource.RLIMIT_FSIZE, ({most}, {most}))\n"
        "from labkit.base import cli\nfrom labkit.commands import update\n"
        "cli.run(update.main)\n"
    )
    done = run_copy(student, "-c", code)
    assert done.returncode == 2, done.stdout
    assert "Nothing of yours has changed." in done.stderr
    assert "Traceback" not in done.stderr
    assert state(student) == before
    assert update(student).returncode == 0
    whole(student)


def test_work_that_is_not_committed_stays_so_where_nothing_is_new(kit, student):
    edit(student / SHEET, ("*(your drawing)*", "not committed"))
    before = state(student)
    assert "nothing has changed" in update(student).stdout
    assert state(student) == before


def test_a_retrospective_keeps_its_answers_where_the_kit_changes_the_same_line(
    kit, student
):
    retro, blank = RETRO, "*(your words)*"
    assert blank in (student / retro).read_text("utf-8")
    edit(student / retro, (blank, "I would measure first."))
    edit(kit / retro, (blank, "*(your own words)*"))
    git(kit, "commit", "-qam", "other words")
    done = update(student)
    assert done.returncode == 0, done.stderr
    assert "I would measure first." in (student / retro).read_text("utf-8")
    assert "is the kit's now" not in done.stdout
    if "*(your own words)*" in (student / retro).read_text("utf-8"):
        assert "your work is as it was" not in done.stdout


def test_the_work_is_said_to_be_as_it_was_only_where_it_is(kit, student):
    edit(kit / "CHANGELOG.md", ("Day 1 is there.", "Day 1 is here."))
    git(kit, "commit", "-qam", "words")
    assert "your work is as it was" in update(student).stdout
    edit(student / SRC, ("TRIALS = 1_000 ", "TRIALS = 7 "))
    edit(kit / SRC, ("TRIALS = 1_000 ", "TRIALS = 2_000 "))
    git(kit, "commit", "-qam", "more trials")
    said = update(student).stdout
    assert "is the kit's now" in said
    assert "your work is as it was" not in said


@pytest.mark.parametrize("mark", ["--assume-unchanged", "--skip-worktree"])
def test_a_file_that_git_was_told_to_overlook_is_merged_too(kit, student, mark):
    git(student, "update-index", mark, SHEET)
    edit(student / SHEET, ("A pose says", "A pose, I think, says"))
    with (kit / SHEET).open("a") as file:
        file.write("\n## More\n")
    git(kit, "commit", "-qam", "a heading more")
    done = update(student)
    assert done.returncode == 0, done.stderr
    text = (student / SHEET).read_text("utf-8")
    assert "A pose, I think, says" in text
    assert "## More" in text


@pytest.mark.skipif(os.name == "nt", reason="Windows asks for rights to link")
def test_a_work_folder_behind_a_link_is_named_and_not_committed_as_deleted(
    kit, student, tmp_path
):
    mid_term(kit)
    work, real = (student / WORK).parent, tmp_path / "cloud"
    work.rename(real)
    work.symlink_to(real)
    before = git(student, "rev-parse", "HEAD")
    done = update(student)
    work.unlink()
    assert done.returncode == 2
    assert f"{WEEK}/work is a symbolic link" in done.stderr
    assert "Nothing of yours has changed." in done.stderr
    assert git(student, "rev-parse", "HEAD") == before
    assert (real / DAY.script).is_file()


def as_template(kit, place):
    """Return a copy of the kit's files with a history of its own, as a template's."""
    copy = place / "copy"
    copytree(kit, copy, ignore=ignore_patterns(".git", "__pycache__", ".robo47"))
    git(copy, "init", "-q")
    return copy


@pytest.mark.parametrize("edited", [False, True])
def test_a_copy_of_a_template_gets_what_came_since_it_was_made(kit, edited):
    copy = as_template(kit, kit.parent)
    if edited:  # no commit of the kit has just these files
        edit(copy / ".gitignore", (".robo47/\n", ".robo47/\n/own-notes/\n"))
    commit(copy, "Initial commit")
    began = git(kit, "rev-parse", "--short", "HEAD")
    edit(kit / SRC, ("SEED = 47", "SEED = 48"))
    commit(kit, "before the first update")
    done = update(copy, "--from", kit)
    assert done.returncode == 0, done.stdout + done.stderr
    says = "is nearest to" if edited else "has the very files of"
    assert f"Your copy {says} the kit's commit {began}" in done.stdout
    assert "SEED = 48" in (copy / SRC).read_text("utf-8")
    assert ("own-notes" in (copy / ".gitignore").read_text("utf-8")) == edited
    again = update(copy)
    assert "nothing has changed" in again.stdout
    assert "Your copy" not in again.stdout


def test_a_kit_with_a_rewritten_history_is_still_the_kit(kit, student):
    git(kit, "commit", "-q", "--amend", "-m", "the kit, written anew")
    edit(kit / SRC, ("SEED = 47", "SEED = 48"))
    commit(kit, "after it")
    done = update(student)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "has the very files of the kit's commit" in done.stdout
    assert "SEED = 48" in (student / SRC).read_text("utf-8")
    assert "my inverse" in (student / WORK).read_text("utf-8")


def test_a_repository_that_is_not_the_kit_is_refused(kit, student, tmp_path):
    (tmp_path / "other.txt").write_text("other\n")
    git(tmp_path, "init", "-q")
    commit(tmp_path, "another one")
    done = update(student, "--from", tmp_path)
    assert done.returncode != 0
    assert "is another repository" in done.stderr
