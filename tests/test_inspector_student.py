"""The student's file behind the page: asked, reloaded, and never in this process."""

from types import SimpleNamespace

import numpy as np
import pytest

from labkit.base.exchange import LoadError, Question, Reply
from labkit.inspector.arm import Arm
from labkit.inspector.ghost import Ghost
from labkit.inspector.student import Student, describe
from labkit.lesson.day import find_day
from labkit.sandbox.sandbox import Sandbox
from robo47 import panda

pytestmark = pytest.mark.kit

Q = np.zeros(7)
DAY = SimpleNamespace(tasks=[SimpleNamespace(id="1.6", functions=["f"])])
GHOST = Ghost(
    "my_fk", ("link0", "ee"), lambda model, q: [(1.0,), (2.0,)], lambda model, q: (3.0,)
)


class Fake:
    """A file that answers by rule: what its text says."""

    def __init__(self, text: str) -> None:
        self.text, self.alive, self.asked = text, True, []

    def ask(self, questions, seconds):
        self.asked += questions
        if self.text == "loop":
            self.alive = False
            return [Reply(kind="stopped", error="it runs on")] * len(questions)
        if self.text == "no path" and len(questions) > 1:
            return [Reply(kind="TypeError", error="no path")] * len(questions)
        scale = 1.0 if self.text == "no path" else float(self.text)
        return [Reply(scale * np.eye(4))] * len(questions)

    def halt(self):
        self.text = "loop"

    def close(self):
        self.alive = False


class Desk:
    """A student's file, the sandbox that opens it, and who asks."""

    def __init__(self, path, ghost=GHOST) -> None:
        self.path = path
        arm = Arm(panda.load(), panda.END_FRAME["panda_nohand"])
        opens = SimpleNamespace(session=self.open)
        self.student = Student(find_day(1), arm, ghost, opens, path)

    def open(self, path, *_, **__):
        text = path.read_text()
        if text == "broken":
            raise LoadError(Reply(kind="SyntaxError", error="invalid syntax"))
        self.fake = Fake(text)
        return self.fake

    def save(self, text):
        """Save the file and have it seen; return what its function says then."""
        new = self.path.with_suffix(".new")
        new.write_text(text)
        new.replace(self.path)
        return self.see()

    def see(self, q=Q):
        self.student.look()
        return self.student.see(q)


@pytest.fixture
def desk(tmp_path):
    return Desk(tmp_path / "day.py")


def test_without_a_file_the_page_says_that_there_is_none(desk):
    seen = desk.see()
    assert seen.kind == "quiet"
    assert "day.py yet: make start DAY=1. Shown is the kit's library." in seen.sentence


def test_a_file_that_appears_is_asked_and_one_that_goes_is_forgotten(desk):
    np.testing.assert_array_equal(desk.save("2").poses["ee"], 2 * np.eye(4))
    desk.path.unlink()
    assert desk.see().poses == {}
    assert not desk.student.there


def test_a_save_is_seen_once_and_the_file_asked_anew(desk):
    desk.save("2")
    before = desk.student.version
    assert desk.save("3.5").poses["ee"][0, 0] == 3.5
    desk.see()
    assert desk.student.version == before + 1


def test_no_call_that_an_old_file_was_meant_to_answer_reaches_the_new_one(desk):
    desk.save("2")
    old = desk.student.version
    opened = desk.student.sandbox.session
    seen = []
    desk.student.sandbox.session = lambda *given, **named: (
        seen.append((desk.student.saved(), desk.student.version)),
        opened(*given, **named),
    )[1]
    desk.save("loop")
    desk.fake.alive = True
    desk.fake.asked.clear()
    (reply,) = desk.student.ask([Question("view", "f", ())], old)
    assert (reply.kind, desk.fake.asked) == ("stopped", [])
    assert seen == [(False, old + 1)]  # a name of its own before it is open


def test_a_file_that_does_not_load_is_said_and_the_next_save_is_asked(desk):
    said = desk.save("broken").sentence
    assert "day.py" in said
    assert "SyntaxError: invalid syntax" in said
    assert desk.save("2").poses


def test_an_endless_loop_is_asked_once_and_again_only_after_a_save(desk):
    seen = desk.save("loop")
    assert "it runs on" in seen.sentence
    assert "Save the file to have it asked again" in seen.sentence
    asked = len(desk.fake.asked)
    assert desk.see(np.ones(7)).sentence == seen.sentence
    assert len(desk.fake.asked) == asked
    assert desk.save("2").poses


def test_a_chain_that_takes_no_path_shows_its_end_alone(desk):
    seen = desk.save("no path")
    assert set(seen.poses) == {"ee"}
    assert "Only ee is drawn: my_fk: Your function stops with an error" in seen.sentence


def test_a_question_that_fails_on_our_side_is_said_and_the_next_is_asked(desk):
    desk.save("2")
    desk.fake.text = "no number"  # the fake itself fails over it
    assert "could not convert" in desk.see().sentence
    desk.fake.text = "3"
    assert desk.see().poses


def test_a_tab_may_ask_any_function(desk):
    desk.save("2")
    (reply,) = desk.student.ask([Question("view", "jacobian", (1.0,))])
    np.testing.assert_array_equal(reply.value, 2 * np.eye(4))


@pytest.mark.parametrize(
    ("reply", "says"),
    [
        (Reply(np.eye(4)), ""),
        (
            Reply(kind="missing"),
            "The file has no function f. To restore its starter: make start RESET=1.6.",
        ),
        (
            Reply(kind="ValueError", error="no", line=3),
            "f: Your function stops with an error. The error occurs in line 3: "
            "`ValueError: no`.",
        ),
        (
            Reply(kind="ValueError", error="no `x`\n  here"),
            "f: Your function stops with an error. The error is `ValueError: no 'x' "
            "here`.",
        ),
        (
            Reply(kind="KeyError", line=3, callers=(9,)),
            "f: Your function stops with an error. The error occurs in line 3, called "
            "from line 9: `KeyError`.",
        ),
    ],
)
def test_what_is_no_answer_is_told_in_the_words_of_make_check(reply, says):
    assert describe(DAY, "f", reply) == says


def test_a_file_that_loads_the_robot_at_its_top_is_opened_as_make_check_does(tmp_path):
    script = tmp_path / "day1_transforms.py"
    load = "from robo47 import panda\nMODEL = panda.load()\n"
    script.write_text(load + "def f(model): return model.nq + MODEL.nq")
    arm = Arm(panda.load(), panda.END_FRAME["panda_nohand"])
    with Sandbox() as sandbox:
        student = Student(find_day(1), arm, None, sandbox, script, seconds=20)
        student.look()
        (reply,) = student.ask([Question("view", "f", (arm.model,))])
    assert reply.value == 14, reply.error


def test_a_day_without_a_ghost_is_opened_and_asked_all_the_same(tmp_path):
    desk = Desk(tmp_path / "day.py", ghost=None)
    assert desk.save("2").sentence == ""
    assert desk.fake.asked == []  # for no pose
    (reply,) = desk.student.ask([Question("view", "space_jacobian", ())])
    assert reply.value[0, 0] == 2.0
    assert "invalid syntax" in desk.save("broken").sentence
