"""Time: questions that fit, a slow function and a loop, a lab not run to its end."""

import itertools
import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from labkit.base import processes
from labkit.base.exchange import Question, Reply
from labkit.check import lab_run, slow
from labkit.check.report import Report, as_text
from labkit.check.slow import Budget, StoppedEarly, TimeUsedUp, too_slow
from labkit.check.tasks import TaskResult
from labkit.grade import child
from labkit.handin.handin import Item
from labkit.judge import Mask, Row, Scalar, Verdict, fits
from labkit.judge.ask import asked_of
from labkit.judge.written import faults
from labkit.lesson.day import find_day
from labkit.proof import page
from labkit.proof.facts import RunDay
from labkit.sandbox import process, sandbox
from labkit.sandbox.sandbox import Sandbox

DAY = find_day(1)
CALLS = [(float(i),) for i in range(3)]
NO_END = """
right, here = link4_to_world, panda.load().body_pos
def link4_to_world(model, *args):
    while not np.array_equal(model.body_pos, here): pass
    return right(model, *args)
"""


class Clock:
    """A clock that stands until somebody works."""

    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


class TestQuestions:
    @pytest.mark.parametrize(
        ("cost", "seconds", "asked"),
        [(0.0, 10.0, 36), (0.01, 10.0, 36), (0.125, 10.0, 10), (2.0, 60.0, 2)],
    )
    def test_are_as_many_as_fit_in_the_tasks_time(self, cost, seconds, asked):
        found = fits.fitting(CALLS, [*CALLS, (9.0,)], [(7.0,)] * 32, cost, seconds)
        assert len(found) == asked
        drawn = found.count((7.0,))
        assert drawn >= fits.FEWEST

    def test_are_fewer_where_a_row_says_what_a_call_costs(self):
        def row(**more):
            found = Row(Scalar(), truth=lambda x: 2.0 * x, **more)
            found.inputs(lambda rng: [(x,) for x in rng.uniform(-1, 1, 3)])
            return found.ask

        quick = asked_of("1.1", "f", row(), 1, 60.0)
        few = asked_of("1.1", "f", row(seconds=2.0), 1, 60.0)
        assert len(few.exchanges) == 5
        assert len(quick.exchanges) > 30

    def test_are_fewer_where_the_labs_own_is_slower_than_the_truth(self):
        row = Row(Scalar(), truth=lambda x: 2.0 * x)
        row.inputs(lambda rng: [(x,) for x in rng.uniform(-1, 1, 3)])
        slow_lab = replace(row.ask, reference=lambda: lambda x: time.sleep(0.05))
        assert slow_lab.cost_in(10.0) < 0.01 < slow_lab.cost_in(60.0)

    def test_cost_what_the_reference_takes_at_its_quickest(self):
        clock, times = Clock(), iter([5.0, 0.7, 0.3, 9.0])

        def call():
            clock.now += next(times)

        assert fits.measured(call, clock) == 0.5  # 0.3, rounded up to a power of 2

    def test_that_do_not_fit_are_told_to_their_author(self):
        assert fits.too_long(CALLS, 2.0, 60.0) == ""
        says = fits.too_long(CALLS, 2.0, 20.0)
        assert "a call takes 2 s here; 3 in @row.inputs" in says
        assert "60 s, and there are 20" in says

    def test_of_yes_or_no_are_six_of_each_or_their_author_is_told(self):
        def told(limit):
            row = Row(Mask(), truth=lambda x: x > limit)
            row.inputs(lambda rng: [(x,) for x in rng.uniform(-1, 1, 24)])
            return list(faults(row.ask, 10.0))

        assert told(0.0) == []
        (says,) = told(0.99)
        assert "ask 6 of each at least" in says


class TestACallThatIsStopped:
    STOPPED = Reply(kind="stopped", error=process.ENDLESS, given=3.0)

    def test_runs_on_and_on_where_the_kits_own_is_done_at_once(self):
        verdict = too_slow(DAY, "Rz", (0.5,), self.STOPPED)
        assert verdict.mistake == "stopped"
        assert verdict.message == (
            "Rz did not return: it does not end, as in an endless loop (the kit's own "
            "takes under 0.1 s per call; yours was stopped after 3 s)."
        )

    def test_is_slow_where_the_kits_own_takes_its_time_too(self, monkeypatch):
        monkeypatch.setattr(slow, "seconds_of", lambda function, args: 0.8)
        verdict = too_slow(DAY, "Rz", (0.5,), replace(self.STOPPED, given=12.0))
        assert verdict.mistake == "too-slow"
        assert verdict.message == (
            "Rz is too slow: the kit's own takes 0.8 s per call; yours was stopped "
            "after 12 s."
        )

    def test_is_slow_where_other_calls_came_back_after_long(self):
        reply = replace(self.STOPPED, given=10.0, came=8, longest=1.2)
        verdict = too_slow(DAY, "Rz", (0.5,), reply)
        assert verdict.mistake == "too-slow"
        assert "yours was stopped after 8 calls and 10 s." in verdict.message

    @pytest.mark.kit
    def test_brings_the_time_that_it_had(self, ask, monkeypatch):
        monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.4)
        monkeypatch.setattr(sandbox, "TASK_SECONDS", 0.6)
        code = """
            import time
            def f(x):
                while x: pass
                time.sleep(0.25)
                return 1.0
        """
        (reply,) = ask(code, Question("1.1", "f", (1.0,)))
        assert (reply.given, reply.came) == (0.4, 0)
        *_, last = ask(code, *(Question("1.1", "f", (0.0,)) for _ in range(9)))
        assert last.kind == "stopped"
        assert (round(last.given, 6), last.came > 0) == (0.6, True)
        assert last.longest > 0.0


class TestALabsRun:
    """With fakes of the clock and of the process that answers."""

    @pytest.fixture(autouse=True)
    def clock(self, monkeypatch):
        self.clock = Clock()
        self.waits = 0.0
        monkeypatch.setattr(processes, "waited", lambda: self.waits)

    def run(self, calls, took, ran, kits=dict, seconds=10.0):
        """Return a budget after calls that each took so many seconds."""
        ran_so_far = itertools.count(0, ran)
        other = SimpleNamespace(
            used=lambda: (next(ran_so_far), 0.0), ask=lambda questions: None
        )
        budget = Budget(seconds, kits, self.clock)
        budget.watch(other)
        for _ in range(calls):
            budget.spend("f", (1.0,))
            self.clock.now += took
        return budget

    def test_has_no_count_of_calls(self):
        assert self.run(100_000, 1e-6, 0.0).calls["f"] == 100_000

    def test_ends_where_the_students_functions_are_slow(self):
        with pytest.raises(TimeUsedUp):
            self.run(200, 0.2, 0.0, seconds=1e-9)
        budget = Budget(10.0, clock=self.clock)
        budget.watch(SimpleNamespace(used=lambda: (9.0, 0.0), ask=len))
        budget.spend("f", (1.0,))
        self.clock.now += 11.0
        with pytest.raises(TimeUsedUp):
            budget.spend("f", (1.0,))
        says = slow.not_to_its_end("3. Train", budget)
        assert "10 s went by, with 1 call of your functions; the kit's" in says
        assert 'It was stopped in "3. Train"' in says

    def test_goes_on_where_the_kits_own_would_take_as_long(self):
        budget = self.run(150, 0.1, 0.0)  # 15 s, of which the process worked for none
        assert budget.seconds == 30.0
        with pytest.raises(TimeUsedUp):
            self.run(400, 0.1, 0.0)

    def test_is_not_charged_what_it_waits_for_a_processor(self):
        budget = Budget(10.0, clock=self.clock)
        self.clock.now += 500.0
        self.waits = 495.0
        budget.spend("f", (1.0,))
        assert budget.seconds == 10.0

    def test_that_is_not_to_its_end_is_told_in_the_same_words_everywhere(
        self, monkeypatch, tmp_path
    ):
        words = "The lab was not run to its end: 30 s went by."
        ran = lab_run.LabRun("", {}, words)
        monkeypatch.setattr(lab_run, "rehearse", lambda *_: ran)
        (item,) = lab_run.check_lab(DAY, DAY.source, None)
        done = [TaskResult(task, Verdict("passed")) for task in DAY.tasks]
        assert item.passed
        assert words in " ".join(as_text(Report(DAY, done, [item])).split())
        numbers = child._with_lab(Item("metrics"), item)
        assert numbers.passed
        assert words in numbers.message
        assert child._with_lab(Item("figure"), item) == Item("figure")
        day = RunDay(DAY, {}, (), unfinished=words)
        assert words in page._numbers([day])

    @pytest.mark.kit
    def test_with_a_slow_function_stops_and_says_so(self, tmp_path):
        day = replace(DAY, lab_seconds=0.5)
        script = tmp_path / day.script
        text = day.source.read_text("utf-8")
        script.write_text(
            f"import time\n{text}".replace(
                "    c, s =", "    time.sleep(0.1)\n    c, s ="
            )
        )
        with Sandbox() as box:
            ran = lab_run.rehearse(day, script, box)
        assert ran.fault == ""
        assert ran.unfinished.startswith("The lab was not run to its end: ")

    @pytest.mark.kit
    def test_ends_as_soon_as_the_student_has_other_work(self, tmp_path):
        script = tmp_path / DAY.script
        text = DAY.source.read_text("utf-8")
        slow = text.replace("    c, s =", "    time.sleep(0.2)\n    c, s =")
        script.write_text(f"import time\n{slow}")
        with Sandbox() as box, pytest.raises(StoppedEarly):
            lab_run.rehearse(DAY, script, box, None, lambda: True)

    @pytest.mark.kit
    def test_gets_answers_as_the_functions_return_them(self, tmp_path, monkeypatch):
        monkeypatch.setattr(lab_run, "_own_robots", lambda day: [])  # it has no row
        task = replace(DAY.tasks[0], functions=("brightest",), was=())
        day = replace(DAY, tasks=(task,))
        script = tmp_path / "day1_x.py"
        script.write_text(
            "import numpy as np\ndef brightest(image):\n"
            "    row, column = divmod(int(image.argmax()), image.shape[1])\n"
            "    return row, column\n"
        )

        def brightest(image):
            return 0, 0

        lab = SimpleNamespace(brightest=brightest)
        with Sandbox() as box:
            own = lab_run.behind_wall(day, script, box, lab, Budget(30.0))
            image = np.arange(6.0).reshape(2, 3)
            assert image[own["brightest"](image)] == 5.0
            assert own["brightest"](image) == (1, 2)


@pytest.mark.kit
def test_who_does_not_return_for_another_robot_typed_nothing_in(check, monkeypatch):
    monkeypatch.setattr(sandbox, "CALL_SECONDS", 0.5)
    guard = 'if __name__ == "__main__":'
    text = DAY.source.read_text("utf-8").replace(guard, f"{NO_END}\n{guard}")
    verdict = check(text)["1.8"]
    assert verdict.mistake in ("stopped", "too-slow")
    assert "yours was stopped after 0.5 s" in verdict.message
