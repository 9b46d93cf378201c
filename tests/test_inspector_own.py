"""The student's functions beside the library's, as a tab of the page asks them."""

import asyncio
import threading
from functools import partial

import numpy as np
import pytest

from conftest import Answers
from labkit.base.exchange import Reply
from labkit.inspector import words
from labkit.inspector.animate import Animation, Jobs
from labkit.inspector.own import NoAnswerError, Own

pytestmark = pytest.mark.kit

LIBRARY = {
    "double": lambda x: 2.0 * x,
    "both": lambda x: (x, -x),
    "any_root": lambda x: np.sqrt(x),
}
ONE = np.array([1.0, 4.0])


def own_of(functions, free=()):
    student = Answers(functions)
    return student, Own(student, LIBRARY, free)


def test_an_answer_is_the_students_and_is_compared_with_the_librarys():
    functions = {"double": lambda x: 2.0 * x, "both": lambda x: (x, x)}
    own = Own(Answers(functions), LIBRARY, units={"both": "N m"})
    np.testing.assert_array_equal(own.double(ONE), 2 * ONE)
    assert own.says() == ("YOUR double: the same as the library's", "good")
    assert own.both(ONE)[1][1] == 4.0  # as wrong as it is
    assert own.says() == ("YOUR functions. Off the library's: both by 8 N m", "bad")


def test_how_far_off_is_said_without_a_power_of_ten():
    _, own = own_of({"double": lambda x: 1e4 * x})
    own.double(ONE)
    assert own.says()[0].endswith("double by 40,000")
    assert [words.digits(x) for x in (0.00123456, 999.6, 67_851.9)] == [
        "0.00123", "1,000", "67,900",
    ]  # fmt: skip


def test_a_function_that_was_not_asked_before_is_announced():
    said = []
    student = Answers({"double": lambda x: 2.0 * x, "both": lambda x: (x, -x)})
    own = Own(student, LIBRARY, first=lambda: said.append(own.says()[1]))
    own.double(ONE)
    own.double(ONE)
    assert said == ["quiet"]
    own.many(("double", ONE), ("both", ONE))
    assert said == ["quiet", "good"]
    student.version = 2
    own.double(ONE)
    assert len(said) == 3


def test_what_a_tab_finds_wrong_is_held_against_its_file_alone():
    student, own = own_of({"double": lambda x: 2.0 * x}, free=("double",))
    own.double(ONE)
    own.tell("double", "another way")
    assert own.says() == (
        "YOUR functions. Off the library's: double (another way)",
        "bad",
    )
    own.tell("double", "")
    assert own.says()[1] == "good"
    own.tell("double", "another way")
    student.version = 2
    own.double(ONE)
    assert own.says()[1] == "good"


def test_what_is_not_written_is_the_librarys_and_is_called_that():
    _, own = own_of({"double": lambda x: 2.0 * x})
    assert own.any_root(4.0) == 2.0
    says = "At work: the library's any_root (yours is not written yet)"
    assert own.says() == (says, "quiet")
    own.double(ONE)
    assert own.says()[0].startswith("YOUR double: the same as the library's; besides")


def test_what_the_library_refuses_is_told_of_who_gave_it():
    def positive(x):
        raise ValueError("x is below 0")

    library = {**LIBRARY, "root": positive}
    own = Own(Answers({"double": lambda x: -2.0 * x}), library)
    with pytest.raises(NoAnswerError, match="The library's root refuses what it is"):
        own.root(ONE)
    own.double(ONE)
    with pytest.raises(
        NoAnswerError, match=r"double by 16\. The library's root refuses"
    ):
        own.root(ONE)


def test_a_name_that_the_tab_did_not_give_is_told():
    _, own = own_of({})
    with pytest.raises(AttributeError, match="given has no ask"):
        own.ask([("double", ONE)])


def test_without_a_file_all_is_the_librarys():
    student = Answers({})
    student.there = False
    own = Own(student, LIBRARY)
    np.testing.assert_array_equal(own.double(ONE), 2 * ONE)
    says = "At work: the library's double (there is no file yet)"
    assert own.says() == (says, "quiet")


@pytest.mark.parametrize(
    ("answer", "says"),
    [
        (np.zeros(3), r"YOUR double returned shape \(3,\)"),
        (np.array([1.0, np.nan]), "YOUR double returned NaN"),
        (np.array([1.0, np.inf]), "a number without end"),
        (None, "YOUR double returned nothing"),
        ((ONE, ONE), r"returned shape \(2,\) and shape \(2,\)"),
    ],
)
def test_what_is_no_answer_is_said_and_nothing_else_is_passed_off_as_it(answer, says):
    _, own = own_of({"double": lambda x: answer})
    with pytest.raises(NoAnswerError, match=says):
        own.double(ONE)


@pytest.mark.parametrize(
    ("reply", "says"),
    [
        (Reply(kind="stopped", error="it runs on"), "YOUR double did not return: it"),
        (
            Reply(kind="ValueError", error="no", line=3),
            "double: Your function stops with an error. The error occurs in line 3",
        ),
    ],
)
def test_what_stops_is_told_in_the_words_of_make_check(reply, says):
    student, own = own_of({})
    student.ask = lambda *_: [reply]
    with pytest.raises(NoAnswerError, match=says):
        own.double(ONE)


def test_a_file_that_is_not_asked_any_more_says_why():
    student, own = own_of({"both": lambda x: (x, -x)})
    own.both(ONE)
    student.problem = "double did not return. Save the file to have it asked again."
    with pytest.raises(NoAnswerError, match=r"YOUR double did not return\. Save"):
        own.double(ONE)
    assert own.says() == (f"YOUR {student.problem}", "bad")  # and not green for both


def test_a_save_forgets_what_was_wrong_before():
    student, own = own_of({"double": lambda x: -2.0 * x})
    own.double(ONE)
    assert own.says()[1] == "bad"
    student.version, student.functions = 2, {"double": lambda x: 2.0 * x}
    own.double(ONE)
    assert own.says()[1] == "good"


def test_what_an_old_file_answers_late_is_not_held_against_the_new_one():
    def late(x):
        student.version, student.functions = 2, {"double": lambda x: 2.0 * x}
        return -2.0 * x

    student, own = own_of({"double": late})
    own.double(ONE)  # the file was saved meanwhile
    assert not own.fresh()
    assert own.says() == ("", "quiet")
    own.double(ONE)
    assert own.fresh()
    assert own.says()[1] == "good"


def test_who_gave_no_answer_is_not_green_because_another_one_does():
    student, own = own_of({"double": lambda x: None, "both": lambda x: (x, -x)})
    with pytest.raises(NoAnswerError):
        own.double(ONE)
    own.both(ONE)
    assert own.says() == ("YOUR double returned nothing", "bad")
    student.functions["double"] = lambda x: 2.0 * x  # as of another x
    own.double(ONE)
    assert own.says()[1] == "good"


def test_a_loop_and_a_job_owe_an_answer_until_their_first_one():
    async def told():
        may = threading.Event()
        said = []
        loop = Animation(
            lambda t: said.append(loop.due), 50, lambda e: None, lambda t: may.wait(9)
        )
        job = Jobs(lambda error: said.append(job.due))
        loop.start()
        job.want(partial(may.wait, 9), lambda found: None)
        owe = loop.due, job.due
        may.set()
        while len(said) < 4:
            await asyncio.sleep(0.01)
        loop.stop()
        return owe, said[:4]  # the loop may answer once more before it stops

    assert asyncio.run(told()) == ((True, True), [False] * 4)


def test_a_function_with_many_right_answers_is_not_compared():
    _, own = own_of({"any_root": lambda x: -np.sqrt(x)}, free=("any_root",))
    assert own.any_root(4.0) == -2.0
    assert own.says() == ("YOUR any_root at work", "good")


def test_functions_of_all_days_answer_from_sandboxes(monkeypatch):
    from labkit.inspector import own
    from labkit.lesson.day import Day, find_day

    monkeypatch.setattr(Day, "work", find_day(5).source)
    monkeypatch.setattr(own, "all_days", lambda: [find_day(5)])
    monkeypatch.setattr(own, "statuses", lambda day: {"5.2": "passed"} | dict.fromkeys(
        [task.id for task in day.tasks if task.id != "5.2"], "wrong"
    ))  # fmt: skip
    library = {"pd_gains": None, "pd_torque": LIBRARY["double"]}
    with own.week(library) as fns:
        np.testing.assert_array_equal(fns.pd_gains(20.0, 1.0), [400.0, 40.0])
        assert fns.pd_torque is LIBRARY["double"]  # the file's is wrong
        assert (fns.yours, fns.total) == (1, 2)
        with pytest.raises(NoAnswerError, match="YOUR pd_gains: TypeError"):
            fns.pd_gains(ONE)


def test_what_an_answer_says_cannot_become_part_of_the_page():
    from labkit.inspector import words

    student, own = own_of({})
    evil = "<img src=x onerror=alert(1)>"
    student.ask = lambda *_: [Reply(kind="ValueError", error=evil)]
    with pytest.raises(NoAnswerError) as said:
        own.double(ONE)
    shown = words.judged(str(said.value), "whose", "bad")
    assert "<img" not in shown
    assert "&lt;img" in shown


def test_a_way_may_have_any_number_of_rows_and_no_other_width():
    library = {"way": lambda: np.zeros((3, 2))}
    own = Own(Answers({"way": lambda: np.ones((5, 2))}), library, any_rows={"way"})
    assert own.way().shape == (5, 2)
    assert own.says() == ("YOUR way at work", "good")
    own = Own(Answers({"way": lambda: np.ones((5, 3))}), library, any_rows={"way"})
    with pytest.raises(NoAnswerError, match=r"returned shape \(5, 3\)"):
        own.way()
