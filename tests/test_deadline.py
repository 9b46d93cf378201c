"""One clock for a submission, from its first question to its lab's end."""

import contextlib
import time
from dataclasses import replace
from types import SimpleNamespace

import pytest
from make_class import DAY as FIRST

from labkit.base import processes
from labkit.base.deadline import Deadline
from labkit.base.exchange import EndedError, Exchange, Question
from labkit.check import slow
from labkit.check.lab_run import rehearse
from labkit.check.slow import Budget, RunsOn
from labkit.check.tasks import check_tasks
from labkit.grade import engine
from labkit.grade.engine import Grader
from labkit.grade.package import Package, fingerprint
from labkit.lesson.day import find_day
from labkit.sandbox import sandbox
from labkit.sandbox.process import ENDLESS
from labkit.sandbox.sandbox import TOO_LONG, Sandbox, deadline_of
from robo47.errors import FaultError

DAY = find_day(7)


class Fake:
    """A clock, and processes that wait for a processor."""

    def __init__(self):
        self.now = self.own = self.theirs = 0.0

    def __call__(self):
        return self.now

    def used(self):
        return 0.0, self.theirs


@pytest.fixture
def fake(monkeypatch):
    fake = Fake()
    monkeypatch.setattr(processes, "waited", lambda: fake.own)
    return fake


def test_waiting_for_a_processor_is_not_counted_whoever_waits(fake):
    fake.own, fake.theirs = 7.0, 5.0
    deadline = Deadline(10.0, fake)
    deadline.watch(fake)
    deadline.watch(fake)  # counted once
    fake.now, fake.own, fake.theirs = 16.0, 10.0, 9.0
    assert deadline.within(3.0) == 1.0
    assert deadline.used == 9.0
    fake.now = 18.0
    assert deadline.over


def test_what_a_process_waited_that_is_gone_stays_taken_off(fake):
    deadline = Deadline(10.0, fake)
    deadline.watch(fake)
    fake.now, fake.theirs = 11.0, 4.0
    assert not deadline.over
    fake.theirs = 0.0  # nobody knows any more
    fake.now = 13.0
    assert not deadline.over
    fake.now = 14.5
    assert deadline.over


def test_what_the_deadline_cut_is_no_loop_though_some_waited_meanwhile(fake):
    """A wait that is seen afterwards gives time back, to others than that call."""

    def next_(seconds):
        fake.now, fake.theirs = fake.now + seconds, 1.0
        raise EndedError(ENDLESS)

    box = SimpleNamespace(next=next_, used=fake.used)
    deadline = Deadline(2.0, fake)
    deadline.watch(box)
    with pytest.raises(EndedError, match=TOO_LONG):
        sandbox._next(box, 3.0, deadline)
    with pytest.raises(EndedError, match=ENDLESS):
        sandbox._next(box, 0.5, deadline)


def test_a_day_has_one_deadline_for_its_tasks_and_its_lab():
    assert deadline_of(FIRST).seconds == 130.0


@pytest.mark.kit
class TestItIsKept:
    SLOW = "import time\ndef f(x):\n    time.sleep(0.4)\n    return 1.0"

    def test_by_a_session(self, student):
        deadline = Deadline(600.0)
        with Sandbox() as box:
            session = box.session(student(self.SLOW), deadline=deadline)
            deadline.seconds = deadline.used + 2.0  # from here: a start takes its time
            replies = session.ask([Question("1.1", "f", (1.0,))] * 9)
            assert not session.alive
        assert replies[0].value == 1.0
        assert replies[-1].error == TOO_LONG

    def test_by_runs_one_after_the_other(self, student):
        deadline = Deadline(2.0)
        with Sandbox() as box:
            for came in (True, False):
                one = Exchange(Question("1.1", "f", (1.0,)))
                box.run(student(self.SLOW), [one], deadline=deadline)
                assert (one.reply.error != TOO_LONG) is came
                deadline.seconds = 0.0

    def test_by_second_looks_and_the_first_look_stays(self, student, monkeypatch):
        """A function sleeps as soon as it is asked for what makes it right."""
        looked = []
        monkeypatch.setattr(Sandbox, "session", lambda *_, **__: looked.append(1))
        deadline = Deadline(60.0)
        asked = Sandbox.run

        def run(box, *more, **named):
            asked(box, *more, **named)
            deadline.seconds = 0.0

        monkeypatch.setattr(Sandbox, "run", run)
        text = FIRST.source.read_text("utf-8").replace("c, s =", "s, c =")
        file = student(text, FIRST.script)
        with Sandbox() as box:
            found = check_tasks(FIRST, file, box, "1.2", deadline=deadline)
        assert found[0].verdict.status == "wrong"
        assert found[0].verdict.mistake != "stopped"
        assert looked == []

    def test_by_a_labs_run_that_simulates_what_a_function_returns(
        self, tmp_path, monkeypatch
    ):
        monkeypatch.setattr(slow, "ONE_CALL", 1.0)
        monkeypatch.setattr(slow, "POLL", 0.05)
        script = tmp_path / DAY.script
        text = DAY.source.read_text("utf-8")
        end = '\nif __name__ == "__main__":'
        assert end in text
        more = (
            "\nright = quintic_duration\ndef quintic_duration(dq, *limits):\n"
            "    if np.array_equal(dq, GOAL_Q - READY_Q): return 20000.0\n"
            "    return right(dq, *limits)\n"
        )
        script.write_text(text.replace(end, f"{more}{end}"), "utf-8")
        with Sandbox() as box:
            says, _, unfinished = rehearse(replace(DAY, lab_seconds=3.0), script, box)
        assert "does not end with the results of your functions" in says
        assert "4 s after it called" in says
        assert unfinished == ""

    def test_by_a_lab_that_gets_what_the_tasks_left(self, tmp_path):
        script = tmp_path / FIRST.script
        script.write_bytes(FIRST.source.read_bytes())
        whole = Deadline(0.0)
        with Sandbox() as box:
            assert rehearse(FIRST, script, box, whole)[0] == TOO_LONG


@pytest.mark.kit
class TestACheckerThatIsKeptBusy:
    PACKAGE = Package(1, fingerprint(1), problem="nobody")

    @pytest.fixture
    def late(self, monkeypatch):
        """Return what a grader says that had no time, after so much work."""

        def late(ran):
            monkeypatch.setattr(engine, "scheduled", lambda _: (0.0, 0.0))
            monkeypatch.setattr(processes, "scheduled", lambda _: (ran, 0.0))
            return Grader().grade(self.PACKAGE, beyond=-129.999)

        return late

    def test_by_a_submission_grades_it(self, late):
        found = late(100.0)
        assert {task["status"] for task in found["tasks"]} == {"wrong"}
        assert "the check of this file was stopped" in found["error"]

    def test_by_nobody_is_the_machines_fault(self, late):
        with pytest.raises(FaultError, match="it took more than"):
            late(0.0)


def test_the_kits_own_code_is_stopped_wherever_it_is(monkeypatch):
    monkeypatch.setattr(slow, "ONE_CALL", 0.0)
    monkeypatch.setattr(slow, "POLL", 0.01)
    budget = Budget(0.1)
    budget.spend("f", ())

    def lab():
        while True:
            with contextlib.suppress(Exception):
                time.sleep(0.001)

    with pytest.raises(RunsOn), budget.bounded():
        lab()
    assert "after it called f" in slow.runs_on("", budget)


def test_what_ends_in_time_is_not_stopped_afterwards(monkeypatch):
    monkeypatch.setattr(slow, "POLL", 0.001)
    budget = Budget(60.0)
    with budget.bounded():
        pass
    budget.watch(SimpleNamespace(used=lambda: (0.0, 0.0)))
    time.sleep(0.05)
