"""A row names the inputs that its usual ones do not reach; what skips them is wrong."""

import numpy as np
import pytest
from toyrows import row_of, told

from labkit.base.exchange import Exchange, Question
from labkit.judge import Scalar
from labkit.judge.row import row_of as row_of_day
from labkit.judge.unusual import beyond
from labkit.lesson.day import find_day

LIMIT = 2.0
CALLS = 0.2, 0.4, 0.7, 1.0, 3.0


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

    made.__dict__["arguments"] = ["x"]
    return made


def right(x):
    return 2.0 * x if x < LIMIT else x


def test_a_small_array_is_told_by_its_entries():
    usual, *small = (
        Exchange(Question("1.1", "f", (np.full(2, size), 1.0)))
        for size in (1.0, 1e-4, 1e-5)
    )
    says = beyond(small, [usual], ["points", "step"])
    assert "very small entries of `points`. Such entries occur in the lab or" in says
    assert says.endswith("affect the result for these entries?")


def asked(H, f):
    return Exchange(Question("1.1", "f", (H, f)))


def test_an_argument_that_is_as_small_in_a_right_call_is_not_blamed():
    usual, right = asked(np.eye(2), np.ones(2)), asked(np.eye(2), 1e-5 * np.ones(2))
    failing = [asked(np.diag([1.0, 1e-6]), 1e-4 * np.ones(2))]
    says = beyond(failing, [usual, right], ["H", "f"])
    assert "wrong for matrices `H` with a large condition number. Such matrices" in says
    assert says.endswith("stop an iteration too early, for these matrices?")
    assert "very small entries of `f`" in beyond(failing, [usual], ["H", "f"])


def test_a_pose_far_away_is_told_by_its_size():
    far = np.eye(4)
    far[:3, 3] = 1e6
    says = beyond([asked(far, 1.0)], [asked(np.eye(4), 1.0)], ["T", "f"])
    assert "very large entries of `T`" in says


@pytest.mark.parametrize(
    ("wrong", "call", "which"),
    [
        (
            lambda x: right(x) if abs(x) > 1e-6 else 0.0,
            "f(1e-07) returned 0; expected 2e-07.",
            "very small values of `x`. Such values occur in the lab or in a later",
        ),
        (
            lambda x: min(right(x), 1e6),
            "f(1e7) returned 1e+06; expected 1e+07.",
            "very large values of `x`. Such values occur in the lab or in a later",
        ),
        (
            lambda x: 2.0 * x if x <= LIMIT else x,
            "f(2) returned 4; expected 2.",
            "inputs that are very small, very large or exactly at a limit. Such",
        ),
        (
            lambda x: right(x) if 1e-6 < abs(x) < 1e6 else 0.0,
            "f(",
            "inputs that are very small, very large or exactly at a limit. Such",
        ),
    ],
)
def test_a_guard_a_cap_and_a_limit_are_found_and_shown(wrong, call, which):
    found = told(row(), wrong)
    assert found.mistake == "not-at-every-size"
    assert found.call.startswith(call)
    assert f"but it is wrong for {which}" in found.message


@pytest.mark.parametrize(
    ("wrong", "how"),
    [
        (
            lambda e, ed, kp, kd: kp * e + kd * ed + (np.ndim(kp) or 1 // 0) - 1,
            "stops with an error",
        ),
        (lambda e, ed, kp, kd: kp * e + kd * ed + (np.ndim(kp) == 0), "is wrong"),
    ],
)
def test_of_single_numbers_it_is_said_whether_a_function_stops(wrong, how):
    found = told(row_of_day(find_day(5), "pd_torque"), wrong)
    assert found.mistake == "one-number-as-gain"
    assert found.message.startswith(
        f"Your function is correct if kp and kd have 7 entries each. It {how} if kp "
        "and kd are single numbers, such as the lab's KP and KD. A single number has"
    )


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


@pytest.mark.parametrize(
    ("least", "how"),
    [
        (0.9, "in 2 of 5 calls. Largest error: 9"),
        (1.5, "in 1 of 5 calls. Largest error: 9"),
    ],
)
def test_the_wrong_calls_are_counted_before_the_largest_error(least, how):
    made = row_of(Scalar(unit="m"), lambda x: x, lambda rng: [(x,) for x in CALLS])
    off = told(made, lambda x: x + x * x if x > least else x)
    assert off.message.startswith(f"The result is wrong {how} m.")
