"""Controlled experiments: what a wrong function is told of when it is right."""

from dataclasses import replace

import numpy as np
import pytest

from labkit.judge.crossed import crossed
from labkit.judge.neutral import neutrals
from labkit.judge.ranges import spans
from labkit.judge.right_when import Experiments
from robo47 import se3

pytestmark = pytest.mark.kit


def told(mine, right, calls, names, says=Experiments.neutral):
    def answers_of(function):
        def answer(call):
            try:
                return function(*call)
            except Exception:
                return None

        return lambda some: map(answer, some)

    both = answers_of(mine), answers_of(right)
    return says(Experiments(calls, names, *both, 1e-5))


def computed_torque(M, acc, e, ed, kp, kd):
    return M @ (acc + kp * e + kd * ed)


def states(n=8):
    rng = np.random.default_rng(3)
    A = rng.normal(size=(n, 7, 7))
    M = A @ np.swapaxes(A, 1, 2) + np.eye(7)
    return [(M[i], *rng.uniform(0.1, 2, (5, 7))) for i in range(n)]


NAMES = ["M", "acc", "e", "ed", "kp", "kd"]


def test_a_term_outside_a_bracket_is_found_by_its_neutral_arguments():
    outside = lambda M, acc, e, ed, kp, kd: M @ (acc + kp * e) + kd * ed  # noqa: E731
    says = told(outside, computed_torque, states(), NAMES)
    assert says == "The result is correct whenever `ed` is 0, and whenever `kd` is 0."


def test_one_number_for_all_is_right_where_all_are_equal():
    one = lambda M, acc, e, ed, kp, kd: M @ (acc + kp[0] * e + kd * ed)  # noqa: E731
    says = told(one, computed_torque, states(), NAMES)
    assert "whenever all entries of `kp` are equal" in says
    assert "`e` is 0" in says


def test_a_right_answer_of_zeros_says_nothing():
    # With e = 0 every right answer is zero, whatever kp is.
    says = told(lambda e, kp: e, lambda e, kp: kp * e,
                [(c[2], c[4]) for c in states()], ["e", "kp"])  # fmt: skip
    assert "e is 0" not in says


def test_a_right_answer_that_is_the_same_for_all_says_nothing():
    calls = [(float(x),) for x in (0.3, 0.7, 1.1, 2.0)]
    assert told(lambda x: np.cos(2 * x), np.cos, calls, ["x"]) == ""


def test_the_sign_of_one_entry_is_told_and_not_that_of_all():
    rng = np.random.default_rng(1)
    calls = [(np.array([-abs(x[0]), *x[1:]]),) for x in rng.normal(size=(8, 4))]
    wrong = lambda q: abs(q[0]) * q[1:]  # noqa: E731
    says = told(wrong, lambda q: q[0] * q[1:], calls, ["q"])
    assert says == "The result is correct whenever `q[0]` is not negative."


def test_a_call_with_more_than_one_right_answer_says_nothing():
    # At t = 0 a ramp has just begun, or has not.
    ramp = lambda t, a: np.array([a * t, a if t >= 0 else 0.0])  # noqa: E731
    never = lambda t, a: np.array([a * t, a])  # noqa: E731
    calls = [(-t, a) for t, a in np.random.default_rng(1).uniform(0.1, 2, (8, 2))]
    parts = [lambda some, f=f: [f(*call) for call in some] for f in (never, ramp)]
    both = Experiments(calls, ["t", "a"], *parts, 1e-5)
    assert "`t` is 0" in both.neutral()
    at_edge = replace(both, at_edge=lambda t, a: abs(t) > 1e-6)
    assert "`t` is 0" not in at_edge.neutral()


def test_five_questions_must_agree():
    outside = lambda M, acc, e, ed, kp, kd: M @ (acc + kp * e) + kd * ed  # noqa: E731
    assert told(outside, computed_torque, states(4), NAMES) == ""
    assert told(lambda *a: None, computed_torque, states(), NAMES) == ""


def test_a_question_without_an_answer_says_nothing():
    calls = [(A, b) for A, b, *_ in states()]
    right = lambda A, b: np.linalg.solve(A, b)  # noqa: E731
    says = told(lambda A, b: A @ b, right, calls, ["A", "b"])
    assert says == "The result is correct whenever `A` is the identity matrix."


def test_a_pose_is_neutral_in_two_ways():
    T = se3.make_T(se3.Rz(0.3), [1.0, 2.0, 3.0])
    still, unturned = (one.value for one in neutrals(T))
    np.testing.assert_array_equal(still, se3.make_T(se3.Rz(0.3), np.zeros(3)))
    np.testing.assert_array_equal(unturned, se3.make_T(np.eye(3), [1.0, 2.0, 3.0]))


def told_of_doubling(mine, right, calls, names):
    return told(mine, right, calls, names, Experiments.doubled)


PUSHES = [(m, a) for m, a in [(1.5, 0.3), (0.4, -2.0), (3.0, 1.1), (2.2, 0.7)]]


def test_a_square_too_many_shows_when_the_argument_is_doubled():
    says = told_of_doubling(
        lambda m, a: m * m * a, lambda m, a: m * a, PUSHES, ["m", "a"]
    )
    assert says == (
        "If `m` is doubled, your result becomes 4 times as large, but it should become "
        "2 times as large."
    )


def test_an_argument_that_is_not_used_is_named():
    says = told_of_doubling(lambda m, a: m, lambda m, a: m + a**2, PUSHES, ["m", "a"])
    same = "your result stays the same, but it should change."
    assert says == f"If `a` is doubled, {same}"


@pytest.mark.parametrize(("of_a", "says"), [(1.0, True), (5.0, False)])
@pytest.mark.parametrize("factor", [1.0, 4.0])
def test_how_an_answer_grows_is_also_tried_at_fresh_calls(of_a, says, factor):
    def mine(m, a):
        near = a != 5.0  # a case that is drawn seldom
        return (1.0 + a if near else m) if factor == 1 else (m * m * a if near else m)

    def right(m, a):
        return m * a

    def of(function):
        return lambda some: [function(*call) for call in some]

    fresh = [(m, of_a) for m, _ in PUSHES]
    both = of(mine), of(right)
    tried = Experiments(PUSHES, ["m", "a"], *both, 1e-5, drawn=lambda: fresh)
    assert ("If `m` is doubled" in tried.doubled()) == says


def test_an_answer_that_grows_as_the_right_one_says_nothing():
    assert (
        told_of_doubling(lambda m, a: 3 * m * a, lambda m, a: m * a, PUSHES, ["m", "a"])
        == ""
    )


def test_only_an_argument_that_may_be_told_is_doubled_at_many_calls():
    asked = []

    def mine(m, v):
        asked.append((m, v))
        return m * v + 0.3

    known = [(float(a), float(b)) for a, b in np.random.default_rng(0).random((60, 2))]
    some = Experiments(
        known[:6],
        ["m", "v"],
        lambda calls: [mine(*call) for call in calls],
        lambda calls: [m * v for m, v in calls],
        1e-5,
        known,
        [False] * 60,
    )
    assert some.doubled() == ""
    assert len(asked) == 6 + 2 * 6


def test_an_answer_that_should_not_grow_is_told_so():
    norms = [(np.array([a, 1.0]),) for a in (0.3, -2.0, 1.5, 0.8)]
    wrong = lambda v: v / np.sqrt(np.linalg.norm(v))  # noqa: E731
    says = told_of_doubling(wrong, lambda v: v / np.linalg.norm(v), norms, ["v"])
    assert says == (
        "If `v` is doubled, your result becomes 1.414 times as large, but it should "
        "stay the same."
    )


def test_a_rotation_is_not_doubled():
    calls = [(se3.Rz(x), np.ones(3)) for x in (0.3, 0.7, 1.1)]
    ones, right = lambda R, v: np.ones(3), lambda R, v: R @ v
    says = told_of_doubling(ones, right, calls, ["R", "v"])
    same = "your result stays the same, but it should change."
    assert says == f"If `v` is doubled, {same}"


def test_answers_of_unlike_length_are_no_reason_to_stop():
    calls = [(np.arange(1.0, n), float(n)) for n in (3, 5, 8, 4)]
    says = told(lambda x, a: x + a, lambda x, a: x * a, calls, ["x", "a"])
    assert "a is 1" not in says


def test_arguments_are_crossed_at_their_ends():
    calls = [(0.5, 1.0, 3.0), (0.7, 2.0, 4.0), (0.9, 1.5, 3.5)]
    some = crossed(calls, 0)
    corners = {call[1:] for call in some}
    assert {(low, high) for low in (0.1, 1.0, 2.0) for high in (0.3, 3.0, 4.0)} <= {
        tuple(round(x, 9) for x in corner) for corner in corners
    }
    assert some == crossed(calls, 0)
    assert {call[0] for call in some} <= {0.5, 0.7, 0.9}
    assert crossed([(0.5,), (0.7,)], 0) == []


def ranged(conditions=()):
    """Return what a function is told that is wrong for a large x, or y over z.

    It was asked with no large y over z, and no other size of a whole call makes one.
    """
    sizes = (0.1, 0.2, 0.4, 0.6, 0.9, 1.6, 2.5, 3.0)
    known = [(x, y, z) for x in sizes for y, z in ((4.0, 1.0), (1.0, 0.2))]
    right = lambda x, y, z: x + y + z  # noqa: E731
    mine = lambda x, y, z: x + y + z + (x > 1.2 or 0 < 12 * z < y)  # noqa: E731
    verdicts = [mine(*call) == right(*call) for call in known]
    wrong = [c for c, ok in zip(known, verdicts, strict=True) if not ok]
    both = [lambda some, f=f: [f(*call) for call in some] for f in (mine, right)]
    return Experiments(
        wrong[-4:], ["x", "y", "z"], *both, 1e-5, known, verdicts, conditions
    ).neutral()


def test_a_range_is_not_said_where_another_argument_ends_it():
    assert "<" not in ranged()


def test_a_range_contains_an_end_only_if_it_was_answered_rightly():
    asked = [0.0, 0.5, 1.0, 2.0]
    (span,) = spans(1.0, asked, [False, True, True, True])
    assert span.says.format("zeta") == "for `0 < zeta <= 2`"
    assert [*map(span.holds, (0.0, 1e-9, 2.0, 2.1))] == [False, True, True, False]
    values = span.values(asked)
    assert min(values) > 0.0
    assert max(values) == 2.0
    (span,) = spans(1.0, [0.1, 0.2, 0.3, 1.1], [True, True, True, False])
    assert span.says == "for `0.1 <= {} < pi / 6`"


def test_a_row_s_condition_is_said_where_it_holds_alone():
    small = ("x <= 1", lambda x, y, z: x <= 1)
    alone = ("x <= 1 and y <= 12 z", lambda x, y, z: x <= 1 and y <= 12 * z)
    assert ranged([alone]).startswith(f"The result is correct whenever {alone[0]}")
    assert "x <= 1" not in ranged([small])


def test_a_condition_on_an_entry_does_not_hold_of_a_vector_without_it():
    rng = np.random.default_rng(1)
    calls = [(np.array([*x[:2], -abs(x[2])]),) for x in rng.normal(size=(8, 3))]
    short = (np.array([0.6]),)  # was answered wrongly, too
    right = lambda x: x[-1] * x  # noqa: E731
    mine = lambda x: abs(x[-1]) * x if len(x) > 1 else x + 9  # noqa: E731
    both = [lambda some, f=f: [f(*call) for call in some] for f in (mine, right)]
    known = [*calls, short]
    tried = Experiments(calls[-6:], ["x"], *both, 1e-5, known, [False] * 9)
    assert tried.neutral() == "The result is correct whenever `x[2]` is not negative."


def test_a_function_that_is_right_with_one_entry_is_told_so():
    rng = np.random.default_rng(4)
    calls = [(rng.normal(size=n), rng.normal(size=(n, 2))) for n in (1, 2, 3) * 20]
    several = [call for call in calls if len(call[0]) > 1]

    def answers_of(function):
        return lambda some: [function(*call) for call in some]

    seen = Experiments(
        several[-6:],
        ["z", "H"],
        answers_of(lambda z, H: z[0] * H[0]),
        answers_of(lambda z, H: z @ H),
        1e-5,
        known=calls,
        right=[len(z) == 1 for z, _ in calls],
    )
    assert seen.neutral() == "The result is correct whenever `z` has one entry."


def test_a_condition_is_tried_with_another_argument_neutral_as_well():
    """Only at a bound it shows: x is 0, and so is the lower bound."""
    rng = np.random.default_rng(6)
    calls = [(rng.uniform(-1, 1, 3), rng.uniform(-9, -5, 3)) for _ in range(60)]

    def answers_of(function):
        return lambda some: [function(*call) for call in some]

    def right(x, low):
        return np.where(x <= low, 1.0, x + low)

    def wrong(x, low):
        return np.where(x == low, 2.0, x * x * x + x + low)

    seen = Experiments(
        calls[-6:],
        ["x", "low"],
        answers_of(lambda x, low: wrong(x, low)),
        answers_of(right),
        1e-5,
        known=calls,
        right=[False] * len(calls),
        drawn=lambda: calls,
    )
    assert "`x` is 0" not in seen.neutral()
    without = replace(seen, mine=answers_of(lambda x, low: x**3 + right(x, low)))
    assert "whenever `x` is 0" in without.neutral()
