"""An answer that differs from the reference and has the property that is asked for."""

import numpy as np
import pytest
from toyrows import row_of, told

from labkit.check.report import Report, as_text
from labkit.check.tasks import TaskResult
from labkit.judge import Scalar, Vector
from labkit.lesson.day import find_day


def root_row():
    """Return the row of a function that may return either square root."""
    row = row_of(
        Scalar(), np.sqrt, lambda rng: [(np.array(x),) for x in (1.0, 4.0, 9.0, 2.0)]
    )
    row.valid(lambda x, y: abs(y * y - x) < 1e-9)
    return row


def solving_row():
    """Return the row of the midpoint of two numbers that are equal up to noise."""

    def inputs(rng):
        for a, b in ((1.0, 1.0), (3.0, 3.0), (-2.0, -2.0), (1.0, 1.5), (2.0, 1.2)):
            yield (np.array([a, b]),)

    row = row_of(Scalar(), np.mean, inputs)
    row.valid("Valid without noise, by another method: the mean is asked for.")(
        lambda pair, x: bool(np.all(np.abs(pair - x) < 1e-9))
    )
    return row


@pytest.mark.parametrize("sign", [lambda x: -1.0, lambda x: (-1.0) ** (x > 3)])
def test_any_answer_passes_that_has_the_property(sign):
    assert told(root_row(), lambda x: sign(x) * np.sqrt(x)).status == "passed"


def test_an_answer_without_the_property_is_wrong_and_is_the_one_that_is_shown():
    def function(x):
        return -np.sqrt(x) if x < 9 else np.array(2.0)

    found = told(root_row(), function)
    assert found.status == "wrong"
    assert found.call.startswith("f(9) returned 2; expected 3.")


def test_a_property_does_not_excuse_another_shape():
    assert told(root_row(), lambda x: np.array([x, x])).mistake == "shape"


def test_another_method_is_told_so_and_does_not_pass():
    found = told(solving_row(), lambda pair: pair[0])
    assert (found.status, found.mistake) == ("wrong", "another-method")
    assert found.message == (
        "Valid without noise, by another method: the mean is asked for."
    )
    assert found.valid


def test_of_another_method_with_a_named_mistake_one_remedy_is_told():
    row = solving_row()
    row.more["method"] = "Your result is another one. Compute the mean."
    row.wrong("first", "your function returns `pair[0]`")(lambda pair: pair[0])
    found = told(row, lambda pair: pair[0])
    assert found.message.startswith(
        "Your result is another one. Your function returns `pair[0]`. "
    )


def test_a_method_is_no_excuse_where_one_valid_answer_is_missed():
    found = told(solving_row(), lambda pair: pair[0] + (pair[0] == 3.0))
    assert not found.valid
    assert "another method" not in found.message


def test_the_right_method_passes():
    assert told(solving_row(), np.mean).status == "passed"


def test_the_report_calls_it_valid():
    day = find_day(1)
    verdict = told(solving_row(), lambda pair: pair[0])
    text = as_text(Report(day, [TaskResult(day.tasks[0], verdict)]))
    assert "VALID, by another method" in text
    assert "WRONG" not in text


def test_a_vector_of_the_property_is_taken_in_each_fresh_call_too():
    def inputs(rng):
        yield (np.array([3.0, 4.0]),)
        yield from ((rng.numbers(1, 2, 2),) for _ in range(3))

    def across(v):
        return np.array([-v[1], v[0]]) / np.linalg.norm(v)

    row = row_of(Vector((2,)), across, inputs)
    row.valid(lambda v, u: abs(u @ v) < 1e-9 and abs(u @ u - 1) < 1e-9)
    assert told(row, lambda v: -across(v)).status == "passed"
    assert told(row, lambda v: across(v) * (1 + (v[0] < 3))).status == "wrong"
