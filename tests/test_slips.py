"""A slip that nobody named: the lab's own body with one place of it changed."""

import ast

import numpy as np
import pytest
from test_claims import right, told

from labkit.judge.miswritten import besides, miswritten, overlap, reads

pytestmark = pytest.mark.kit

TEXT = "def f(x, y):\n    z = 2.0 * x + y\n    return z - x @ y.T\n"


def one(text=TEXT):
    return ast.parse(text).body[0]


def of(kind, text=TEXT):
    function = one(text)
    some = miswritten(function, {"np": np})
    return {reads(function, slip) for slip in some if slip.kind == kind}


def test_signs_factors_names_and_lines_are_changed_one_at_a_time():
    assert "z = 2.0 * x - y" in of("sign")
    assert "z - x @ y" in of("transpose")
    assert "3.0 * x + y" in of("number")
    assert "z - z @ y.T" in of("name")
    assert "without z = 2.0 * x + y" in of("line")


def test_a_function_is_put_back_as_it_was():
    function = one()
    before = ast.dump(function)
    slips = miswritten(function, {})
    assert ast.dump(function) == before
    besides(function, {}, slips[0])
    reads(function, slips[-1], slips[0])
    assert ast.dump(function) == before


def test_a_slip_computes_what_it_reads():
    function = one()
    slips = miswritten(function, {})
    code = {reads(function, slip): slip.code for slip in slips}
    x, y = np.array([1.0, 2.0]), np.array([3.0, 5.0])
    assert np.array_equal(code["z = 2.0 * x - y"](x, y), 2 * x - y - x @ y)


def test_a_second_slip_is_never_in_the_place_of_the_first():
    function = one()
    first = miswritten(function, {})[0]
    others = besides(function, {}, first)
    assert others
    assert not any(overlap(first, other) for other in others)


def test_a_loop_that_may_never_end_has_no_slips():
    assert not of(
        "sign", "def f(x):\n    while x < 3:\n        x = x + 1\n    return x\n"
    )
    least = "def f(A, b):\n    return np.linalg.lstsq(A, b)[0]\n"
    assert miswritten(one(least), {}) == []


def test_a_slip_is_told_by_its_kind_and_by_how_it_reads():
    move, skew = right(2, "exp_screw"), right(2, "skew")

    def exp_screw(S, theta):
        T = move(S, theta)
        K = skew(S[:3])
        T[:3, 3] += 2 * np.sin(theta) * K @ K @ S[3:]
        return T

    says = told(2, "2.4", exp_screw=exp_screw)
    assert "One sign is the other way round." in says
    assert "the lab's own with `(theta + s) * K @ K`, or with" in says
    assert "reproduces your output" in says


def test_two_slips_whose_parts_add_up_are_told_together():
    bias = right(6, "bias_acceleration")

    def bias_acceleration(J_space, qd, p):
        a = bias(J_space, qd, p)
        V = J_space @ qd
        flat = bias(J_space, qd, 0 * p)
        at_0 = flat[3:] - np.cross(V[:3], V[3:])
        return np.append(a[:3], 2 * at_0 - a[3:])

    says = told(6, "6.2", bias_acceleration=bias_acceleration)
    assert "Two things at once: one sign is the other way round" in says
    assert "`A[3:] - np.cross(alpha, p)`" in says


def test_a_slip_that_the_fresh_questions_do_not_show_is_not_told():
    turn = right(1, "quat_to_R")

    def quat_to_R(quat):
        R = turn(quat)
        R[0, 2] += 1e-3 * (abs(quat[0]) > 0.9)
        return R

    assert "reproduces your output" not in told(1, "1.4", quat_to_R=quat_to_R)


def test_a_whenever_holds_for_arguments_of_other_sizes_as_well():
    solve = right(10, "hand_eye")

    def hand_eye(A, B):
        X = solve(A, B)
        X[:3, 3] = solve(A[:2], B[:2])[:3, 3]
        return X

    assert "whenever" not in told(10, "10.8", hand_eye=hand_eye)


def test_what_a_condition_is_made_of_is_no_factor_and_no_sign():
    text = "def f(x, y):\n    return x if 2.0 * y > x else y\n"
    assert "x if 1.0 * y > x else y" in of("condition", text)
    assert not of("number", text)
    assert all("2.0 * y > x" in one for one in of("factor", text))
