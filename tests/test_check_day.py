"""The checker as a program: a student's hour, in a copy of the kit."""

import json
import subprocess
import sys
import time

import pytest
from test_deliverables import PICTURE, git, png, worksheet

from conftest import environment_of
from labkit import log as metrics
from labkit.check import lab_run, memory, once
from labkit.handin.handin import Item
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit

CHECK, START, HINT = "scripts/check_day.py", "scripts/start_day.py", "scripts/hint.py"


@pytest.fixture
def day(clone):
    return find_day(1, clone)


@pytest.fixture
def work(day, run_in):
    """Start the day and return the student's file."""
    assert run_in(START, 1).returncode == 0
    return day.work


def solve(day, work, *names):
    """Write the kit's solution of some functions into the student's file."""
    from labkit.lesson.starter import put_back

    work.write_text(put_back(work.read_text(), day.source.read_text("utf-8"), names))


def note_kits_run(day, clone):
    log = clone / "metrics" / "metrics.csv"
    for row in day.metrics:
        metrics.append_row(log, day=1, check=row.check, metric=row.metric, value=1e-15)


class TestStart:
    def test_writes_the_starter_and_says_how_to_go_on(self, run_in, day):
        done = run_in(START, 1)
        assert done.returncode == 0
        assert "make check DAY=1" in done.stdout
        assert "TODO 1.4" in day.work.read_text()

    def test_never_overwrites(self, run_in, work):
        work.write_text("mine")
        done = run_in(START, 1)
        assert (done.returncode, work.read_text()) == (0, "mine")
        assert "stays as it is" in done.stdout

    def test_resets_one_task_and_keeps_the_old_text_beside_it(self, run_in, day, work):
        starter = work.read_text()
        solve(day, work, "Rz", "make_T")
        mine = work.read_text()
        done = run_in(START, "--reset", "1.2")
        assert done.returncode == 0
        solve(day, work, "Rz")
        assert work.read_text() == mine
        kept = list(work.parent.glob("*.before-1.2-*.txt"))
        assert [path.read_text() for path in kept] == [mine]
        run_in(START, "--reset", "1.1")
        run_in(START, "--reset", "1.2")
        assert work.read_text() == starter
        assert len(list(work.parent.glob("*.txt"))) == 3

    @pytest.mark.parametrize(
        ("arguments", "says"),
        [((44,), "no day 44 yet"), (("--reset", "1.9"), "no task 1.9")],
    )
    def test_says_what_there_is_where_there_is_no_such_thing(
        self, run_in, arguments, says
    ):
        done = run_in(START, *arguments)
        assert done.returncode == 2
        assert says in done.stderr
        assert "Traceback" not in done.stderr

    def test_a_reset_of_nothing_says_so(self, run_in):
        done = run_in(START, "--reset", "1.4")
        assert done.returncode == 2
        assert "w1-foundations/work/day1_transforms.py is not there" in done.stderr


class TestCheck:
    def test_of_the_starter_finds_every_task_to_do_and_changes_nothing(
        self, run_in, work
    ):
        before = {p: p.read_bytes() for p in work.parent.iterdir()}
        done = run_in(CHECK, 1)
        assert before == {p: p.read_bytes() for p in work.parent.iterdir()}
        assert done.returncode == 1
        assert done.stdout.count("to do") == 13
        assert "0 of 13 done, 0 % of the day." in done.stdout
        assert "Next: task 1.1, make_T. Stuck? make hint TASK=1.1" in done.stdout

    def test_of_half_a_task_says_which_half_is_to_do(self, run_in, work, day):
        says = "joint_T: Not written yet.\n"
        assert says not in run_in(CHECK, "--task", "1.5").stdout
        solve(day, work, "make_T", "quat_to_R", "link_T")
        assert says in run_in(CHECK, "--task", "1.5").stdout

    def test_of_the_reference_solution_passes_every_task_and_no_row_of_the_kits(
        self, run_in, work, day, clone
    ):
        note_kits_run(day, clone)
        work.write_text(day.source.read_text("utf-8"))
        found = json.loads(run_in(CHECK, 1, "--json").stdout)
        tasks = [e for e in found["entries"] if e["kind"] == "task"]
        assert [task["status"] for task in tasks] == ["passed"] * 8
        assert (found["done"], found["total"], found["passed"]) == (8, 13, False)
        assert found["next"] == "the figure: make view DAY=1 ARGS=--screenshot"

    def test_after_a_task_alone_the_next_open_one_is_named(self, run_in, work, day):
        solve(day, work, "make_T", "Rz")
        for task, following in zip(day.tasks[:2], day.tasks[1:3], strict=True):
            done = run_in(CHECK, "--task", task.id)
            assert (done.returncode, "1 of 1 done." in done.stdout) == (0, True)
            says = f"Next: task {following.id}, {' and '.join(following.functions)}. "
            assert f"{says}Check it: make check TASK={following.id}" in " ".join(
                done.stdout.split()
            )

    def test_after_the_last_open_task_alone_the_whole_day_is_next(
        self, run_in, work, day
    ):
        solve(day, work, *(f for task in day.tasks for f in task.functions))
        run_in(CHECK, 1)
        done = run_in(CHECK, "--task", "1.1")
        assert "Next: check the whole day: make check DAY=1" in done.stdout

    def test_counts_no_row_of_the_kits_own_run(self, run_in, work, day, clone):
        note_kits_run(day, clone)
        assert "0 of 13 done" in run_in(CHECK, 1).stdout

    def test_of_a_day_that_is_done_finds_nothing_left(self, run_in, work, day, clone):
        work.write_text(day.source.read_text("utf-8"))
        lab = run_in(
            "w1-foundations/work/day1_transforms.py",
            ROBO47_METRICS=str(clone / "metrics" / "metrics.csv"),
        )
        assert lab.returncode == 0, lab.stderr
        (day.folder / day.worksheet).write_text(worksheet(day.terms), "utf-8")
        (day.folder / day.figure).write_bytes(png(PICTURE))
        for command in (["init", "-q"], ["add", "-A"], ["commit", "-qm", "Day 1"]):
            git(clone, *command)
        done = run_in(CHECK, 1)
        assert done.returncode == 0, done.stdout
        assert "13 of 13 done, 100 % of the day." in done.stdout
        assert "nothing is left to do here. Well done." in done.stdout

    def test_names_the_mistake_with_the_number_that_shows_it(self, run_in, work, day):
        solve(day, work, "make_T")
        text = work.read_text().replace("T[:3, :3] = R ", "T[:3, :3] = R.T ")
        work.write_text(text)
        done = run_in(CHECK, "--task", "1.1", "--explain")
        assert done.returncode == 1
        assert "WRONG" in done.stdout
        assert "transpose" in done.stdout
        assert "largest error of an entry" in done.stdout

    def test_keeps_to_80_columns_and_plain_text(self, run_in, work, day):
        text = day.source.read_text("utf-8").replace("T[:3, 3] = t", "T[:3, 3] = -t")
        work.write_text(text)
        said = run_in(CHECK, 1, "--explain").stdout
        assert "WRONG" in said
        assert max(map(len, said.splitlines())) <= 80
        assert said.isascii()

    def test_shows_a_syntax_error_once_with_its_line(self, run_in, work):
        work.write_text(work.read_text() + "def f()\n    pass\n")
        done = run_in(CHECK, 1)
        line = work.read_text().count("\n") - 1
        says = f"day1_transforms.py, line {line}: SyntaxError: expected ':'"
        assert done.stdout.count(says) == 1
        assert "fix that line" in done.stdout
        assert done.stdout.count("not judged") == 8
        assert "WRONG" not in done.stdout

    def test_shows_what_was_printed_on_request(self, run_in, work, day):
        solve(day, work, "Rz")
        text = work.read_text().replace(
            "c, s = np.cos", 'print("hello")\n    c, s = np.cos'
        )
        work.write_text(text)
        assert "| hello" in run_in(CHECK, "--task", "1.2", "--explain").stdout
        assert "hello" not in run_in(CHECK, "--task", "1.2").stdout

    @pytest.mark.parametrize(
        ("arguments", "says"),
        [
            ((1,), "make start DAY=1"),
            ((48,), "no day 48 yet"),
            (("--task", "x"), "'x' is no task"),
            (("--task", "1.4", "--file", "nowhere.py"), "nowhere.py is not there"),
        ],
    )
    def test_that_cannot_run_says_why_and_exits_2(self, run_in, arguments, says):
        done = run_in(CHECK, *arguments)
        assert done.returncode == 2
        assert says in done.stderr
        assert "Traceback" not in done.stderr

    def test_watches_until_all_is_well_and_sees_each_save(self, work, day, clone):
        command = [sys.executable, "-u", CHECK, "--task", "1.1", "--watch"]
        with subprocess.Popen(
            command,
            cwd=clone,
            env=environment_of(clone),
            stdout=subprocess.PIPE,
            text=True,
        ) as watcher:
            said = []
            for line in watcher.stdout:
                said.append(line)
                if "watching" in line:
                    time.sleep(0.01)  # a file system that stamps coarsely
                    solve(day, work, "make_T")
            assert watcher.wait(timeout=60) == 0
        assert sum("make_T" in line and "to do" in line for line in said) == 1
        assert sum("make_T" in line and "passed" in line for line in said) == 1


class TestTheLabsRun:
    """It takes many times what the tasks take, so it is not repeated for nothing."""

    @pytest.fixture(autouse=True)
    def _kept_here(self, monkeypatch):
        kept = {}
        monkeypatch.setattr(memory.store, "read", lambda _: kept)
        monkeypatch.setattr(memory.store, "write", lambda _, new: kept.update(new))

    @pytest.fixture
    def runs(self, monkeypatch):
        seen = []
        monkeypatch.setattr(lab_run, "check_lab", lambda *a: seen.append(a) or [])
        return seen

    def test_is_not_repeated_with_the_same_files(self, runs, work, day, clone):
        work.write_text(day.source.read_text("utf-8"))
        for _ in range(2):
            once._lab(day, work, None, True, None)
        assert len(runs) == 1
        work.write_text(work.read_text() + "# other\n")
        once._lab(day, work, None, True, None)
        assert len(runs) == 2
        manifest = day.own / "day.toml"
        manifest.write_text(manifest.read_text("utf-8") + "# other\n", "utf-8")
        once._lab(day, work, None, True, None)
        assert len(runs) == 3

    def test_is_repeated_where_it_did_not_pass(self, monkeypatch, work, day, clone):
        answers = [[Item("lab", "wrong", "...")], [Item("lab", "unfinished", "")], []]
        monkeypatch.setattr(lab_run, "check_lab", lambda *_: answers.pop(0))
        found = [once._lab(day, work, None, True, None) for _ in range(4)]
        assert [len(items) for items in found] == [1, 1, 0, 0]

    def test_is_not_remembered_where_a_save_came_between(
        self, monkeypatch, work, day, clone
    ):
        def saved(*_):
            work.write_text(work.read_text() + "# saved\n")
            return []

        monkeypatch.setattr(lab_run, "check_lab", saved)
        once._lab(day, work, None, True, None)
        assert not memory.lab_passed(memory.lab_key(day))


class TestHint:
    def test_gives_the_next_one_each_time_and_remembers(self, run_in, day, clone):
        hints = day.task("1.4").hints
        for count, hint in enumerate([*hints, hints[-1]], start=1):
            done = run_in(HINT, "1.4")
            assert done.returncode == 0
            number = min(count, len(hints))
            assert f"hint {number} of {len(hints)}" in done.stdout
            assert hint.split()[:4] == done.stdout.splitlines()[2].split()[:4]
            assert "Re-read:" in done.stdout
        assert run_in(HINT, "1.4", "--again").stdout == done.stdout
        assert json.loads((clone / ".robo47/hints.json").read_text()) == {"1.4": 3}
        assert "hint 1 of" in run_in(HINT, "1.2").stdout

    def test_shows_the_solution_only_once_the_task_passes(
        self, run_in, work, day, clone
    ):
        solution = "T[:3, :3] = R"
        (clone / ".robo47").mkdir(exist_ok=True)
        (clone / ".robo47/hints.json").write_text('{"1.1": 9}')
        assert solution not in run_in(HINT, "1.1").stdout
        solve(day, work, "make_T")
        assert solution in run_in(HINT, "1.1").stdout

    def test_without_a_task_is_for_the_first_that_is_open(self, run_in, work, day):
        solve(day, work, "make_T")
        assert run_in(HINT).stdout.startswith("1.2 ")

    def test_survives_a_memory_that_is_no_json(self, run_in, clone):
        (clone / ".robo47").mkdir(exist_ok=True)
        (clone / ".robo47/hints.json").write_text("[1, {")
        assert "hint 1 of" in run_in(HINT, "1.4").stdout

    @pytest.mark.parametrize("task", [(), ("1.4",)])
    def test_shows_a_syntax_error_before_any_hint(self, run_in, work, task):
        work.write_text(work.read_text() + "def f()\n    pass\n")
        done = run_in(HINT, *task)
        assert done.returncode == 1
        assert "SyntaxError: expected ':'" in done.stdout
        assert "hint 1 of" not in done.stdout

    def test_for_something_to_hand_in_gives_its_remedy(self, run_in, day, clone):
        done = run_in(HINT, "figure")
        assert done.returncode == 0
        assert f"w1-foundations/{day.figure}" in done.stdout.replace("\n", " ")
        note_kits_run(day, clone)
        assert "make run DAY=1" in run_in(HINT, "metrics").stdout

    def test_says_what_a_task_is_called(self, run_in):
        done = run_in(HINT, "fk")
        assert done.returncode == 2
        assert "such as 1.4" in done.stderr


def test_running_the_starter_names_the_task_that_is_to_do(run_in, work):
    done = run_in("w1-foundations/work/day1_transforms.py", "--no-log")
    assert done.returncode == 1
    assert "to do: task 1.1: write make_T" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_side_quest_that_nobody_wrote_keeps_no_row_from_counting():
    from labkit.check.tasks import TaskResult, required_pass
    from labkit.judge import Verdict

    day = find_day(3)
    done = {"3.9": "todo"}
    results = [TaskResult(t, Verdict(done.get(t.id, "passed"))) for t in day.tasks]
    assert required_pass(results)
    results[0] = TaskResult(day.tasks[0], Verdict("wrong"))
    assert not required_pass(results)


def test_a_side_quest_is_next_only_where_it_alone_was_checked():
    from labkit.check.report import Report
    from labkit.check.tasks import TaskResult
    from labkit.judge import Verdict

    day = find_day(3)
    *others, quest = (TaskResult(task, Verdict("wrong")) for task in day.tasks)
    assert quest.task.optional
    hint = f"Stuck? make hint TASK={quest.task.id}"
    assert hint in Report(day, [quest]).next_step()
    passed = [TaskResult(other.task, Verdict("passed")) for other in others]
    assert hint not in Report(day, [*passed, quest]).next_step()
