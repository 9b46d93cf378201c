"""A mutant's sentence points at the student's own line, in the student's own words."""

import ast
import re
from dataclasses import replace

import inprocess
import pytest

from labkit.judge.own_line import OwnFunction
from labkit.judge.row import rows_of
from labkit.lesson.day import find_day
from labkit.lesson.starter import function_lines

REFERENCE = """
def f(x, y):
    a = x @ x
    b = x @ y
    c = y @ y
    s = (b - a) / (c + 2.0)
    return s * x
"""
OWN = """
def f(x, y):
    first = x @ x
    mixed = x @ y
    second = y @ y
    s = (mixed - first) / (first + 2.0)
    return s * x
"""


def function(text):
    return ast.parse(text).body[0]


def line(own, mutated):
    both = OwnFunction(function(own), function(REFERENCE))
    return both.line(ast.parse(mutated).body[0])


def test_a_line_is_found_under_other_names():
    found = line(OWN, "s = (b - a) / (a + 2.0)")
    assert (found.number, found.text) == (6, "s = (mixed - first) / (first + 2.0)")
    assert found.names["c"] == "second"


def test_a_line_with_another_variable_is_not_found():
    assert line(OWN, "s = (b - a) / (b + 2.0)") is None


def test_two_lines_of_one_form_are_none():
    twice = OWN.replace(
        "    return", "    s = (mixed - first) / (first + 2.0)\n    return"
    )
    assert line(twice, "s = (b - a) / (a + 2.0)") is None


def test_the_order_of_a_sum_and_a_product_does_not_count():
    other = OWN.replace("(first + 2.0)", "(2.0 + first)")
    assert line(other, "s = (b - a) / (a + 2.0)").number == 6


def test_a_line_of_a_loop_and_of_a_condition_reads_as_in_the_file():
    loop = "def f(x, y):\n    for k in range(x, len(y)):\n        if k > y[x]: pass\n"
    both = OwnFunction(function(loop), function(loop))
    for text in ("for k in range(x, len(y))", "if k > y[x]"):
        found = both.line(ast.parse(f"{text}: pass").body[0])
        assert found.text == text


@pytest.fixture
def no_catalogue(monkeypatch):
    """Take the author's mistakes of 11.1 away: the machine is left."""
    row = rows_of(find_day(11))["closest_points_segments"]
    bare = replace(row.ask, mistakes=(), unnamed=None)
    monkeypatch.setitem(vars(row), "ask", bare)


def told(number, task, name, student, body):
    """Return what a student's file is told, one function of which is their own."""
    day = find_day(number)
    text = day.source.read_text("utf-8")
    lines = "\n".join(function_lines(text, name)[2])
    file = student(text.replace(lines, body.strip("\n")), day.source.name)
    verdict = inprocess.verdicts(day, file, task)[task]
    assert verdict.status == "wrong"
    return verdict.message


SEGMENTS = """
def closest_points_segments(a0, a1, b0, b1):
    d1 = a1 - a0
    d2 = b1 - b0
    r = a0 - b0
    aa = d1 @ d1
    bb = d1 @ d2
    ee = d2 @ d2
    cc = d1 @ r
    ff = d2 @ r
    den = aa * ee - bb * bb
    s = np.clip((bb * ff - ee * cc) / den, 0, 1) if den > 1e-12 * aa * ee else 0.0
    t = np.clip((bb * s + ff) / ee, 0, 1) if ee > 0 else 0.0
    s = np.clip((bb * t - cc) / aa, 0, 1) if aa > 0 else 0.0
    return np.array([a0 + s * d1, b0 + t * d2])
"""


@pytest.mark.kit
@pytest.mark.parametrize(
    ("right", "wrong", "says"),
    [
        (
            "(bb * s + ff) / ee",
            "(bb * s + ff) / aa",
            "Your code uses `aa` (squared length of the first segment) where another "
            "value (squared length of the second segment) belongs. The wrong line is "
            "line N: `t = np.clip((bb * s + ff) / aa, 0, 1) if ee > 0 else 0.0`.",
        ),
        (
            "(bb * s + ff) / ee",
            "(bb * s - ff) / ee",
            "Your code reverses the sign of `ff`. The wrong line is line N: "
            "`t = np.clip((bb * s - ff) / ee, 0, 1) if ee > 0 else 0.0`.",
        ),
    ],
)
@pytest.mark.usefixtures("no_catalogue")
def test_a_mutant_is_told_by_the_students_line(student, right, wrong, says):
    own = SEGMENTS.replace(right, wrong)
    message = told(11, "11.1", "closest_points_segments", student, own)
    assert re.sub(r"line \d+", "line N", message).startswith(says)


@pytest.mark.kit
@pytest.mark.usefixtures("no_catalogue")
def test_names_of_the_kits_solution_are_never_quoted(student):
    own = """
def closest_points_segments(a0, a1, b0, b1):
    best, pair = np.inf, None
    for k in range(2001):
        s = k / 2000
        p = a0 + s * (a1 - a0)
        t = np.clip((p - b0) @ (b1 - b0) / ((b1 - b0) @ (b1 - b0)), 0, 1)
        q = b0 + t * (b1 - b0)
        if np.linalg.norm(p - q) < best:
            best, pair = np.linalg.norm(p - q), np.array([p, a0 + t * (a1 - a0)])
    return pair
"""
    message = told(11, "11.1", "closest_points_segments", student, own)
    assert "across" not in message


PROXIMAL = """
def mass_matrix(J_space, G, armature):
    n = len(G)
    carried = [np.sum(G[i:], axis=0) for i in range(n)]
    M = np.diag(np.asarray(armature, dtype=float))
    for i in range(n):
        for j in range(n):
            M[i, j] += J_space[:, i] @ carried[min(i, j)] @ J_space[:, j]
    return M
"""


def test_a_counter_of_ones_own_is_not_that_of_a_solution(student):
    """A right solution has `G[j:]`, and `G[i:]` is right in this one."""
    says = told(4, "4.3", "mass_matrix", student, PROXIMAL)
    assert "wrong expression" not in says
    assert "a wrong index or range" in says


NOT_MOVED_BACK = """
def arm_regressor(J_space, T_links, qd, qdd, g):
    n = len(qd)
    Y = np.zeros((n, 10 * n))
    V, A = np.zeros(6), np.concatenate([np.zeros(3), -g])
    for i in range(n):
        S = J_space[:, i]
        V = V + S * qd[i]
        A = A + S * qdd[i] + ad(V) @ (S * qd[i])
        X = adjoint(se3.inverse(T_links[i]))
        wrench = link_regressor(X @ V, X @ A)
        for j in range(i + 1):
            Y[j, 10 * i : 10 * i + 10] = J_space[:, j] @ wrench
    return Y
"""


@pytest.mark.kit
def test_a_factor_may_be_missing_where_a_value_is_used(student):
    says = told(8, "8.3", "arm_regressor", student, NOT_MOVED_BACK)
    assert "`wrench = link_regressor(X @ V, X @ A)`, or one that uses `wrench`." in says


UPWARD_AND_UNDAMPED = """
def hybrid_wrench(e, V_err, K, D, force):
    w = K @ e + D @ V_err
    w[5] = force
    return w
"""


@pytest.mark.kit
def test_a_difference_without_its_first_term_has_a_wrong_sign_as_well(student):
    says = told(6, "6.9", "hybrid_wrench", student, UPWARD_AND_UNDAMPED)
    assert says.startswith("Your code omits a term and reverses one sign. The wrong")
