"""A wrong function in another style: which of its own lines, changed once, is right."""

from dataclasses import replace

import inprocess
import numpy as np
import pytest

from labkit.check import tasks
from labkit.judge import repair
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import definition
from labkit.sandbox.sandbox import Sandbox

pytestmark = pytest.mark.kit

# Newton and Euler's recursion, link by link; the lab has matrices of all links.
RECURSION = """
def inverse_dynamics(J_space, G, qd, qdd, gravity):
    n = len(qd)
    V, A = np.zeros((n + 1, 6)), np.zeros((n + 1, 6))
    A[0, 3:] = -gravity
    for i in range(n):
        S = J_space[:, i]
        V[i + 1] = V[i] + S * qd[i]
        A[i + 1] = A[i] + S * qdd[i] + ad(V[i]) @ S * qd[i]
    force = np.zeros(6)
    tau = np.zeros(n)
    for i in range(n - 1, -1, -1):
        G_i = G[i]
        momentum = ad(V[MOVED]).T @ G_i @ V[i + 1]
        force = force + G_i @ A[i + 1] - momentum
        tau[i] = J_space[:, i] @ force
    return tau
"""


def written(tmp_path, number, function, body):
    """Return a day without needs, and its complete lab with another function."""
    day = find_day(number)
    tasks = tuple(replace(task, needs=()) for task in day.tasks)
    text = day.source.read_text("utf-8")
    own = definition(text, function)
    lines = text.splitlines()
    lines[own.lineno - 1 : own.end_lineno] = body.strip().splitlines()
    script = tmp_path / day.source.name
    script.write_text("\n".join(lines) + "\n", "utf-8")
    return replace(day, tasks=tasks), script


def says_of(tmp_path, number, task, function, body):
    """Return the verdict on a day's task with another function."""
    day, script = written(tmp_path, number, function, body)
    return inprocess.verdicts(day, script, task)[task]


def test_a_function_in_another_style_is_told_its_line(tmp_path):
    wrong = RECURSION.replace("MOVED", "i")  # the link before
    verdict = says_of(tmp_path, 4, "4.6", "inverse_dynamics", wrong)
    assert "`momentum = ad(V[i]).T @ G_i @ V[i + 1]`, makes all" in verdict.message
    assert verdict.message.endswith("Check the indices there.")


def test_the_same_function_without_the_mistake_passes(tmp_path):
    right = RECURSION.replace("MOVED", "i + 1")
    verdict = says_of(tmp_path, 4, "4.6", "inverse_dynamics", right)
    assert verdict.status == "passed"


def test_a_function_of_two_mistakes_is_told_no_line(tmp_path):
    wrong = RECURSION.replace("MOVED", "i").replace("-gravity", "-2.0 * gravity[::-1]")
    verdict = says_of(tmp_path, 4, "4.6", "inverse_dynamics", wrong)
    assert "One change" not in verdict.message


HELPED = """
import numpy as np

def turn(x, n):
    while n > 0.5:
        x = np.array([x[1], x[0]])
        n = n - 1
    return x

def other(x):
    return x + 1

def asked(x, n):
    return turn(other(x), n) * 3
"""


def test_helpers_are_changed_and_functions_that_are_judged_are_not():
    changes = repair.changes_of(HELPED, "asked", {"asked", "other"})
    assert {one.body.function.name for one in changes.mutants} == {"asked", "turn"}
    assert "def other" not in changes.code


def test_each_change_is_made_by_its_number_and_ends():
    changes = repair.changes_of(HELPED, "asked", {"asked"})
    space = {}
    exec(HELPED + changes.code, space)
    x = np.array([1.0, 2.0])
    answers = []
    for k in range(len(changes.mutants) + 1):
        try:
            answers.append(space[f"{repair.CALLED}{k}"](x, 3.0))
        except Exception:  # a change need not have an answer
            answers.append(None)
    assert len(answers) > 100
    np.testing.assert_array_equal(answers[0], [9.0, 6.0])
    signs = [k for k, one in enumerate(changes.mutants, 1) if one.kind == "sign"]
    assert any(np.array_equal(answers[k], [3.0, 0.0]) for k in signs)  # x - 1


QUOTED = """
def asked(x):
    if x < 0:
        raise ValueError(f"it's \\"{x:{'>'}9}\\"\\n")
    return x + 1
"""


def test_a_text_with_quotes_in_quotes_is_changed_or_is_not_but_never_stops():
    changes = repair.changes_of(QUOTED, "asked", {"asked"})
    if changes is not None:
        space = {}
        exec(QUOTED + changes.code, space)
        assert space[f"{repair.CALLED}0"](1.0) == 2.0


@pytest.mark.parametrize("source", ["", "def asked(:", "@cache\ndef asked(x): pass"])
def test_a_function_without_a_text_has_no_changes(source):
    assert repair.changes_of(source, "asked", set()) is None


# Each joint's velocity alone, so that products of two are lost.
HANGS = """
def bias_torque(J_space, G, qd, g):
    n = len(qd)
    turns = 30_000
    for _ in range(turns):  # turns ** 2 takes minutes
        pass
    tau = inverse_dynamics(J_space, G, np.zeros(n), np.zeros(n), g)
    for i in range(n):
        one = qd * (np.arange(n) == i)
        tau = tau + inverse_dynamics(J_space, G, one, np.zeros(n), np.zeros(3))
    return tau
"""


def test_a_change_that_hangs_costs_the_line_and_not_the_conditions(tmp_path):
    """The sandbox ends then, and the conditions are tried in another one."""
    day, script = written(tmp_path, 4, "bias_torque", HANGS)
    with Sandbox() as sandbox:
        (result,) = tasks.check_tasks(day, script, sandbox, "4.6", seed=1)
    assert "whenever only one entry of `qd` is not 0" in result.verdict.message


LOOPS = """
def asked(a):
    total = 0.0
    for i, (x, y) in enumerate(zip(a, a[1:])):
        if x > y:
            continue
        total = total + max(abs(z - i) for z in (x, y) if z > 0)
    return next((t for t in [total] if t > 0), 0.0)
"""


def test_targets_and_lines_that_leave_a_loop_stay_as_they_are():
    changes = repair.changes_of(LOOPS, "asked", {"asked"})
    space = {}
    exec(LOOPS + changes.code, space)
    a = np.array([1.0, 2.0, 3.0])
    assert space[f"{repair.CALLED}0"](a) == space["asked"](a)


# The trace of the step's matrix alone; the determinant is forgotten.
BY_THE_TRACE = """
def max_stable_omega(h):
    low, high = 0.0, 10.0 / h
    for _ in range(200):
        w = (low + high) / 2
        trace = 1 - 2 * w * h + 1 - (w * h) ** 2
        low, high = (w, high) if abs(trace) < 2 else (low, w)
    return low
"""
MEAN = """
def pose_covariance(J, sigma):
    information = np.einsum("nij,nik->jk", J, J)
    information = information / {by}
    return sigma * np.linalg.inv(information)
"""


def test_a_constant_that_makes_up_for_one_factor_is_no_mistake(tmp_path):
    says = says_of(tmp_path, 5, "5.9", "max_stable_omega", BY_THE_TRACE).message
    assert "times the correct value in every call" in says
    assert "One change" not in says


def test_a_variable_that_makes_up_for_another_factor_is_no_mistake(tmp_path):
    """The mean over n, where the sum divided by sigma would give the right answer."""
    wrong = MEAN.format(by="len(J)")
    says = says_of(tmp_path, 10, "10.7", "pose_covariance", wrong).message
    assert "One change" not in says


# Column by column, from the momentum of the centre of mass.
BY_COLUMNS = """
def spatial_inertia(m, c, inertia):
    G = np.zeros((6, 6))
    for k, V in enumerate(np.eye(6)):
        p = m * (V[3:] + np.cross(V[:3], c))
        G[3:, k] = p
        G[:3, k] = inertia @ V[:3] + np.cross(p, c)
    return G
"""


def test_one_change_is_told_in_place_of_two_mistakes_that_add_up(tmp_path):
    verdict = says_of(tmp_path, 4, "4.1", "spatial_inertia", BY_COLUMNS)
    assert verdict.message.startswith("One change in line ")
    assert "`G[:3, k] = inertia @ V[:3] + np.cross(p, c)`, makes all" in verdict.message
    assert verdict.mistake == "one-line"


# Moment and force of every link, in the right order, with a sign that is wrong.
TURNED = """
def body_jacobian(J_space, T):
    R, p = T[:3, :3], T[:3, 3]
    J = np.empty((6, J_space.shape[1]))
    for i, column in enumerate(J_space.T):
        w, v = np.split(column, 2)
        J[:, i] = np.append(R.T @ w, R.T @ (v + np.cross(p, w)))
    return J
"""


def test_a_line_stands_beside_a_mistake_without_a_place(tmp_path):
    says = says_of(tmp_path, 3, "3.9", "body_jacobian", TURNED).message
    assert "solution whose code for the velocity of the hand's origin reverses" in says
    assert "One change in line " in says


# The offset of the first body, which is right there, is used for the second as well.
STALE = """
def combine_bodies(m1, c1, I1, m2, c2, I2):
    m = m1 + m2
    c = (m1 * c1 + m2 * c2) / m
    d = c1 - c
    I = I1 + m1 * (d @ d * np.eye(3) - np.outer(d, d))
    I = I + I2 + m2 * (d @ d * np.eye(3) - np.outer(d, d))
    return np.array([m, *c, *np.diag(I), I[0, 1], I[0, 2], I[1, 2]])
"""
THIRD_ROW = """
def quat_to_R(quat):
    w, x, y, z = quat / np.linalg.norm(quat)
    row1 = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)]
    row2 = [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)]
    row3 = [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + z * z)]
    return np.array([row1, row2, row3])
"""


def test_a_line_is_quoted_only_if_a_change_in_it_makes_all_right(tmp_path):
    says = says_of(tmp_path, 7, "7.8", "combine_bodies", STALE).message
    assert "The wrong line" not in says
    assert "`c1` where another value belongs." in says
    says = says_of(tmp_path, 1, "1.4", "quat_to_R", THIRD_ROW).message
    assert "The wrong line is line " in says


POLES = """
def pd_gains(omega, zeta):
    tau = 1.0 / omega
    return np.array([1 / tau**2, 2 * zeta * tau])
"""


def test_a_change_in_two_lines_names_neither(tmp_path):
    """Both divisions turned round is right as well, and line 1 alone is not."""
    says = says_of(tmp_path, 5, "5.2", "pd_gains", POLES).message
    assert "`return np.array([1 / tau**2, 2 * zeta * tau])`, makes all" in says
    assert "`tau = 1.0 / omega`" not in says


SUBTRACTED = """
def site_jacobian(J_space, p):
    J = np.array(J_space, float)
    for k in range(J.shape[1]):
        w = J[:3, k]
        J[3, k] -= w[1] * p[2] - w[2] * p[1]
        J[4, k] -= w[2] * p[0] - w[0] * p[2]
        J[5, k] -= w[0] * p[1] - w[1] * p[0]
    return J
"""


def test_a_line_that_only_takes_a_value_is_not_told_for_its_sign(tmp_path):
    """With -w all is right, but the wrong signs are in the lines below."""
    verdict = says_of(tmp_path, 3, "3.2", "site_jacobian", SUBTRACTED)
    assert "w = J" not in verdict.message
    assert "reverses one sign" in verdict.message


TOO_SMALL = """
def pd_equilibrium_step(q_goal, g_at_q, kp):
    return q_goal - np.asarray(g_at_q) / (1.0 + np.asarray(kp))
"""


def test_beside_its_line_nobody_is_asked_for_a_rounded_constant(tmp_path):
    verdict = says_of(tmp_path, 5, "5.4", "pd_equilibrium_step", TOO_SMALL)
    assert "One change in line" in verdict.message
    assert "rounded" not in verdict.message
