"""Deadlines: the last commit in time counts, whatever is pushed, amended or forced."""

import os
import shutil
import subprocess
import zlib
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from make_class import DAY, DEADLINE, WEEK, commit, put

from conftest import need
from labkit.base.git import before
from labkit.commands import grade as command
from labkit.commands import proof
from labkit.grade import package as packages
from labkit.grade import page, sheet
from labkit.grade.course import Course, GradedStudent, percent
from labkit.grade.journal import Journal
from labkit.grade.package import collect, read_in_time
from labkit.grade.pull import pull_all
from labkit.grade.result import Mark, Result, counted, ungraded
from labkit.grade.roster import Student
from labkit.handin.deliverables import item_names
from labkit.lesson.day import all_days
from robo47.errors import Robo47Error
from robo47.paths import ROOT

pytestmark = pytest.mark.kit
SCRIPT = f"{WEEK}/work/{DAY.script}"
HOUR = 3600


def save(clone: Path, text: str, when: int) -> str:
    """Write a student's script, commit it and return the commit."""
    put(clone, {SCRIPT: text})
    commit(clone, when)
    return git(clone, "rev-parse", "HEAD")


def git(clone: Path, *arguments: str) -> str:
    return subprocess.check_output(["git", *arguments], cwd=clone, text=True).strip()


@pytest.fixture
def clone(tmp_path):
    (tmp_path / "mia").mkdir()
    return tmp_path / "mia"


def collected(clone, deadline=DEADLINE):
    """Return the package, with the script's text."""
    package = collect(Student("Mia", "mia", clone), DAY, deadline=deadline)
    return package, package.handin.files.get(SCRIPT, b"").decode()


def test_a_broken_commit_after_the_deadline_counts_for_nothing(clone):
    good = save(clone, "good = 1", DEADLINE - HOUR)
    save(clone, "broken(", DEADLINE + 60)
    save(clone, "broken((", DEADLINE + 120)
    package, text = collected(clone)
    assert (text, package.commit, package.late) == ("good = 1", good, 2)
    assert package.committed == DEADLINE - HOUR
    assert collected(clone, None)[1] == "broken(("  # without a deadline the last one


def test_a_page_to_show_is_of_the_commit_that_was_graded(clone, tmp_path, monkeypatch):
    """Under a deadline and with the best of all results."""
    good = save(clone, "good = 1", DEADLINE - HOUR)
    late = save(clone, "late = 1", DEADLINE + HOUR)
    (clone / SCRIPT).write_text("not committed = 1")
    mia = Student("Mia", "mia", clone, file="mia")
    for commit_, text in ((good, b"good = 1"), (late, b"not committed = 1")):
        one = collect(mia, DAY, at=commit_)
        assert (one.commit, one.handin.files[SCRIPT]) == (commit_, text)
    asked = []

    def run(words, **_):
        asked.extend(words)
        return subprocess.CompletedProcess(words, 0, "", "")

    monkeypatch.setattr(command.processes, "run", run)
    graded = [Course(DAY, [GradedStudent(mia, result(8), commit=good)])]
    command.prove([mia], DAY.week.number, tmp_path / "proof", 1, graded)
    assert asked[-2:] == ["--graded", f"1:{good}"]
    assert proof.graded(asked[-1]) == {1: good}
    seen = []

    def facts_of(day, *_, at, **__):
        seen.append((day.number, at))
        return SimpleNamespace(own=(), functions=1)

    monkeypatch.setattr(proof, "facts_of", facts_of)
    days = all_days()[:3]
    found = {1: good, 2: late}
    assert len([*proof.run_days(days, mia, tmp_path, None, False, found)]) == 3
    assert seen == [(1, good), (2, late), (3, late)]  # a capstone's other days


@pytest.mark.parametrize("text", ["1:..", "1:HEAD", "x:360fd61", "1:--all", "1"])
def test_a_graded_commit_is_a_hash(text):
    with pytest.raises(ValueError, match=r"."):
        proof.graded(text)


@pytest.mark.parametrize("what", ["year 5138", "no git", "a link"])
def test_a_time_that_nobody_knows_is_said_to_be_unknown(clone, what):
    save(clone, "x = 1", DEADLINE)
    if what == "year 5138":
        text = git(clone, "cat-file", "commit", "HEAD") + "\n"
        (clone / "text").write_text(text.replace(f"{DEADLINE} ", "99999999999 "))
        odd = git(clone, "hash-object", "-t", "commit", "-w", "text")
        git(clone, "update-ref", "HEAD", odd)
    if what == "no git":
        shutil.rmtree(clone / ".git")
    if what == "a link":
        (clone / ".git").rename(clone / "elsewhere")
        (clone / ".git").symlink_to("elsewhere")
    package = collected(clone)[0]
    assert package.committed is None
    mia = Student("Mia", "mia", clone)
    one = GradedStudent(mia, result(8), commit=package.commit, late=package.late)
    assert one.late_by == ("unknown", "unknown")
    head, row = sheet.as_csv([one]).decode("utf-8-sig").splitlines()
    cells = dict(zip(head.split(","), row.split(","), strict=True))
    assert cells["late_minutes"] == cells["late_days"] == "unknown"
    since = cells["minutes_since_commit_own_clock"]
    assert since == ("unknown" if package.commit else "")
    assert ">unknown</td>" in page.render(Course(DAY, [one], deadline=True))
    assert replace(one, late=None).late_by == (None, None)  # there is no deadline
    assert replace(one, result=ungraded(DAY, "")).late_by == (None, None)


def test_a_newer_kit_that_is_merged_too_late_takes_no_works_place(clone):
    """Its commits may be of the days between the work and the deadline."""
    put(clone, {"README.md": "kit"})
    commit(clone, DEADLINE - 9 * HOUR)
    git(clone, "checkout", "-q", "-b", "kit")
    put(clone, {"README.md": "a newer kit"})
    commit(clone, DEADLINE - 60)
    git(clone, "checkout", "-q", "-")
    good = save(clone, "good = 1", DEADLINE - HOUR)
    who = ("-c", "user.name=A", "-c", "user.email=a@example.org")
    git(clone, *who, "merge", "-q", "--no-edit", "kit")  # today: after the deadline
    package, text = collected(clone)
    assert (text, package.commit, package.late) == ("good = 1", good, 1)


@pytest.mark.parametrize(("when", "late"), [(DEADLINE, 0), (DEADLINE + 5400, 1)])
def test_a_commit_at_the_deadline_is_in_time_and_counts_late_if_none_is(
    clone, when, late
):
    save(clone, "x = 1", when)
    package, text = collected(clone)
    assert (text, package.late, package.committed) == ("x = 1", late, when)


def test_uncommitted_work_counts_as_long_as_nothing_is_late(clone):
    save(clone, "x = 1", DEADLINE - HOUR)
    (clone / SCRIPT).write_text("x = 2")
    assert collected(clone)[1] == "x = 2"
    commit(clone, DEADLINE + HOUR)
    assert collected(clone)[1] == "x = 1"


def test_helpers_worksheet_and_pictures_are_those_of_that_commit(clone):
    sheet_, helper = DAY.files["worksheet"], f"{WEEK}/work/helper.py"
    picture = clone / WEEK / "figures" / "mine.png"
    text = "![a](../figures/mine.png) ![b](gone.png)"
    put(clone, {sheet_: text, helper: "y = 1"})
    put(clone, {f"{WEEK}/figures/mine.png": b"\x89PNG\r\n\0\xff"})
    save(clone, "import helper", DEADLINE - HOUR)
    (clone / helper).write_text("y = 2")
    picture.unlink()
    commit(clone, DEADLINE + HOUR)
    handin, history, _ = read_in_time(DAY, clone, DEADLINE)
    assert handin.files[helper] == b"y = 1"
    assert set(handin.pictures) == {f"{WEEK}/figures/mine.png"}
    assert history.holds(helper, b"y = 1")


def test_a_file_too_large_to_look_at_is_said_so_as_in_the_folder(clone):
    save(clone, "x = 1\n" * 400_000, DEADLINE - HOUR)
    save(clone, "x = 1", DEADLINE + HOUR)
    handin, _, _ = read_in_time(DAY, clone, DEADLINE)
    assert "2.4 MB" in handin.unread[SCRIPT]


@pytest.mark.parametrize("claimed", [2**40, 2**62, 2**63 - 1, 2**64])
def test_a_size_that_only_a_header_claims_is_not_the_machines_fault(clone, claimed):
    save(clone, "x = 1", DEADLINE - 2 * HOUR)
    blob = "ab" + 38 * "0"
    loose = clone / ".git" / "objects" / blob[:2] / blob[2:]
    loose.parent.mkdir(exist_ok=True)
    loose.write_bytes(zlib.compress(b"blob %d\0x" % claimed))
    helper = f"100644,{blob},{WEEK}/work/helper.py"
    git(clone, "update-index", "--add", "--cacheinfo", helper)
    tree = git(clone, "write-tree", "--missing-ok")
    who = ("-c", "user.name=A", "-c", "user.email=a@b")
    made = ("commit-tree", "-p", "HEAD", "-m", "x", tree)
    when = {f"GIT_{role}_DATE": f"{DEADLINE} +0000" for role in ("AUTHOR", "COMMITTER")}
    head = subprocess.check_output(
        ["git", *who, *made], cwd=clone, text=True, env={**os.environ, **when}
    ).strip()
    git(clone, "update-ref", "HEAD", head)
    git(clone, "rm", "-q", "--cached", f"{WEEK}/work/helper.py")
    save(clone, "x = 2", DEADLINE + HOUR)
    handin, _, late = read_in_time(DAY, clone, DEADLINE)
    assert (late, handin.files[SCRIPT]) == (1, b"x = 1")


def test_one_blob_under_many_names_fills_no_disk(clone, monkeypatch):
    save(clone, "import m0", DEADLINE - HOUR)
    (clone / "blob").write_bytes(b"#" * 3_000_000)
    blob = git(clone, "hash-object", "-w", "blob")
    (clone / "blob").unlink()
    names = [f"{WEEK}/work/{name}.py" for name in ("x" * 300, *map(str, range(900)))]
    entries = "".join(f"100644 {blob}\t{name}\n" for name in names)
    command = ["git", "update-index", "--index-info"]
    subprocess.run(command, cwd=clone, input=entries.encode(), check=True)
    who = ("-c", "user.name=A", "-c", "user.email=a@b")
    for when in (DEADLINE, DEADLINE + 60):
        for role in ("AUTHOR", "COMMITTER"):
            monkeypatch.setenv(f"GIT_{role}_DATE", f"{when} +0000")
        git(clone, *who, "commit", "-q", "--allow-empty", "-m", "x")
    taken: list[int] = []
    asked = packages.read_handin

    def seen(day, folder):
        files = [path.stat() for path in folder.rglob("*.py")]
        taken.extend((len(files), sum(512 * file.st_blocks for file in files)))
        return asked(day, folder)

    monkeypatch.setattr(packages, "read_handin", seen)
    handin, _, late = read_in_time(DAY, clone, DEADLINE)
    assert (late, handin.files[SCRIPT]) == (1, b"import m0")
    assert taken[-2] <= packages.MOST + 1
    assert taken[-1] < 100_000


@pytest.mark.skipif(os.name == "nt", reason="Windows makes no links for us")
def test_links_of_a_commit_are_not_followed(clone):
    (clone / SCRIPT).parent.mkdir(parents=True)
    os.symlink("/etc/passwd", clone / SCRIPT)
    commit(clone, DEADLINE - HOUR)
    (clone / SCRIPT).unlink()
    save(clone, "x = 1", DEADLINE + HOUR)
    assert read_in_time(DAY, clone, DEADLINE)[0].files == {}


def test_a_file_that_the_repository_has_lost_is_not_there(clone):
    save(clone, "x = 1", DEADLINE - HOUR)
    blob = git(clone, "rev-parse", f"HEAD:{SCRIPT}")
    save(clone, "x = 2", DEADLINE + HOUR)
    (clone / ".git" / "objects" / blob[:2] / blob[2:]).unlink()
    assert read_in_time(DAY, clone, DEADLINE)[0].files == {}


@pytest.fixture
def pulled(tmp_path, monkeypatch):
    """Return the student's own folder, and what pulls their repository into ours."""
    monkeypatch.setenv("GIT_ALLOW_PROTOCOL", "file")
    origin = tmp_path / "origin"
    origin.mkdir()
    save(origin, "good = 1", DEADLINE - HOUR)
    (tmp_path / "class").mkdir()
    student = Student("Mia", "mia", tmp_path / "class" / "mia", url=origin.as_uri())

    def pull():
        ((_, problem),) = pull_all([student])
        assert problem == ""
        return student.path

    return origin, pull


def amend(origin: Path, text: str, when: int) -> None:
    """Rewrite the last commit, as a forced push would show it."""
    git(origin, "update-ref", "-d", "HEAD")
    save(origin, text, when)


def test_a_repository_that_was_empty_is_taken_when_something_is_pushed(pulled):
    origin, pull = pulled
    git(origin, "update-ref", "-d", "HEAD")
    pull()
    pull()
    save(origin, "first = 1", DEADLINE)
    assert (pull() / SCRIPT).read_text() == "first = 1"


@pytest.mark.parametrize(
    "attributes", ["ident", "text eol=crlf", "working-tree-encoding=UTF-32"]
)
def test_files_are_checked_out_as_large_as_they_are(pulled, attributes):
    origin, pull = pulled
    (origin / ".gitattributes").write_text(f"large.txt {attributes}\n")
    text = b"$Id$\n" * 1000
    (origin / "large.txt").write_bytes(
        text.decode().encode("utf-32") if "32" in attributes else text
    )
    save(origin, "x = 1", DEADLINE)
    (origin / "large.txt").unlink()
    size = int(git(origin, "cat-file", "-s", "HEAD:large.txt"))
    assert size == 5000
    assert (pull() / "large.txt").stat().st_size == size


@pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root reads everything"
)
def test_a_folder_that_may_not_be_read_is_no_fault_of_this_machine(clone):
    save(clone, "x = 1", DEADLINE)
    (clone / SCRIPT).parent.chmod(0)
    package, _ = collected(clone)
    (clone / SCRIPT).parent.chmod(0o700)
    assert "cannot be read" in package.handin.unread[SCRIPT]


def test_an_amended_and_forced_push_is_taken(pulled):
    origin, pull = pulled
    pull()
    amend(origin, "better = 1", DEADLINE - 60)
    assert collected(pull())[1] == "better = 1"


def test_work_in_time_that_a_late_forced_push_takes_back_still_counts(pulled):
    origin, pull = pulled
    pull()
    amend(origin, "worse(", DEADLINE + HOUR)
    clone = pull()
    package, text = collected(clone)
    assert (text, package.late) == ("good = 1", 1)
    assert (clone / SCRIPT).read_text() == "worse("
    assert collected(clone, None)[1] == "worse("
    shutil.rmtree(clone / ".git" / "refs" / "robo47")
    assert before(clone, DEADLINE, f"{WEEK}/work/") == ("", 1)


def result(passed: int, kit: str = "1", seed: int = 4711) -> Result:
    ids = counted(DAY)
    marks = [Mark(one, "passed" if i < passed else "todo") for i, one in enumerate(ids)]
    items = tuple(Mark(name, "todo") for name in item_names(DAY))
    return Result(tuple(marks), items, kit=kit, seed=seed)


def test_the_best_result_is_kept_for_who_wants_it_so(clone, tmp_path):
    facts = (tmp_path / "j", DAY, DEADLINE, 4711)
    journal = Journal(*facts)
    packages = []
    for i, passed in enumerate((3, 8, 2)):
        save(clone, f"x = {i}", DEADLINE - HOUR + i)
        packages.append(collected(clone)[0])
        journal.keep("mia", packages[-1], result(passed))
    journal.close()
    journal = Journal(*facts)  # also tomorrow
    best = journal.best("mia")
    assert (best.result.score[0], best.commit) == (8, packages[1].commit)
    assert journal.find("mia", packages[-1]).score[0] == 2
    journal.keep("mia", packages[0], result(1, seed=5))  # other inputs: begins anew
    assert journal.best("mia").result.score[0] == 1
    journal.close()


def test_a_frozen_result_is_regraded_for_nobody_but_who_asks(clone, tmp_path):
    journal = Journal(tmp_path / "j", DAY)
    save(clone, "x = 1", DEADLINE)
    package = collected(clone)[0]
    journal.keep("mia", package, result(8, kit="0.1.0"))
    newer = replace(package, kit="newer", version="0.2.0")
    assert journal.find("mia", newer) is None
    assert journal.find("mia", newer, frozen=True).kit == "0.1.0"
    journal.close()


@pytest.mark.parametrize(
    ("minutes", "late", "expected"),
    [(30, 0, (0, 0)), (-1, 2, (1, 1)), (-1441, 1, (1441, 2)), (5, None, (None, None))],
)
def test_the_table_says_how_late_in_minutes_and_begun_days(minutes, late, expected):
    one = GradedStudent(
        Student("A", "a", Path()), result(4), minutes=minutes, late=late
    )
    assert one.late_by == expected
    assert percent(one) == "50.0"


def test_a_table_for_handing_on_says_nothing_of_who_it_is():
    told = replace(result(2), error="no such folder mia", refused=("read /home/mia",))
    student = Student("Mia M", "mia", Path(), id="m@x.org")
    mia = GradedStudent(student, told, commit="abc123", minutes=5, note="mia")
    text = sheet.as_csv(sheet.nameless([mia], 4711)).decode("utf-8-sig")
    head, row = text.splitlines()
    assert "mia" not in row.lower()
    assert "abc123" not in row
    assert row.split(",")[head.split(",").index("percent")] == "25.0"
    assert sheet.nameless([mia], 4711)[0].student != sheet.nameless([mia], 1)[0].student


def test_a_day_can_be_graded_with_the_kit_as_it_was_at_a_tag():
    need((ROOT / ".git").exists(), "the kit as a git repository")
    folder = command.kit_at("HEAD")
    (folder / "README.md").write_text("half written")  # by a run that was killed
    assert command.kit_at("HEAD") == folder
    assert (folder / "README.md").read_text("utf-8") != "half written"
    assert (folder / "scripts" / "grade_class.py").is_file()
    with pytest.raises(Robo47Error, match="the kit has no tag day99"):
        command.kit_at("day99")


def test_a_lab_that_has_another_name_now_is_graded_under_its_old_one(clone):
    save(clone, "x = 1", DEADLINE)
    renamed = replace(DAY, script="day1_poses.py", was=(DAY.script,))
    package = collect(Student("Mia", "mia", clone), renamed)
    assert package.handin.files[SCRIPT] == b"x = 1"
    assert "day1_poses" not in package.commit_item.message


@pytest.mark.parametrize("asked", [["--kit", "v1"], ["--kit=v1"], ["--ki", "v1"]])
def test_the_other_kit_gets_the_rest_of_the_command(monkeypatch, tmp_path, asked):
    called = []
    monkeypatch.setattr(command, "kit_at", lambda tag: tmp_path)
    monkeypatch.setattr(command.subprocess, "call", lambda it, **_: called.extend(it))
    monkeypatch.setattr("sys.argv", ["grade_class.py", "class", *asked, "--day", "2"])
    command.with_kit("v1")
    assert called[2:] == ["class", "--day", "2", "--frozen"]


@pytest.mark.parametrize(
    ("typed", "asked", "kept"),
    [(None, "", "mia ben"), ("", "mia ben", ""), ("mia,eva", "mia", "ben")],
)
def test_again_means_nobody_everybody_or_who_is_named(typed, asked, kept):
    again = command.again_of(typed)
    assert all(map(again.asks_for, asked.split()))
    assert not any(map(again.asks_for, kept.split()))


@pytest.mark.parametrize(("number", "said"), [(1, "1 student: "), (2, "2 students: ")])
def test_a_class_of_one_is_one_student(number, said):
    everybody = [GradedStudent(Student("A", "a", Path()), result(4))] * number
    assert command.standings(Course(DAY, everybody)) == f"{said}{number} under way"


def test_a_commit_that_was_pulled_in_time_is_in_time_whatever_its_clock_says(clone):
    save(clone, "kits = 1", DEADLINE - 9 * HOUR)
    pulled = save(clone, "right = 1", 2_050_000_000)
    git(clone, "update-ref", f"refs/robo47/pulled/{DEADLINE - HOUR}", pulled)
    save(clone, "late = 1", DEADLINE + HOUR)
    package, text = collected(clone)
    assert (text, package.commit, package.late) == ("right = 1", pulled, 1)
    assert package.committed == DEADLINE - HOUR


def test_a_commit_that_was_pulled_after_the_deadline_is_not(clone):
    save(clone, "kits = 1", DEADLINE - 9 * HOUR)
    late = save(clone, "right = 1", 2_050_000_000)
    git(clone, "update-ref", f"refs/robo47/pulled/{DEADLINE + HOUR}", late)
    assert collected(clone)[1] == "kits = 1"


def test_a_commit_dated_later_than_now_is_named_and_is_not_called_not_started(clone):
    from labkit.grade.child import grade

    put(clone, {"README.md": "the kit's"})
    commit(clone, DEADLINE - 9 * HOUR)
    save(clone, "right = 1", 2_050_000_000)
    package, _ = collected(clone)
    result = grade(package, DAY)
    assert "2034-12-17" in result.error
    assert "not-started" not in {task.mistake for task in result.tasks}
