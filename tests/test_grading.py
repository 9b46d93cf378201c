"""The parts of grading: what is read, what travels, what is kept, what counts."""

import contextlib
import csv
import io
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import Executor, Future
from dataclasses import asdict, replace
from pathlib import Path
from typing import ClassVar

import pytest
from make_class import (
    DAY,
    ODD_WAY,
    SOLVED,
    STARTER,
    WEEK,
    commit,
    own_way,
    renamed,
    script,
)

from labkit.base import git
from labkit.check.tasks import TaskResult
from labkit.grade import charts, child, classroom, engine, page, similar
from labkit.grade.child import _tidy
from labkit.grade.course import Course, GradedStudent
from labkit.grade.engine import Grader, grade_package
from labkit.grade.journal import Journal
from labkit.grade.package import Package, collect, fingerprint, unpack
from labkit.grade.pull import OURS, pull_all
from labkit.grade.result import Mark, Result, from_json, ungraded
from labkit.grade.roster import Student, file_names, find_students
from labkit.grade.sheet import as_csv, plain
from labkit.handin import handin
from labkit.handin.deliverables import check_deliverables, item_names
from labkit.handin.handin import Handin
from labkit.judge import Verdict
from labkit.lesson.day import all_days, find_day
from labkit.lesson.starter import starter_of
from robo47.errors import FaultError, Robo47Error
from robo47.paths import ROOT

pytestmark = pytest.mark.kit
SCRIPT = f"{WEEK}/work/{DAY.script}"
ITEMS = tuple(item_names(DAY))
links = pytest.mark.skipif(os.name == "nt", reason="Windows asks for rights to link")


def student(folder: Path) -> Student:
    return Student("A", folder.name, folder)


def made(folder: Path, *command: str, given: bytes = b"") -> str:
    """Run git in a folder, and return what it prints."""
    command = ("git", "-c", "user.name=A", "-c", "user.email=a@b", *command)
    done = subprocess.run(
        command, input=given, capture_output=True, cwd=folder, check=True
    )
    return done.stdout.strip().decode()


def result(*statuses: str, mistakes: dict[int, str] | None = None) -> Result:
    """Return a result with these states of the tasks, and names for some mistakes."""
    named = mistakes or {}
    marks = [
        Mark(task.id, status, named.get(i, ""))
        for i, (task, status) in enumerate(zip(DAY.tasks, statuses, strict=True))
    ]
    return Result(tuple(marks), tuple(Mark(name, "todo") for name in ITEMS))


class TestWhatIsRead:
    @pytest.fixture
    def clone(self, tmp_path):
        for folder in ("work", "docs"):
            (tmp_path / WEEK / folder).mkdir(parents=True)
        (tmp_path / SCRIPT).write_text("x = 1")
        return tmp_path

    @pytest.fixture
    def read(self, clone):
        return lambda: collect(student(clone), DAY).handin

    def test_is_the_script_and_the_modules_beside_it_and_no_other_file(
        self, clone, read
    ):
        work = clone / WEEK / "work"
        (clone / SCRIPT).write_text("import helper, notes, day1")
        for name in ("helper.py", "no name.py", "notes.txt", "day1.py.bak", "day2.py"):
            (work / name).write_text("y = 2")
        (clone / "robo47").mkdir()
        (clone / "robo47" / "__init__.py").write_text("evil")
        (clone / WEEK / "week.toml").write_text("evil")
        assert sorted(read().files) == [SCRIPT, f"{WEEK}/work/helper.py"]

    def test_is_nothing_beyond_its_limit(self, clone, read):
        with (clone / SCRIPT).open("wb") as file:
            file.truncate(handin.LIMITS["script"] + 1)
        assert read().files == {}
        assert "at most 100 kB is looked at" in read().unread[SCRIPT]

    @links
    @pytest.mark.parametrize("linked", [SCRIPT, f"{WEEK}/work", WEEK])
    def test_is_nothing_behind_a_link(self, clone, read, linked):
        real = clone / "elsewhere"
        (clone / linked).rename(real)
        (clone / linked).symlink_to(real)
        assert read().files == {}
        assert "is behind a link" in read().unread[SCRIPT]

    @pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
    def test_is_no_pipe_that_would_wait_for_ever(self, clone, read):
        (clone / SCRIPT).unlink()
        os.mkfifo(clone / SCRIPT)
        assert read().unread == {SCRIPT: "is no file"}

    def test_says_of_the_worksheets_pictures_only_that_they_are_there(
        self, clone, read
    ):
        sheet = clone / WEEK / DAY.worksheet
        (clone / WEEK / "my pic.jpg").write_bytes(b"x" * 99)
        (clone.parent / "secret.jpg").write_bytes(b"x")
        sheet.write_text(
            "![](../my%20pic.jpg) ![](../../../secret.jpg) ![](/etc/passwd)\n" * 3
            + "![" * 200_000
        )
        assert sheet.stat().st_size > handin.LIMITS["worksheet"]
        assert read().pictures == {}
        sheet.write_text(sheet.read_text()[:150_000])
        assert read().pictures == {f"{WEEK}/my pic.jpg": False}
        assert sorted(read().files) == [f"{WEEK}/{DAY.worksheet}", SCRIPT]

    def test_says_of_a_picture_whether_it_is_the_kits_own(self, clone, read):
        kits = next(p for p in (DAY.folder / n for n in DAY.kit_figures) if p.is_file())
        (clone / WEEK / "mine.png").write_bytes(kits.read_bytes())
        (clone / WEEK / DAY.worksheet).write_text("![](../mine.png)")
        assert read().pictures == {f"{WEEK}/mine.png": True}

    def test_a_repository_around_the_clone_is_not_the_students(self, clone):
        subprocess.run(["git", "init", "-q"], cwd=clone, check=True)
        (clone / "inner").mkdir()
        assert not git.read_history(clone / "inner", [SCRIPT]).readable
        empty = git.read_history(clone, [SCRIPT])
        assert (empty.readable, empty.commit) == (True, "")


class TestWhatTravels:
    def test_has_another_fingerprint_as_soon_as_anything_differs(self):
        package = Package(1, "kit", Handin({"a": b"1"}), commit="c")
        others = [
            replace(package, handin=Handin({"a": b"2"})),
            replace(package, handin=Handin({"b": b"1"})),
            replace(package, handin=Handin({"a": b"1"}, {"b": "is a link"})),
            replace(package, handin=Handin({"a": b"1"}, pictures={"b": False})),
            replace(package, commit="d"),
            replace(package, committed=5),
            replace(package, problem="?"),
        ]
        prints = {one.fingerprint for one in (package, *others)}
        assert len(prints) == len(others) + 1
        assert replace(package, kit="other").fingerprint == package.fingerprint

    def test_never_leads_out_of_its_folder(self, tmp_path):
        inside = tmp_path / "inside"
        inside.mkdir()
        names = ("../out.py", "/out.py", "a\0b.py", "..\\x.py", "D:/b", "w/work/b.py")
        unpack(Package(1, "", Handin(dict.fromkeys(names, b"1"))), inside)
        made = [p.relative_to(tmp_path) for p in tmp_path.rglob("*") if p.is_file()]
        assert sorted(map(str, made)) == ["inside/b.py", "inside/out.py"]


def test_the_table_has_a_column_for_each_deliverable_of_the_checker(clone):
    found = check_deliverables(find_day(1, clone), clone)
    assert tuple(item.name for item in found) == ITEMS


def test_the_drawn_questions_are_the_same_for_everybody(monkeypatch):
    """Else the same code gets two grades; and nobody can know the teacher's seed."""
    seeds = []

    def noted(day, *_, seed, **__):
        seeds.append(seed)
        return [TaskResult(task, Verdict("passed")) for task in day.tasks]

    monkeypatch.setattr(child, "check_tasks", noted)
    own = {SCRIPT: b"import helper", f"{WEEK}/work/helper.py": b"x = 1"}
    other = {**own, f"{WEEK}/work/helper.py": b"x = 2"}
    one, two = (Package(1, "", Handin(files), seed=4711) for files in (own, other))
    for package in (one, two):
        child.grade(package, DAY)
    assert seeds == [4711, 4711]
    again = engine.signed(
        result(*["passed"] * len(DAY.tasks)), replace(one, version="0.2.0 (ff9d311)")
    )
    assert (again.kit, again.seed) == ("0.2.0 (ff9d311)", 4711)
    assert 'make check DAY=1 ARGS="--seed 4711 --explain"' in again.text
    assert one.fingerprint != replace(one, seed=4712).fingerprint


class TestTheGrader:
    @pytest.fixture
    def closed(self):
        """Return what sees to it that a grader is closed after the test."""
        with contextlib.ExitStack() as stack:
            yield lambda grader: stack.enter_context(contextlib.closing(grader))

    def test_calls_it_a_fault_where_grading_takes_too_long_or_is_killed(self):
        grader = Grader()
        package = Package(1, "", Handin({SCRIPT: SOLVED.encode()}))
        grader.process.send_signal(signal.SIGSTOP)  # it waits, and does no work
        with pytest.raises(FaultError, match="took more than 0 s"):
            grader.grade(package, beyond=-129.7)
        assert not grader.alive
        assert not Path(grader.folder).exists()
        grader = Grader()
        grader.process.kill()
        grader.process.wait()
        with pytest.raises(FaultError, match="was killed"):
            grader.grade(Package(1, ""))

    @pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs prlimit")
    def test_calls_it_a_fault_where_the_machine_has_no_room(self, closed):
        import resource

        grader, size = closed(Grader()), resource.RLIMIT_FSIZE
        files = {name: text.encode() for name, text in script(SOLVED).items()}
        package = Package(1, "", Handin(files))
        hard = resource.prlimit(grader.process.pid, size)[1]
        resource.prlimit(grader.process.pid, size, (0, hard))  # as on a full disk
        with pytest.raises(FaultError, match=r"temporary dir|File too large"):
            grader.grade(package)
        resource.prlimit(grader.process.pid, size, (hard, hard))
        assert grader.grade(package)["tasks"][0]["status"] == "passed"

    def test_that_was_killed_leaves_nothing_for_longer_than_a_day(
        self, tmp_path, monkeypatch
    ):
        monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
        names = ("robo47-grader-a", "robo47-commit-a", "robo47-grader-b", "robo47-c")
        old, commit, new, other = (tmp_path / name for name in names)
        for folder in (old, commit, new, other):
            folder.mkdir()
            (folder / "x.py").write_text("")
        for folder in (old, commit, other):
            os.utime(folder, (1_000_000_000, 1_000_000_000))
        at_work = tmp_path / f"robo47-grader-{os.getpid()}_a"  # and the clock jumped
        at_work.mkdir()
        os.utime(at_work, (5, 5))
        with engine.local(1):
            assert [*map(Path.exists, (old, commit))] == [False, False]
            assert [*map(Path.exists, (new, other))] == [True, True]
            assert at_work.exists() is sys.platform.startswith("linux")

    def test_shows_what_was_refused_though_the_code_caught_it(self):
        curious = "try: open('/etc/shadow')\n    except OSError: pass"
        text = SOLVED.replace(
            "    T = np.eye(4)", f"    {curious}\n    T = np.eye(4)", 1
        )
        files = {name: text.encode() for name, text in script(text).items()}
        found = child.grade(Package(1, "", Handin(files)), DAY)
        assert found.tasks[0].passed
        assert found.refused == ("read /etc/shadow",)
        one = GradedStudent(Student("A", "a", Path()), found)
        assert ">read /etc/shadow</p>" in page.render(Course(DAY, [one]))

    def test_grades_nothing_for_another_kit(self):
        with pytest.raises(Exception, match="check out the same commit on both"):
            grade_package(Package(1, "another"))

    def test_refuses_on_a_worker_that_nothing_protects(self, monkeypatch):
        package = Package(1, fingerprint(1), problem="nobody")
        monkeypatch.setattr(engine, "refusal", lambda: "you are root")
        with pytest.raises(Robo47Error, match=r"a worker on .* refuses: you are root"):
            grade_package(package, needs_wall=True)
        monkeypatch.setattr(engine, "refusal", lambda: "")
        assert grade_package(package, needs_wall=True)["error"] == "nobody"

    def test_ends_when_whoever_started_it_is_gone(self, tmp_path):
        command = [sys.executable, "-m", "labkit.grade.child", str(tmp_path / "own")]
        (tmp_path / "own").mkdir()
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, timeout=60, check=False
        )
        assert done.returncode == 0
        assert not (tmp_path / "own").exists()


LIE = {"tasks": [{"id": "1.1", "status": "splendid"}], "items": []}


class Stubborn(Executor):
    """An executor whose work is never done, or always lost."""

    def __init__(self, error: Exception | None = None, answer: object = None) -> None:
        self.error, self.answer = error, answer

    def submit(self, *_, **__):
        future = Future()
        if self.error:
            future.set_exception(self.error)
        if self.answer is not None:
            future.set_result(self.answer)
        return future


class TestTheEngine:
    PACKAGES: ClassVar = [(name, Package(1, "")) for name in ("ana", "béa")]

    def told(self, **how):
        """Return what two packages bring back, in words, from a stubborn worker."""
        stubborn = engine.Engine(Stubborn(**how), lambda: 1, KeyError)
        found = list(engine.grade_all(self.PACKAGES, stubborn))
        assert sorted(key for key, _, _ in found) == ["ana", "béa"]
        assert all(isinstance(result, FaultError) for _, _, result in found)
        (says,) = {str(result) for _, _, result in found}
        return says

    def test_gives_up_in_a_line_where_no_worker_comes(self, monkeypatch):
        monkeypatch.setattr(engine, "PATIENCE", 0.01)
        nobody = engine.Engine(Stubborn(), lambda: 0)
        with pytest.raises(Robo47Error, match="start workers and run the same command"):
            list(engine.grade_all(self.PACKAGES, nobody))

    def test_hands_on_what_was_lost_and_goes_on(self):
        assert "were lost" in self.told(error=KeyError("killed"))
        assert self.told(error=FaultError("full")) == "full"

    @pytest.mark.parametrize("answer", [LIE, object(), b"", {"tasks": []}, 47])
    def test_believes_no_worker_that_lies(self, answer):
        assert "is no result of the day" in self.told(answer=answer)

    @pytest.mark.parametrize("fact", [{"seed": 10**5000}, {"kit": "=1\n"}])
    def test_takes_kit_and_seed_from_no_worker(self, fact):
        answer = asdict(replace(ungraded(DAY, ""), **fact))
        liar = engine.Engine(Stubborn(answer=answer), lambda: 1)
        package = Package(1, "", seed=4711, version="0.2.0")
        ((_, _, found),) = engine.grade_all([("ana", package)], liar)
        assert (found.kit, found.seed) == ("0.2.0", 4711)

    def test_takes_megabytes_from_no_worker(self):
        answer = asdict(replace(ungraded(DAY, ""), text="x" * 10**6))
        assert "no result of the day" in self.told(answer=answer)

    @pytest.mark.parametrize("error", [ValueError, MemoryError, SystemExit, OSError])
    def test_takes_whatever_a_worker_raises_for_a_fault(self, error):
        assert error.__name__ in self.told(error=error())

    def test_waits_for_no_worker_for_ever(self, monkeypatch):
        monkeypatch.setattr(engine, "PATIENCE", 0.01)
        monkeypatch.setattr(engine, "SILENCE", 0.05)
        assert "no answer for" in self.told()

    def test_takes_packages_only_as_there_is_room(self):
        taken = []

        def packages():
            for i in range(20):
                taken.append(i)
                yield str(i), Package(1, fingerprint(1), problem="nobody")

        with engine.local(1) as here:
            next(engine.grade_all(packages(), here))
        assert len(taken) == engine.PER_WORKER


class TestTheJournal:
    PACKAGE = Package(1, "k", Handin({"a": b"1"}))

    @pytest.fixture
    def opened(self, tmp_path, monkeypatch):
        """Return what opens the journal, whatever has it open already."""
        last = contextlib.ExitStack()

        def open_it(now=99):
            last.close()
            monkeypatch.setattr(time, "time", lambda: now)
            journal = Journal(tmp_path / "j", DAY)
            return last.enter_context(contextlib.closing(journal))

        with last:
            yield open_it

    def test_keeps_results_and_survives_a_line_cut_anywhere(self, tmp_path, opened):
        path, package = tmp_path / "j", self.PACKAGE
        journal = opened()
        journal.keep("ana", package, ungraded(DAY, "why"))
        journal.keep("béa", package, ungraded(DAY, "\ud800"))
        whole = path.read_bytes()
        last = whole.rindex(b"\n")
        for cut in (last, last + 1, last + 2, len(whole) - 1):
            path.write_bytes(whole[:cut])
            resumed = opened(5)
            assert resumed.reference == 99
            assert resumed.find("ana", package) == ungraded(DAY, "why")
            assert resumed.find("béa", package) is None
            resumed.keep("cy", package, ungraded(DAY, "c"))
            again = opened(5)
            assert again.find("cy", package) == ungraded(DAY, "c")
            assert again.find("cy", replace(package, commit="new")) is None
            assert again.odd == (cut > last + 1)

    def test_uses_no_result_of_another_kit(self, opened):
        journal = opened()
        journal.keep("ana", self.PACKAGE, ungraded(DAY, "why"))
        assert journal.find("ana", replace(self.PACKAGE, kit="new")) is None
        assert journal.outdated == 1

    @pytest.mark.parametrize(
        ("old", "new"),
        [
            ('"ungraded"', '"splendid"'),
            ('"id": "1.8"', '"id": "1.9"'),
            ('"id": "commit"', '"id": "poem"'),
            ('"text": "', '"text": 5, "x": "'),
            ('"error": "why"', '"error": ["why"]'),
            ('"error": "why"', '"error": "\\ud800"'),  # nothing that is written
            ('"refused": []', '"refused": [' + '"",' * 200_000 + '""]'),
            ('"package": "', '"package": null, "x": "'),
            ('"day": 1', '"day": 7'),
            ('"result": {', '"result": ' + "[" * 100_000 + "{"),
        ],
    )
    def test_leaves_out_what_is_no_result_of_the_day(self, tmp_path, opened, old, new):
        opened().keep("ana", self.PACKAGE, ungraded(DAY, "why"))
        head, line = (tmp_path / "j").read_text().strip().split("\n")
        assert old in line
        (tmp_path / "j").write_text(f"{head}\n{line.replace(old, new)}")
        again = opened(5)
        assert (again.find("ana", self.PACKAGE), again.odd) == (None, 1)

    @pytest.mark.parametrize("reference", ["1e30", "-5", '"x"', "true", "null"])
    def test_starts_anew_where_its_head_means_nothing(
        self, tmp_path, opened, reference
    ):
        head = f'{{"kind": "robo47 grading", "days": [1], "reference": {reference}}}'
        (tmp_path / "j").write_text(head)
        journal = opened(47)
        assert (journal.reference, journal.odd) == (47, 1)

    @pytest.mark.parametrize("now", [-5, 0, 10**11])
    def test_knows_its_seed_again_whatever_the_clock_says(self, opened, now):
        first = opened(now)
        seed = first.seed
        again = opened(1_788_000_000)
        assert (again.seed, again.odd) == (seed, 0)

    def test_results_come_back_as_they_were(self):
        one = replace(ungraded(DAY, "why"), refused=("open a file",))
        assert from_json(asdict(one), DAY) == Result(**{**vars(one)})


class TestNames:
    def test_never_leave_their_folder_and_are_never_alike(self):
        odd = ["../../escaped", "/etc", "./ada", "ada/", "ada", "ADA", "a\\b", "a_b"]
        odd += ["..", "CON", "con.txt", "D:x", "x.", "x", "n\0l", "ñ" * 120, "ñ" * 121]
        odd += ["\udc80", "\u202eabc", "a/b", "c/b", ""]
        names = file_names(odd)
        assert set(names) == set(odd)
        folded = {name.casefold() for name in names.values()}
        assert len(folded) == len(odd)
        for name in names.values():
            assert not set('/\\:*?"<>|\0') & set(name)
            assert name not in ("", ".", "..")
            assert len(name.encode()) < 200

    def test_stay_as_they_are_where_every_system_takes_them(self):
        plain = ["ana", "Zoë Ångström", "名前 山田", "-rf"]
        assert file_names(plain) == dict(zip(plain, plain, strict=True))

    @pytest.mark.parametrize(
        ("text", "says"),
        [
            (b"name,git\nAda,x\n", "no column folder"),
            (b"folder\na\nb\na\n", "line 4: folder 'a' is listed twice"),
            (b"folder\n\xff\xfe\n", "not in UTF-8"),
            (b"", "no column folder"),
            (b"folder\n", "no folders"),
            (
                b'folder,name\na,"' + b"x" * 200_000,
                r"roster\.csv, line 2: field larger",
            ),
        ],
    )
    def test_of_a_roster_that_is_wrong_are_refused_in_a_line(
        self, tmp_path, text, says
    ):
        (tmp_path / "roster.csv").write_bytes(text)
        with pytest.raises(Robo47Error, match=says):
            find_students(tmp_path)

    def test_that_no_folder_can_have_are_said_so(self, tmp_path):
        (tmp_path / "roster.csv").write_text("folder\na\0b\n")
        (one,) = find_students(tmp_path)
        assert "is no name of a folder" in one.problem
        (tmp_path / "roster.csv").write_text(f"folder\n{'x' * 300}\nana\n")
        long, ana = find_students(tmp_path)
        assert "no name of a folder here" in long.problem
        assert (ana.problem, collect(long, DAY).problem) == ("", long.problem)

    def test_whose_address_no_program_can_be_given_are_said_so(self, tmp_path):
        (tmp_path / "roster.csv").write_text("folder,git\na,https://x/a\0b\n")
        (one,) = find_students(tmp_path)
        assert "is no git URL" in one.problem


class TestPulling:
    """Only what this program cloned is updated."""

    @pytest.fixture
    def class_(self, tmp_path):
        origin = tmp_path / "origin"
        origin.mkdir()
        commit(origin, 1_788_000_000)
        (tmp_path / "clones").mkdir()
        return Student("A", "a", tmp_path / "clones" / "a", str(origin))

    def test_pulls_nothing_that_it_did_not_clone(self, class_):
        subprocess.run(["git", "clone", "-q", class_.url, class_.path], check=True)
        ((_, problem),) = pull_all([class_])
        assert "make grade did not clone it" in problem

    @pytest.mark.parametrize("at", ["_mark", "json.dumps"])
    def test_goes_on_where_a_run_was_killed(self, class_, at):
        code = (
            "import os, sys\n"
            "from pathlib import Path\n"
            "from labkit.grade import pull\n"
            "from labkit.grade.roster import Student\n"
            f"pull.{at} = lambda *_, **__: os._exit(9)\n"
            "list(pull.pull_all([Student('A', 'a', Path(sys.argv[1]), sys.argv[2])]))\n"
        )
        command = [sys.executable, "-c", code, str(class_.path), class_.url]
        assert subprocess.run(command, cwd=ROOT, check=False).returncode == 9
        assert list(pull_all([class_])) == [(class_, "")]
        assert (class_.path / ".git" / "HEAD").is_file()
        assert [p.name for p in class_.path.parent.iterdir() if p != class_.path] == [
            OURS
        ]

    def test_goes_on_where_a_run_was_killed_amid_an_update(self, class_):
        assert list(pull_all([class_])) == [(class_, "")]
        (Path(class_.url) / "new.txt").write_text("new")
        (Path(class_.url) / "later.txt").write_text("later")
        commit(Path(class_.url), 1_788_000_100)
        (class_.path / "new.txt").write_text("half")
        (class_.path / ".git" / "index.lock").touch()
        assert list(pull_all([class_])) == [(class_, "")]
        assert (class_.path / "new.txt").read_text() == "new"
        assert (class_.path / "later.txt").read_text() == "later"

    @pytest.mark.parametrize("what", ["one blob 60 times", "a tree of trees"])
    @pytest.mark.parametrize("first", [True, False])
    def test_checks_out_no_small_repository_that_grows(
        self, class_, what, first, monkeypatch
    ):
        origin = Path(class_.url)
        if not first:
            monkeypatch.setattr(git, "MOST_FILES", 1000)  # git lists fewer
            list(pull_all([class_]))

        blob = made(origin, "hash-object", "-w", "--stdin", given=bytes(4_000_000))
        names = range(60) if first or what == "a tree of trees" else range(51)
        entries = [f"100644 blob {blob}\t{i}\n" for i in names]
        tree = made(origin, "mktree", given="".join(entries).encode())
        for _ in range(5 if what == "a tree of trees" else 0):
            entries = [f"040000 tree {tree}\t{i}\n" for i in range(60)]
            tree = made(origin, "mktree", given="".join(entries).encode())
        parent = made(origin, "rev-parse", "HEAD")
        words = ("commit-tree", "-m", "x", "-p", parent, tree)
        made(origin, "update-ref", "HEAD", made(origin, *words))
        ((_, problem),) = pull_all([class_])
        assert "the last commit is too large to check out" in problem
        assert class_.path.exists() is not first
        found = class_.path.parent.rglob("50")  # some object may be named so, too
        assert not [p for p in found if ".git" not in p.parts]

    def test_checks_out_no_folders_deep_in_each_other(self, class_):
        origin = Path(class_.url)
        blob = made(origin, "hash-object", "-w", "--stdin", given=b"x")
        entry = f"100644 blob {blob}\tf\n"
        for _ in range(git.DEEPEST + 1):
            tree = made(origin, "mktree", given=entry.encode())
            entry = f"040000 tree {tree}\td\n"
        parent = made(origin, "rev-parse", "HEAD")
        tree = made(origin, "mktree", given=entry.encode())
        words = ("commit-tree", "-m", "x", "-p", parent, tree)
        made(origin, "update-ref", "HEAD", made(origin, *words))
        ((_, problem),) = pull_all([class_])
        assert f"more than {git.DEEPEST} deep" in problem
        assert not class_.path.exists()

    def test_folders_that_cannot_be_removed_cost_one_student(self, class_, monkeypatch):
        def deep(*_, **__):
            raise RecursionError

        monkeypatch.setattr(shutil, "rmtree", deep)
        ((student, problem),) = pull_all([class_])
        assert student is class_
        assert "too deep" in problem

    @pytest.mark.parametrize("how", ["commondir", "config", "link", "elsewhere"])
    def test_pulls_nothing_whose_configuration_is_anothers(self, class_, how, tmp_path):
        list(pull_all([class_]))
        git_folder, evil = class_.path / ".git", class_.path / "evil"
        program = f'[core]\n\tsshCommand = "touch {tmp_path}/pwned; false"\n'
        program += '[remote "origin"]\n\turl = ssh://127.0.0.1/x\n'
        if how == "config":
            with (git_folder / "config").open("a") as config:
                config.write(program)
        else:
            shutil.copytree(git_folder, evil)
            with (evil / "config").open("a") as config:
                config.write(program)
        if how == "commondir":
            (evil / "HEAD").unlink()
            (git_folder / "commondir").write_text("../evil\n")
        if how in ("link", "elsewhere"):
            shutil.rmtree(git_folder)
        if how == "link":
            git_folder.symlink_to(evil)
        if how == "elsewhere":
            git_folder.write_text(f"gitdir: {evil}\n")
        ((_, problem),) = pull_all([class_])
        assert "its git configuration was changed" in problem
        assert not (tmp_path / "pwned").exists()


class TestHistory:
    @pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
    @pytest.mark.parametrize(
        "name",
        [
            *("HEAD", "config", "packed-refs", "shallow", "info/grafts"),
            *("refs/heads/main", "config.worktree", "objects/info/alternates"),
            *("objects/info/commit-graph", "objects/pack/multi-pack-index"),
            *("objects/pack/pack-1.idx", "any/thing/else"),
        ],
    )
    def test_does_not_wait_at_a_pipe(self, tmp_path, name, monkeypatch):
        monkeypatch.setattr(git, "run", lambda *_, **__: pytest.fail("git was asked"))
        commit(tmp_path, 1_788_000_000)
        path = tmp_path / ".git" / name
        path.unlink(missing_ok=True)
        path.parent.mkdir(parents=True, exist_ok=True)
        os.mkfifo(path)
        assert not git.read_history(tmp_path, [SCRIPT]).readable

    @pytest.mark.parametrize(
        "name", ["commondir", "objects/info/alternates", "config", "config.worktree"]
    )
    def test_follows_nothing_that_leads_out_of_the_repository(self, tmp_path, name):
        commit(tmp_path, 1_788_000_000)
        path = tmp_path / ".git" / name
        path.parent.mkdir(exist_ok=True)
        out = "[core] [INCLUDE] path = /pipe" if "config" in name else "/elsewhere"
        with path.open("a") as file:
            file.write(f"\n{out}\n")
        assert not git.read_history(tmp_path, [SCRIPT]).readable

    def test_asks_once_what_takes_all_its_time(self, tmp_path, monkeypatch):
        commit(tmp_path, 1_788_000_000)
        asked = []

        def slow(*arguments, **_):
            asked.append(arguments)
            raise git._SlowError

        monkeypatch.setattr(git, "run", slow)
        assert not git.read_history(tmp_path, [SCRIPT]).readable
        assert len(asked) == 1

    def test_reads_no_configuration_of_megabytes(self, tmp_path):
        commit(tmp_path, 1_788_000_000)
        os.truncate(tmp_path / ".git" / "config", 10**9 // 2)  # a sparse file
        assert not git.read_history(tmp_path, [SCRIPT]).readable

    @pytest.mark.parametrize("what", ["a file of a terabyte", "many files"])
    def test_reads_nothing_of_a_repository_beyond_all_measure(
        self, tmp_path, what, monkeypatch
    ):
        commit(tmp_path, 1_788_000_000)
        assert git.read_history(tmp_path, [SCRIPT]).readable
        if what == "many files":
            monkeypatch.setattr(git, "MOST_ENTRIES", 1000)
            (tmp_path / ".git" / "x").mkdir()
            for i in range(git.MOST_ENTRIES):
                (tmp_path / ".git" / "x" / str(i)).touch()
        else:  # which takes no place on the disk
            with (tmp_path / ".git" / "packed-refs").open("wb") as file:
                file.truncate(10**12)
        assert not git.read_history(tmp_path, [SCRIPT]).readable

    @pytest.mark.parametrize("when", ["99999999999999999999", "-1", "soon"])
    def test_believes_no_impossible_time(self, when):
        text = f"tree 0\ncommitter A <a@b> {when} +0000\n\nwords\ncommitter x 5 +0\n"
        assert git._signed(text, "committer")[1] is None
        text = text.replace(when, "1788000000")
        assert git._signed(text, "committer")[1] == 1_788_000_000

    def test_reads_no_commit_of_megabytes(self, tmp_path):
        commit(tmp_path, 1_788_000_000)
        assert git.read_history(tmp_path, []).committed == 1_788_000_000
        how = ("commit", "-q", "--allow-empty", "-F", "-")
        made(tmp_path, *how, given=b"x" * 200_000)
        assert not git.read_history(tmp_path, []).readable


def test_a_text_of_any_size_is_tidied_at_once():
    assert len(_tidy("robo47-check-" + "x" * 3_000_000)) < 500
    assert len(_tidy("a\n" * 2_000_000).splitlines()) <= 200
    assert _tidy("  1.1  x\r\n\x1b[2J at 0x7f0123456789") == "  1.1  x\n[2J at 0x..."


class TestSimilarity:
    def test_finds_a_copy_under_other_names_and_comments(self):
        own = similar.runs_of(own_way(ODD_WAY).encode(), STARTER)
        copy = similar.runs_of(own_way(renamed(ODD_WAY)).encode(), STARTER)
        assert renamed(ODD_WAY) != ODD_WAY
        (group,) = similar.similar_groups({"b": copy, "a": own})
        assert (group.keys, group.share) == (("a", "b"), 1.0)

    def test_sees_nothing_in_what_the_starter_gave_or_everybody_writes(self):
        assert len(similar.runs_of(STARTER.encode(), STARTER)) == 0
        assert similar.similar_groups({"a": similar.runs_of(b"", STARTER)}) == []
        runs = similar.runs_of(SOLVED.encode(), STARTER)
        assert len(runs) > similar.FEWEST
        assert similar.similar_groups({str(i): runs for i in range(9)}) == []

    def test_knows_the_kits_own_solution_however_many_hand_it_in(self):
        kit = similar.runs_of(SOLVED.encode(), STARTER)
        own = similar.runs_of(own_way(ODD_WAY).encode(), STARTER)
        right = (DAY.own / "submissions").glob("*/*.py")
        runs = {p.stem: [similar.runs_of(p.read_bytes(), STARTER)] for p in right}
        assert len(runs) > 5
        assert similar.like_the_kit(runs, kit) == []
        copies = {str(i): [own[:0], kit] for i in range(30)}  # in a helper beside it
        found = similar.like_the_kit({**runs, **copies}, kit)
        assert sorted(group.keys[0] for group in found) == sorted(copies)
        assert all(group.with_kit and group.share == 1 for group in found)

    def test_knows_the_kits_library_copied_into_a_helper(self):
        kit = classroom._runs_of_kit(DAY)
        name = DAY.library[0]
        text = (ROOT / "robo47" / f"{name}.py").read_bytes()
        own = similar.runs_of(own_way(ODD_WAY).encode(), STARTER)
        copy = similar.runs_of(text.replace(b"rotation", b"turn"), STARTER)
        (group,) = similar.like_the_kit({"a": [own, copy], "b": [own]}, kit)
        assert (group.keys, group.with_kit) == (("a",), True)

    @pytest.mark.parametrize("hide", ["more", "pass", "helper", "names"])
    def test_knows_the_kits_functions_beside_whatever_else(self, hide):
        text = SOLVED
        if hide == "more":
            text += "".join(
                f"\n\ndef f{i}(a, b):\n    return a[{i}] ** {i} - np.tan(b * {i}) / a\n"
                for i in range(60)
            )
        if hide == "pass":
            assigned = r"(?m)^((?:    )+\w+ = [^#\n]+[^,(\[{\n])$"
            text = re.sub(assigned, r"\1; pass; unused = 0", text)
            assert text.count("; pass") > 9
        if hide == "names":
            text = renamed(text)
        kit, parts = classroom._runs_of_kit(DAY), classroom._runs_of_functions(DAY)
        files = [similar.runs_of(text.encode(), STARTER)]
        if hide == "helper":
            files.insert(0, similar.runs_of(b"from copied import *", STARTER))
        (group,) = similar.like_the_kit({"a": files}, kit, parts)
        assert (group.keys, group.with_kit) == (("a",), True)

    def test_calls_no_ordinary_right_answer_a_copy_function_by_function(self):
        for day in all_days():
            parts = classroom._runs_of_functions(day)
            assert sum(len(part) > 0 for part in parts) > 6
            for path in (day.own / "submissions").glob("*/*.py"):
                own = [similar.runs_of(path.read_bytes(), starter_of(day))]
                assert similar.like_the_kit({"a": own}, own[0][:0], parts) == [], path

    @pytest.mark.parametrize("source", [b"\xff\0" * 999, b'"""' * 9999, b" " * 900_000])
    def test_takes_any_bytes_in_reasonable_time(self, source):
        similar.runs_of(source, STARTER)
        similar.functions_of(source.decode("utf-8", "replace"))

    @pytest.mark.parametrize("quote", ['"""', "'''", '"', "\\"])
    def test_takes_texts_without_an_end_in_reasonable_time(self, quote):
        for text in (f"\\{quote}" * 30_000, f"{quote}\\" * 30_000, f"a{quote}" * 9999):
            similar.functions_of(text)


RZ = "def Rz(theta):\n    return 1\n"


class TestWhatDoesNotShow:
    @pytest.mark.parametrize(
        "text",
        [
            f"exec('''{RZ}''')",
            f'x = """\n{RZ}"""\nexec(x)',
            f"x = '\\''; y = '''\n{RZ}'''",
            f"# {RZ.splitlines()[0]}\nRz = other",
            "from elsewhere import Rz",
            f"{RZ}from elsewhere import Rz",
            f"{RZ}from elsewhere import *",
            f"{RZ}Rz = elsewhere.Rz",
            "class A:\n    def Rz(theta): pass\nRz = A.Rz",
            "",
        ],
    )
    def test_is_a_function_that_stands_in_no_file(self, text):
        assert "no function Rz" in similar.hidden([text], [("Rz",)])

    @pytest.mark.parametrize(
        "texts",
        [
            [RZ],
            [f"from math import *\n{RZ}import numpy\nx = 1\nRzz = 2"],
            ["from mine import Rz", RZ],
            ["Rz = lambda theta: 1"],
            [f'"""A lab."""\n\n@wraps\n{RZ}'],
            [RZ.replace("Rz", "\uff32\uff5a")],  # Python reads it as Rz
            [f"x = (1,\n2)\n{RZ}"],
        ],
    )
    def test_is_nothing_of_an_ordinary_file(self, texts):
        assert similar.hidden(texts, [("Rz",)]) == []

    def test_is_not_asked_of_what_does_not_pass(self):
        assert similar.hidden(["exec(x)"], []) == []

    @pytest.mark.parametrize(
        "runs",
        [
            "timeit.Timer(setup=DATA).timeit(1)",
            "bdb.Bdb().run(DATA)",
            "trace.Trace(count=0).runctx(DATA, {}, {})",
            "cProfile.Profile().runctx(DATA, {}, {})",
            "exec(DATA)",
            "getattr(builtins, NAME)(DATA)",
            "print.__self__.__dict__[NAME](DATA)",
            "code.InteractiveInterpreter().runsource(DATA)",
            "importlib.util.spec_from_loader(NAME, Loader(DATA))",
            "marshal.loads(DATA)",
            "runpy.run_path(NAME)",
        ],
    )
    @pytest.mark.parametrize(
        "data",
        [f"DATA = '{'c$k;' * 200}'", "DATA = [\n{}]", "DATA = (1 and\n{})"],
    )
    def test_is_code_kept_in_text_constants_whatever_runs_it(self, runs, data):
        many = "".join(f"'{i:04}c$k;{i * 7919:09}',\n" for i in range(60))
        text = f"{data.replace('{}', many)}\n{RZ}{runs}\n"
        assert similar.hidden([text], [("Rz",)])[-1].endswith(
            "characters of text constants that are no docstrings"
        )

    def test_is_no_docstring_unless_the_file_reads_it(self):
        text = RZ + f'def f():\n    """{"A long word. " * 80}"""\n'
        assert similar.hidden([text], [("Rz",)]) == []
        (says,) = similar.hidden([f"{text}x = f.__doc__\n"], [("Rz",)])
        assert "text constants" in says

    def test_may_go_by_an_older_name(self):
        assert similar.hidden([RZ], [("turned", "Rz")]) == []

    @pytest.mark.parametrize(
        "text",
        [
            "exec(x)",
            "\uff45xec(x)",
            "builtins.exec",
            "__builtins__[y]",
            "getattr(print, '__self__')",
            "class E:\n    def __reduce__(self): return x",
            "code.InteractiveInterpreter().runsource(x)",
        ],
    )
    def test_is_a_text_that_runs_as_code(self, text):
        (says,) = similar.hidden([f"{RZ}\n{text}"], [("Rz",)])[:1]
        assert says.startswith("a text can run as code: ")

    def test_is_told_on_the_page_by_name_and_escaped(self):
        one = replace(graded(*["passed"] * 8, name="Mia"), hidden=("no function <Rz>",))
        text = page.render(Course(DAY, [one]))
        assert "Passes, and does not show in the file" in text
        assert "no function &lt;Rz&gt;" in text

    def test_is_nothing_of_the_kits_own_lab_on_any_day(self):
        for day in all_days():
            done = [Mark(task.id, "passed") for task in day.tasks]
            files = {
                f"work/{name}": day.source.with_name(name).read_bytes()
                for name in (day.source.name, "kit.py")
            }
            package = Package(day.number, "", Handin(files))
            assert classroom._hidden(package, day, Result(tuple(done), ())) == []


def graded(*statuses: str, name: str = "", mistakes: dict[int, str] | None = None):
    return GradedStudent(
        Student(name, name, Path()), result(*statuses, mistakes=mistakes)
    )


def standing(class_: Sequence[GradedStudent]) -> list[tuple[str, ...]]:
    """Return what the page says beside each task, and the colours of its bar."""
    _, _, chart = page.render(Course(DAY, class_)).partition('aria-label="Tasks">')
    rows = chart.partition("</div></div>")[0].split('role="listitem"')[1:]
    return [
        (
            re.search(r'class="muted">([^<]*)<', row)[1],
            *re.findall(r'fill="var\(--(?!grid)([\w-]+)\)" stroke', row),
        )
        for row in rows
    ]


class TestTheOverview:
    def test_counts_a_mistake_where_it_was_made_once_per_student(self):
        passed = ["passed"] * 8
        two, both = {0: "shape", 2: "follows"}, {0: "shape", 1: "shape"}
        class_ = [
            graded("wrong", "passed", "wrong", *passed[3:], name="a", mistakes=two),
            graded("wrong", "wrong", *passed[2:], name="b", mistakes=both),
            graded("todo", *passed[1:], name="c", mistakes={0: "unwritten"}),
        ]
        ((mark, who),) = Course(DAY, class_).mistakes()
        assert (mark.mistake, mark.id, who) == ("shape", "1.1", ["a", "b"])

    def test_leads_with_what_can_be_explained_in_bars_of_the_whole_class(self):
        passed = ["passed"] * 7
        stops = [graded("wrong", *passed, name=n, mistakes={0: "raises"}) for n in "ab"]
        named = graded("wrong", *passed, name="c", mistakes={0: "sign"})
        class_ = [*stops, named, graded(*["passed"] * 8, name="d")]
        found = Course(DAY, class_).mistakes()
        assert [(mark.mistake, len(who)) for mark, who in found] == [
            ("sign", 1),
            ("raises", 2),
        ]
        text = page.render(Course(DAY, class_))
        first, second = re.findall(r'width="([\d.]+)%"[^>]*var\(--line\)', text)
        assert (first, second) == ("25.00", "50.00")
        assert ">1 of 4 students</span>" in text
        assert ">1.1  it stopped with an error</span>" in text

    @pytest.mark.parametrize(
        ("statuses", "state"),
        [
            (["passed"] * 8, "done"),
            (["passed"] * 7 + ["todo"], "under way"),
            (["todo"] * 8, "not started"),
            (["todo"] * 7 + ["close"], "stuck"),
            (["passed"] * 7 + ["wrong"], "stuck"),
            (["ungraded"] * 8, "ungraded"),
        ],
    )
    def test_says_where_a_student_is(self, statuses, state):
        wrong = {i: "name" for i, s in enumerate(statuses) if s in ("close", "wrong")}
        assert graded(*statuses, mistakes=wrong).state == state

    def test_a_file_that_does_not_load_is_no_mistake_in_a_task(self):
        broken = dict.fromkeys(range(8), "does-not-load")
        one = graded(*["todo"] * 8, mistakes=broken)
        assert one.state == "does not load"
        assert Course(DAY, [one]).mistakes() == []
        assert standing([one]) == [("0 pass", "broken")] * 8

    def test_counts_who_stops_where(self):
        class_ = [graded("passed", *["wrong"] * 7)] * 2
        first, second, *others = standing(class_)
        assert first == ("2 pass", "bar-pass")
        assert second == ("0 pass, 2 stopped here", "bar-fail")
        assert others == [("0 pass", "bar-fail")] * 6


def test_equal_marks_are_held_once_for_the_whole_class():
    one, two = (
        from_json(asdict(result("passed", "wrong", *["todo"] * 6)), DAY) for _ in "ab"
    )
    assert one == two
    assert all(a is b for a, b in zip(one.tasks, two.tasks, strict=True))
    assert from_json(asdict(one), DAY) == one


def test_bars_fill_their_line_and_escape_their_words():
    parts = [("pass", 1), ("fail", 3)]
    html = charts.chart([charts.Row("<a>", "1 & 2", parts, 4)], "<x>")
    assert 'x="0.00%" width="25.00%"' in html
    assert 'x="25.00%" width="75.00%"' in html
    assert not [word for word in ("<a>", "<x>") if word in html]


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("=1+1", "'=1+1"),
        (" @x", "'@x"),
        ("-5", "'-5"),
        ("a\nb\0c", "a b c"),
        ("\u202ea\x9bb", "a b"),
        (";=cmd|' /C calc'!A0", ",=cmd¦' /C calc'!A0"),
        (
            "read as (x, y, z, w); here w is first",
            "read as (x, y, z, w) – here w is first",
        ),
        ("; =1+1", "– =1+1"),
        ("＝1+1", "'＝1+1"),
        ("﹦1+1", "'﹦1+1"),
        ("\ud800", "\\ud800"),
        ("Zoë", "Zoë"),
    ],
)
def test_a_cell_is_one_line_of_plain_text(text, shown):
    assert plain(text) == shown


def test_a_mistakes_name_and_sentence_reach_the_table_as_plain_text():
    slips = result("wrong", *["todo"] * 7, mistakes={0: "named; =1+1"})
    told = replace(slips.tasks[0], message="=1+1; @x|y")
    one = GradedStudent(Student("A", "a", Path()), replace(slips, tasks=(told,)))
    head, row = csv.reader(io.StringIO(as_csv([one]).decode("utf-8-sig")))
    cells = dict(zip(head, row, strict=True))
    assert cells["what_it_says"] == "'=1+1 – @x¦y"
    assert cells["first_mistake"] == f"{told.id} named – =1+1"


def test_the_kits_own_solution_is_known_on_every_day():
    for day in all_days():
        assert len(classroom._runs_of_kit(day)) > 20, day.number
