"""The student's file behind the page: asked, reloaded, and never in this process."""

import threading

import numpy as np
import pytest

from labkit.base.exchange import LoadError, Question, Reply
from labkit.inspector.ghost import Ghost
from labkit.inspector.student import Source, Student, describe, source_of
from labkit.lesson.day import find_day
from labkit.sandbox.sandbox import Sandbox
from robo47 import panda

pytestmark = pytest.mark.kit

SECONDS = 20
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

    def close(self):
        self.alive = False


class Desk:
    """A student's file, and what the page is told of it."""

    def __init__(self, path, ghost=GHOST) -> None:
        self.path, self.opened, self.told = path, [], []
        self.news = threading.Condition()
        source = Source(path, self.open, said)
        self.student = Student(
            source, ghost, panda.load(), self.hear, lambda: self.opened.append("saved")
        )

    def open(self, path):
        text = path.read_text()
        if text == "broken":
            raise LoadError(Reply(kind="SyntaxError", error="invalid syntax"))
        self.fake = Fake(text)
        return self.fake

    def save(self, text):
        new = self.path.with_suffix(".new")
        new.write_text(text)
        new.replace(self.path)  # nobody sees half of it

    def hear(self, seen):
        with self.news:
            self.told.append(seen)
            self.news.notify_all()

    def until(self, true):
        with self.news:
            assert self.news.wait_for(
                lambda: self.told and true(self.told[-1]), SECONDS
            ), self.told[-1:]
        return self.told[-1]


def said(function, reply):
    return f"{function}: {reply.kind} {reply.error}." if reply.kind else ""


@pytest.fixture
def desk(tmp_path):
    made = Desk(tmp_path / "day.py")
    made.student.want(np.zeros(7))
    made.student.start()
    yield made
    made.student.close()
    made.student.join(SECONDS)
    assert not made.student.is_alive()


def test_without_a_file_the_page_is_told_that_there_is_none(desk):
    assert desk.until(lambda seen: seen is None) is None


def test_a_file_that_appears_is_asked_and_one_that_goes_is_forgotten(desk):
    desk.save("2")
    seen = desk.until(lambda seen: seen is not None)
    np.testing.assert_array_equal(seen.poses["ee"], 2 * np.eye(4))
    desk.path.unlink()
    desk.until(lambda seen: seen is None)


def test_a_save_is_seen_and_the_file_asked_anew(desk):
    desk.save("2")
    desk.until(lambda seen: seen is not None)
    desk.save("3.5")
    desk.until(lambda seen: seen is not None and seen.poses["ee"][0, 0] == 3.5)
    assert len(desk.opened) >= 2


def test_a_file_that_does_not_load_is_said_and_the_next_save_is_asked(desk):
    desk.save("broken")
    said = desk.until(lambda seen: seen is not None).problem
    assert "day.py" in said
    assert "SyntaxError: invalid syntax" in said
    desk.save("2")
    desk.until(lambda seen: seen is not None and seen.poses)


def test_an_endless_loop_is_asked_once_and_again_only_after_a_save(desk):
    desk.save("loop")
    seen = desk.until(lambda seen: seen is not None)
    assert "it runs on" in seen.problem
    assert "Save the file to have it asked again" in seen.problem
    asked = len(desk.fake.asked)
    desk.student.want(np.ones(7))
    desk.until(lambda seen: seen is not None and seen.q[0] == 1)
    assert len(desk.fake.asked) == asked
    desk.save("2")
    desk.until(lambda seen: seen is not None and seen.poses)


def test_a_chain_that_takes_no_path_shows_its_end_alone(desk):
    desk.save("no path")
    seen = desk.until(lambda seen: seen is not None)
    assert set(seen.poses) == {"ee"}
    assert seen.problem == "Only ee is drawn: my_fk: TypeError no path."


def test_a_question_that_fails_on_our_side_is_said_and_the_next_is_asked(desk):
    desk.save("2")
    desk.until(lambda seen: seen is not None)
    desk.fake.text = "no number"  # the fake itself fails over it
    desk.student.want(np.ones(7))
    assert "could not convert" in desk.until(lambda seen: seen.problem).problem
    desk.fake.text = "3"
    desk.student.want(np.zeros(7))
    desk.until(lambda seen: seen.poses)


def test_of_many_configurations_the_last_one_is_answered(desk):
    desk.save("2")
    desk.until(lambda seen: seen is not None)
    for x in range(50):
        desk.student.want(np.full(7, x / 100))
    desk.until(lambda seen: seen is not None and seen.q[0] == 0.49)


def test_a_tab_may_ask_any_function(desk):
    desk.save("2")
    desk.until(lambda seen: seen is not None)
    (reply,) = desk.student.ask([Question("view", "jacobian", (1.0,))])
    np.testing.assert_array_equal(reply.value, 2 * np.eye(4))


@pytest.mark.parametrize(
    ("reply", "says"),
    [
        (Reply(np.eye(4)), ""),
        (
            Reply(kind="missing"),
            "The file has no function f. To put its gap back: make start RESET=1.6.",
        ),
        (
            Reply(kind="ValueError", error="no", line=3),
            "f: It stops with ValueError: no (line 3).",
        ),
    ],
)
def test_what_is_no_answer_is_told_in_the_words_of_make_check(reply, says):
    assert describe({"f": "1.6"}, "f", reply) == says


def test_a_file_that_loads_the_robot_at_its_top_is_opened_as_make_check_does(tmp_path):
    script = tmp_path / "day1_transforms.py"
    load = "from robo47 import panda\nMODEL = panda.load()\n"
    script.write_text(load + "def f(model): return model.nq + MODEL.nq")
    model = panda.load()
    question = Question("view", "f", (model,))
    with Sandbox() as sandbox:
        source = source_of(find_day(1), model, sandbox)
        (reply,) = source.open(script).ask([question], SECONDS)
    assert reply.value == 14, reply.error


def test_a_day_without_a_ghost_is_watched_and_asked_all_the_same(tmp_path):
    script = tmp_path / "day.py"
    script.write_text("2")
    desk = Desk(script, ghost=None)
    desk.student.start()
    try:
        desk.student.want(panda.READY_Q)
        desk.until(lambda seen: seen is not None and not seen.problem)
        assert desk.fake.asked == []  # for no pose
        (reply,) = desk.student.ask([Question("view", "space_jacobian", ())])
        assert reply.value[0, 0] == 2.0
        desk.save("broken")
        desk.until(lambda seen: "invalid syntax" in seen.problem)
        assert desk.opened.count("saved") >= 2
    finally:
        desk.student.close()
