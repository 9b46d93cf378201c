"""A row names the inputs that its usual ones do not reach; what skips them is wrong."""

import numpy as np
import pytest
from toyrows import row_of, told

from labkit.judge import Scalar

LIMIT = 2.0


def row():
    """Return the row of a function that doubles what is below a limit."""
    made = row_of(
        Scalar(),
        lambda x: 2.0 * x if x < LIMIT else x,
        lambda rng: [(float(x),) for x in (1.0, 3.0, 0.5, *rng.numbers(0.3, 1.8, 3))],
    )

    @made.spans
    def _(rng):
        yield from ((x,) for x in (1e-7, 1e7, LIMIT))

    return made


def right(x):
    return 2.0 * x if x < LIMIT else x


@pytest.mark.parametrize(
    ("wrong", "call"),
    [
        (
            lambda x: right(x) if abs(x) > 1e-6 else 0.0,
            "f(1e-07) returned 0; expected 2e-07.",
        ),
        (lambda x: min(right(x), 1e6), "f(10000000.0) returned 1e+06; expected 1e+07."),
        (lambda x: 2.0 * x if x <= LIMIT else x, "f(2) returned 4; expected 2."),
    ],
)
def test_a_guard_a_cap_and_a_limit_are_found_and_shown(wrong, call):
    found = told(row(), wrong)
    assert found.mistake == "not-at-every-size"
    assert found.call.startswith(call)


def test_the_right_function_passes_in_another_order_of_sums():
    assert told(row(), right).status == "passed"
    assert told(row(), lambda x: right(x) * (1.0 + 1e-12)).status == "passed"


def test_a_value_of_an_argument_is_put_into_the_last_usual_call():
    made = row_of(
        Scalar(), lambda x, y: x / y, lambda rng: [(1.0, 2.0), (3.0, 4.0), (5.0, 8.0)]
    )
    made.__dict__["arguments"] = ["x", "y"]
    made.spans(x=(1e-9,), y=(lambda y: 1e6 * y,))
    (held,) = made.ask.held_out
    assert held.inputs(np.random.default_rng(1)) == [(1e-9, 8.0), (5.0, 8e6)]
