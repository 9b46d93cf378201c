"""The parts of grading: what is read, what travels, what is kept, what counts."""

import os
import subprocess
import sys
from collections import Counter
from concurrent.futures import Executor, Future
from dataclasses import replace
from pathlib import Path
from typing import ClassVar

import pytest
from make_class import DAY, ODD_WAY, SOLVED, STARTER, WEEK, own_way, renamed

from robo47.checker.deliverables import check_deliverables
from robo47.errors import Robo47Error
from robo47.grading import bars, collect, engine, history, kit, overview, similar
from robo47.grading.feedback import feedback_path
from robo47.grading.grader import Grader, grade_package
from robo47.grading.journal import Journal
from robo47.grading.package import Package
from robo47.grading.result import ITEMS, Mark, Result, from_json, ungraded
from robo47.grading.roster import Student
from robo47.grading.sheet import Graded, plain
from robo47.lesson.day import find_day

SCRIPT = f"{WEEK}/work/{DAY.script}"
links = pytest.mark.skipif(os.name == "nt", reason="Windows asks for rights to link")


def student(folder: Path) -> Student:
    return Student("A", folder.name, folder)


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
        (tmp_path / WEEK / "work").mkdir(parents=True)
        (tmp_path / SCRIPT).write_text("x = 1")
        return tmp_path

    def test_is_the_script_and_the_modules_beside_it_and_no_other_file(self, clone):
        work = clone / WEEK / "work"
        for name in ("helper.py", "no name.py", "notes.txt", "day1.py.bak"):
            (work / name).write_text("y = 2")
        (clone / "robo47").mkdir()
        (clone / "robo47" / "__init__.py").write_text("evil")
        (clone / WEEK / "week.toml").write_text("evil")
        files = collect.collect(student(clone), DAY).files
        assert sorted(files) == [SCRIPT, f"{WEEK}/work/helper.py"]

    def test_is_nothing_beyond_its_limit(self, clone):
        with (clone / SCRIPT).open("wb") as file:
            file.truncate(collect.SCRIPT + 1)
        package = collect.collect(student(clone), DAY)
        assert package.files == {}
        assert "at most 1 MB is looked at" in package.unread[SCRIPT]

    @links
    @pytest.mark.parametrize("linked", [SCRIPT, f"{WEEK}/work", WEEK])
    def test_is_nothing_behind_a_link(self, clone, tmp_path, linked):
        real = tmp_path / "elsewhere"
        (clone / linked).rename(real)
        (clone / linked).symlink_to(real)
        package = collect.collect(student(clone), DAY)
        assert package.files == {}
        assert "is behind a link" in package.unread[SCRIPT]

    @pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
    def test_is_no_pipe_that_would_wait_for_ever(self, clone):
        (clone / SCRIPT).unlink()
        os.mkfifo(clone / SCRIPT)
        assert collect.collect(student(clone), DAY).unread == {SCRIPT: "is no file"}

    def test_says_of_the_worksheets_pictures_only_that_they_are_there(self, clone):
        sheet = clone / WEEK / DAY.worksheet
        sheet.parent.mkdir()
        (clone / WEEK / "my pic.jpg").write_bytes(b"x" * 99)
        (clone.parent / "secret.jpg").write_bytes(b"x")
        sheet.write_text(
            "![](../my%20pic.jpg) ![](../../../secret.jpg) ![](/etc/passwd)\n" * 3
            + "![" * 200_000
        )
        files = collect.collect(student(clone), DAY).files
        pictures = {n: d for n, d in files.items() if n not in (SCRIPT, sheet)}
        pictures.pop(f"{WEEK}/{DAY.worksheet}")
        assert pictures == {f"{WEEK}/my pic.jpg": b"x"}

    def test_takes_along_a_picture_that_is_the_kits_own(self, clone):
        kits = next(p for p in (DAY.folder / n for n in DAY.kit_figures) if p.is_file())
        sheet = clone / WEEK / DAY.worksheet
        sheet.parent.mkdir()
        (clone / WEEK / "mine.png").write_bytes(kits.read_bytes())
        sheet.write_text("![](../mine.png)")
        files = collect.collect(student(clone), DAY).files
        assert files[f"{WEEK}/mine.png"] == kits.read_bytes()

    def test_a_repository_around_the_clone_is_not_the_students(self, clone):
        subprocess.run(["git", "init", "-q"], cwd=clone, check=True)
        (clone / "inner").mkdir()
        assert not history.read_history(clone / "inner", [SCRIPT]).readable
        empty = history.read_history(clone, [SCRIPT])
        assert (empty.readable, empty.commit) == (True, "")


class TestWhatTravels:
    def test_has_another_fingerprint_as_soon_as_anything_differs(self):
        package = Package(1, "kit", {"a": b"1"}, commit="c")
        others = [
            replace(package, files={"a": b"2"}),
            replace(package, files={"b": b"1"}),
            replace(package, unread={"b": "is a link"}),
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
        names = ("../out.py", "/out.py", "a/../../out.py", "a\0b", "x" * 999, "good/b")
        Package(1, "", dict.fromkeys(names, b"1")).unpack(inside)
        assert [p.name for p in tmp_path.rglob("*") if p.is_file()] == ["b"]


def test_the_table_has_a_column_for_each_deliverable_of_the_checker(clone):
    found = check_deliverables(find_day(1, clone), clone)
    assert tuple(item.name for item in found) == ITEMS


class TestTheGrader:
    def test_says_so_where_grading_takes_too_long_or_crashes(self):
        grader = Grader()
        late = grader.grade(Package(1, "", {SCRIPT: SOLVED.encode()}), seconds=0.001)
        assert "took more than 0 s" in late.error
        assert not grader.alive
        assert not Path(grader.folder).exists()
        grader = Grader()
        grader.process.kill()
        grader.process.wait()
        assert "it crashed" in grader.grade(Package(1, "")).error

    def test_grades_nothing_for_another_kit(self):
        with pytest.raises(Exception, match="check out the same commit on both"):
            grade_package(Package(1, "another"))

    def test_ends_when_whoever_started_it_is_gone(self, tmp_path):
        command = [sys.executable, "-m", "robo47.grading.child", str(tmp_path / "own")]
        (tmp_path / "own").mkdir()
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, timeout=60, check=False
        )
        assert done.returncode == 0
        assert not (tmp_path / "own").exists()


class Stubborn(Executor):
    """An executor whose work is never done, or always lost."""

    def __init__(self, error: Exception | None = None) -> None:
        self.error = error

    def submit(self, *_, **__):
        future = Future()
        if self.error:
            future.set_exception(self.error)
        return future


class TestTheEngine:
    PACKAGES: ClassVar = [("ana", Package(1, "")), ("béa", Package(1, ""))]

    def test_gives_up_in_a_line_where_no_worker_comes(self, monkeypatch):
        monkeypatch.setattr(engine, "PATIENCE", 0.01)
        nobody = engine.Engine(Stubborn(), lambda: 0)
        with pytest.raises(Robo47Error, match="start workers and run the same command"):
            list(engine.grade_all(self.PACKAGES, nobody))

    def test_hands_on_what_was_lost_and_goes_on(self):
        lossy = engine.Engine(Stubborn(KeyError("killed")), lambda: 1, KeyError)
        found = list(engine.grade_all(self.PACKAGES, lossy))
        assert sorted(key for key, _, _ in found) == ["ana", "béa"]
        assert all(isinstance(result, engine.LostError) for _, _, result in found)

    def test_takes_packages_only_as_there_is_room(self):
        taken = []

        def packages():
            for i in range(20):
                taken.append(i)
                yield str(i), Package(1, kit.fingerprint(), problem="nobody")

        with engine.local(1) as here:
            next(engine.grade_all(packages(), here))
        assert len(taken) == engine.PER_WORKER


class TestTheJournal:
    def test_keeps_results_and_survives_a_line_cut_anywhere(self, tmp_path):
        path, package = tmp_path / "j", Package(1, "k", {"a": b"1"})
        journal = Journal(path, 1, 99, deadline=False)
        journal.keep("ana", package, ungraded(DAY, "why"))
        journal.keep("béa", package, ungraded(DAY, "\ud800"))
        journal.close()
        whole = path.read_bytes()
        last = whole.rindex(b"\n")
        for cut in (last, last + 1, last + 2, len(whole) - 1):
            path.write_bytes(whole[:cut])
            resumed = Journal(path, 1, 5, deadline=False)
            assert resumed.reference == 99
            assert resumed.find("ana", package) == ungraded(DAY, "why")
            assert resumed.find("béa", package) is None
            resumed.keep("cy", package, ungraded(DAY, "c"))
            resumed.close()
            again = Journal(path, 1, 5, deadline=False)
            assert again.find("cy", package) == ungraded(DAY, "c")
            assert again.find("cy", replace(package, commit="new")) is None
            again.close()

    def test_results_come_back_as_they_were(self):
        one = ungraded(DAY, "why")
        assert from_json(one.to_json()) == Result(**{**vars(one)})


class TestSimilarity:
    def test_finds_a_copy_under_other_names_and_comments(self):
        own = similar.runs_of(own_way(ODD_WAY).encode(), STARTER)
        copy = similar.runs_of(own_way(renamed(ODD_WAY)).encode(), STARTER)
        assert renamed(ODD_WAY) != ODD_WAY
        (group,) = similar.similar_groups({"b": copy, "a": own})
        assert (group.keys, group.share) == (("a", "b"), 1.0)

    def test_sees_nothing_in_what_the_starter_gave(self):
        assert len(similar.runs_of(STARTER.encode(), STARTER)) == 0
        assert similar.similar_groups({"a": similar.runs_of(b"", STARTER)}) == []

    def test_sees_nothing_in_what_everybody_writes(self):
        runs = similar.runs_of(SOLVED.encode(), STARTER)
        assert len(runs) > similar.FEWEST
        assert similar.similar_groups({str(i): runs for i in range(9)}) == []

    @pytest.mark.parametrize("source", [b"\xff\0" * 999, b'"""' * 9999, b" " * 900_000])
    def test_takes_any_bytes_in_reasonable_time(self, source):
        similar.runs_of(source, STARTER)


class TestTheOverview:
    def test_counts_a_mistake_where_it_was_made_once_per_student(self):
        passed = ["passed"] * 8
        wrong_1 = result(
            "wrong", "passed", "wrong", *passed[3:], mistakes={0: "shape", 2: "follows"}
        )
        wrong_2 = result(
            "wrong", "wrong", *passed[2:], mistakes={0: "shape", 1: "shape"}
        )
        todo = result("todo", *passed[1:], mistakes={0: "unwritten"})
        class_ = [
            Graded(Student(name, name, Path()), one)
            for name, one in (("a", wrong_1), ("b", wrong_2), ("c", todo))
        ]
        (only,) = overview.diagnoses(DAY, class_)
        assert (only.mistake, only.task, only.who) == ("shape", "1.1", ("a", "b"))

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
        one = result(*statuses, mistakes=wrong)
        assert overview.state(Graded(Student("", "", Path()), one)) == state

    def test_counts_a_file_that_does_not_load_as_stuck(self):
        one = result(*["todo"] * 8, mistakes=dict.fromkeys(range(8), "does-not-load"))
        graded = Graded(Student("A", "", Path()), one)
        assert overview.state(graded) == "stuck"
        (only,) = overview.diagnoses(DAY, [graded])
        assert (only.mistake, only.task) == ("does-not-load", "1.1")

    def test_counts_who_stops_where(self):
        one = Graded(Student("", "", Path()), result("passed", *["wrong"] * 7))
        standing = overview.tasks_standing(DAY, [one, one])
        assert [s.stopped for s in standing] == [0, 2, 0, 0, 0, 0, 0, 0]
        assert standing[1].counts == Counter({"wrong": 2})


def test_bars_fill_their_line_and_escape_their_words():
    svg = bars.chart([bars.Row("<a>", "1 & 2", [("pass", 1), ("fail", 3)], 4)], "<x>")
    assert 'x="0.00%" y="20" width="25.00%"' in svg
    assert 'x="25.00%" y="20" width="75.00%"' in svg
    assert "<a>" not in svg
    assert "<x>" not in svg


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("=1+1", "'=1+1"),
        (" @x", "'@x"),
        ("-5", "'-5"),
        ("a\nb\0c", "a b c"),
        ("\ud800", "\\ud800"),
        ("Zoë", "Zoë"),
    ],
)
def test_a_cell_is_one_line_of_plain_text(text, shown):
    assert plain(text) == shown


def test_feedback_has_a_name_that_every_system_takes():
    long = feedback_path(Path("f"), "ñ" * 120)
    assert len(long.name.encode()) < 255
    assert long != feedback_path(Path("f"), "ñ" * 121)
    assert feedback_path(Path("f"), "ana") == Path("f/ana.txt")
