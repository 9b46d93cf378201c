"""What is said of a function that computes the same in another way than the lab."""

import ast
from types import SimpleNamespace

import numpy as np
import pytest
from test_claims import right, told
from test_own_line import told as told_of_a_file

from labkit.judge import sources
from labkit.judge.ask import Case, asked_of, right_answers, stacked
from labkit.judge.form import is_of_its_form
from labkit.judge.matcher import Matcher
from labkit.judge.mutant import KINDS, Body, body_of
from labkit.judge.row import row_of
from labkit.judge.sentence import SAYS, TELLING
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

pytestmark = pytest.mark.kit

PATH = lab_of(find_day(1)).PATH


def test_a_component_that_a_sum_omits_is_not_said_to_be_in_a_wrong_place():
    def inverse(T):
        back = right(1, "inverse")(T)
        back[:3, 3] = [-sum(T[k, i] * T[k, 3] for k in range(2)) for i in range(3)]
        return back

    says = told(1, "1.3", inverse=inverse)
    assert "omits one entry of a list or vector, as if it were 0" in says
    assert "wrong place" not in says
    assert "wrong order" not in says


def test_the_comment_of_a_right_solution_says_which_step_is_wrong(student):
    body = """
def body_jacobian(J_space, T):
    omega, v = J_space[:3], J_space[3:]
    at_hand = v - np.cross(T[:3, 3], omega, axis=0)
    return np.vstack([T[:3, :3] @ omega, T[:3, :3].T @ at_hand])
"""
    says = told_of_a_file(3, "3.9", "body_jacobian", student, body)
    assert "omega, expressed in the hand frame" in says


GRADIENT = """
def masked_l1(pred, target, mask):
    e = pred - target
    k = mask.sum()
    loss = np.sum(np.abs(e).mean(axis=2) * mask) / k
    return loss, np.sign(e) * mask[..., None] / k
"""


def test_a_term_that_only_another_right_solution_has_is_not_called_missing(student):
    """A mutant of a right solution by einsum gives these numbers, without a division.

    The student's function has as many divisions.
    """
    says = told_of_a_file(16, "16.2", "masked_l1", student, GRADIENT)
    assert says.startswith("The loss is correct. The gradient is wrong in")
    assert "missing" not in says


def changed_line(mutant):
    """Return the line that a mutant changes, as it reads then."""
    with mutant.made():
        line = mutant.statement()
        return ast.unparse(line) if line else ""


FORM = "def f(x, y):\n    s = x * y\n    return s / (x - y)\n"


@pytest.mark.parametrize(
    ("own", "has"),
    [
        ("return x * y", True),  # one operation less, and one subtraction
        ("return x * y / (x - y)", True),  # the same form
        ("s = 0\n    for k in range(3):\n        s += x / y\n    return s", False),
        ("while x < y:\n        x = np.sqrt(x) / y\n    return x", False),
    ],
)
def test_what_is_missing_is_missing_in_the_students_form(own, has):
    right = Body(ast.parse(FORM).body[0], {})
    divided = next(one for one in right.near if changed_line(one) == "return s")
    other = ast.parse(
        "def f(x, y):\n    while x: x = np.sqrt(x)\n    for k in x: k / 1"
    )
    mine = ast.parse(f"def f(x, y):\n    {own}\n").body[0]
    others = [right.function, other.body[0]]
    assert is_of_its_form(mine, divided, others) == has
    assert is_of_its_form(mine, divided, [right.function])  # nothing is more like it


def test_only_a_right_solutions_comments_are_glosses():
    def solution(x):
        y = 2 * x  # twice the argument
        return y + 1

    read = body_of(solution, "f", commented=True)
    assert "twice the argument" in read.glosses.values()
    assert not body_of(solution, "f").glosses


@pytest.mark.parametrize("kind", KINDS)
def test_a_kind_that_needs_a_place_is_not_told_without_one(kind, monkeypatch):
    one = next(
        Body(ast.parse("def f(x):\n    return -x\n").body[0], {}).near.__iter__()
    )
    vars(one)["kind"] = kind
    monkeypatch.setattr(sources, "_that_hold", lambda m, which: [one])
    monkeypatch.setattr(sources, "shows", lambda m, mutant: False)
    monkeypatch.setattr(sources, "of_mutants", lambda m, found: found[0].kind)
    assert SAYS.get(kind) or kind == "line"
    # "A part of the formula is missing" says too little without a noun.
    says = kind in TELLING and kind != "left-out"
    nothing_known = SimpleNamespace(case=SimpleNamespace(source=""), known={})
    assert sources.other_mutants(nothing_known) == (kind if says else None)


def test_a_function_that_only_counts_the_pairs_of_a_path_is_named():
    def compose_fk(model, q, path=PATH):
        given = PATH[: len(path)]
        return right(1, "compose_fk")(model, q, given)

    assert "only the number of pairs" in told(1, "1.6", compose_fk=compose_fk)


def test_one_mistake_in_another_form_is_not_told_as_two():
    def exp_rotation(axis, theta):
        K = np.array([np.cross(e, axis) for e in -np.eye(3)]).T
        return np.cos(theta) * np.eye(3) + np.sin(theta) * K

    def exp_screw(S, theta):
        X = np.zeros((4, 4))
        X[:3, :3] = right(2, "skew")(S[:3])
        X[:3, 3] = S[3:]
        if not S[:3].any():
            return np.eye(4) + theta * X
        c, s = np.cos(theta), np.sin(theta)
        return np.eye(4) + theta * X + c * X @ X + (theta - s) * X @ X @ X

    for task, function in (("2.2", exp_rotation), ("2.4", exp_screw)):
        says = told(2, task, **{function.__name__: function})
        assert "wo mistakes" not in says
        assert "gives the same " in says


def test_the_search_takes_cheap_solutions_first():
    day = find_day(4)
    row = row_of(day, "mass_matrix")
    exchanges = asked_of("4.3", "mass_matrix", row.ask, 1, 5.0).main
    arguments = stacked(exchanges)
    T = right_answers(row.ask, exchanges)
    S = (T[0] + 1.0,)
    m = Matcher(Case(row.ask, arguments, S[0], T[0], ()), S, T)
    costs = [body.steps.lines for body in m.bodies]
    assert m.bodies[0].own
    assert len(costs) > 3
    assert costs[1:] == sorted(costs[1:])
    assert costs[-1] > 20 * costs[1]


def test_a_manipulability_of_six_rows_alone_is_named():
    def manipulability(J):
        product = 1.0
        for k in range(6):
            product *= np.linalg.svd(J, compute_uv=False)[k]
        return product

    assert "J.shape" in told(3, "3.8", manipulability=manipulability)


def test_how_an_answer_grows_is_said_of_the_size_that_was_asked():
    def manipulability(J):
        s = np.linalg.svd(J, compute_uv=False)
        return float(np.prod(s) ** (1 / len(s)))

    assert "If `J` (6x7) is doubled" in told(3, "3.8", manipulability=manipulability)


def test_a_factor_in_another_form_may_stand_for_any_term():
    """Of w^2 - x^2 ... on the diagonal w^2 is missing, and no factor of two."""

    def quat_to_R(quat):
        w, x, y, z = quat / np.linalg.norm(quat)
        R = np.empty((3, 3))
        R[0] = [x * x - y * y - z * z, 2 * x * y - 2 * w * z, 2 * x * z + 2 * w * y]
        R[1] = [2 * x * y + 2 * w * z, y * y - x * x - z * z, 2 * y * z - 2 * w * x]
        R[2] = [2 * x * z - 2 * w * y, 2 * y * z + 2 * w * x, z * z - x * x - y * y]
        return R

    says = told(1, "1.4", quat_to_R=quat_to_R)
    assert "factor of two" not in says
    assert "not orthonormal" in says


# By the quaternion, whose scalar part may be negative.
OVER_PI = """
def log_rotation(R):
    k = int(np.argmax(np.append(np.trace(R), np.diag(R))))
    if k == 0:
        w = np.sqrt(1 + np.trace(R)) / 2
        v = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
        v = v / (4 * w)
    else:
        i, j, m = k - 1, k % 3, (k + 1) % 3
        v = np.zeros(3)
        v[i] = np.sqrt(1 + R[i, i] - R[j, j] - R[m, m]) / 2
        v[j] = (R[j, i] + R[i, j]) / (4 * v[i])
        v[m] = (R[m, i] + R[i, m]) / (4 * v[i])
        w = (R[m, j] - R[j, m]) / (4 * v[i])
    size = np.linalg.norm(v)
    return 2 * np.arctan2(size, w) * v / size if size else np.zeros(3)
"""


def test_a_sign_without_a_place_adds_nothing_to_what_the_row_says(student):
    says = told_of_a_file(3, "3.3", "log_rotation", student, OVER_PI)
    assert "Your angle is more than pi for " in says
    assert "reverses one sign" not in says


TWICE = """
def Rz(theta):
    c, s = np.cos(2 * theta), np.sin(2 * theta)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
"""
OF_A_QUATERNION = """
def Rz(theta):
    w, z = np.cos(theta), np.sin(theta)
    R = np.eye(3)
    R[0, 0] = R[1, 1] = w * w - z * z
    R[1, 0] = 2 * w * z
    R[0, 1] = -R[1, 0]
    return R
"""
ROWS_FOR_COLUMNS = """
def make_T(R, t):
    T = np.eye(4)
    for i, column in enumerate(zip(*R)):
        T[i, :3] = column
    T[:3, 3] = t
    return T
"""


@pytest.mark.parametrize(
    ("task", "name", "body", "says"),
    [
        ("1.2", "Rz", TWICE, "Your code rotates by twice"),
        (
            "1.2",
            "Rz",
            OF_A_QUATERNION,
            "One mistake would explain your result: your code rotates by twice",
        ),
        ("1.1", "make_T", ROWS_FOR_COLUMNS, "Your translation is correct, but your"),
    ],
)
def test_what_code_in_another_form_does_is_a_supposition(
    student, task, name, body, says
):
    """Of the result it is none, however that was computed."""
    assert told_of_a_file(1, task, name, student, body).startswith(says)


BOTH_POLES_AT_ONE_PLACE = """
def pd_gains(omega, zeta):
    pole = zeta * omega
    return np.array([pole * pole, pole + pole])
"""


def test_that_a_mistake_is_in_the_only_step_is_no_place(student):
    says = told_of_a_file(5, "5.2", "pd_gains", student, BOTH_POLES_AT_ONE_PLACE)
    assert "contains a mistake" not in says
    assert "entry for kp" in says


AS_A_POLYNOMIAL = """
def pd_gains(omega, zeta):
    p = np.roots([1.0, 2.0 * zeta * omega, omega**2])
    return np.real(np.poly(p))[1:]
"""


def test_a_result_in_reverse_order_is_told_and_no_line_that_would_mend_it(student):
    says = told_of_a_file(5, "5.2", "pd_gains", student, AS_A_POLYNOMIAL)
    assert says.startswith("Your code returns the correct result in reverse order.")
    assert "np.roots" not in says
