"""The student's functions beside the library's, as a tab of the page asks them."""

import numpy as np
import pytest

from conftest import Answers
from labkit.base.exchange import Reply
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
    return student, Own(lambda: student, LIBRARY, free)


def test_an_answer_is_the_students_and_is_compared_with_the_librarys():
    _, own = own_of({"double": lambda x: 2.0 * x, "both": lambda x: (x, x)})
    np.testing.assert_array_equal(own.double(ONE), 2 * ONE)
    assert own.says() == ("YOUR double: the same as the library's", "good")
    assert own.both(ONE)[1][1] == 4.0  # as wrong as it is
    assert own.says() == ("YOUR functions. Off the library's: both by 8", "bad")


def test_what_is_not_written_is_the_librarys_and_is_called_that():
    _, own = own_of({"double": lambda x: 2.0 * x})
    assert own.any_root(4.0) == 2.0
    says = "At work: the library's any_root (yours is not written yet)"
    assert own.says() == (says, "quiet")
    own.double(ONE)
    assert own.says()[0].startswith("YOUR double: the same as the library's; besides")


def test_without_a_file_all_is_the_librarys():
    own = Own(lambda: None, LIBRARY)
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
        (Reply(kind="stopped", error="it runs on"), "YOUR double: .*did not return"),
        (Reply(kind="ValueError", error="no", line=3), r"ValueError: no \(line 3\)"),
    ],
)
def test_what_stops_is_told_in_the_words_of_make_check(reply, says):
    student, own = own_of({})
    student.ask = lambda questions: [reply]
    with pytest.raises(NoAnswerError, match=says):
        own.double(ONE)


def test_a_save_forgets_what_was_wrong_before():
    student, own = own_of({"double": lambda x: -2.0 * x})
    own.double(ONE)
    assert own.says()[1] == "bad"
    student.version, student.functions = 2, {"double": lambda x: 2.0 * x}
    own.double(ONE)
    assert own.says()[1] == "good"


def test_a_function_with_many_right_answers_is_not_compared():
    _, own = own_of({"any_root": lambda x: -np.sqrt(x)}, free=("any_root",))
    assert own.any_root(4.0) == -2.0
    assert own.says() == ("YOUR any_root", "good")
