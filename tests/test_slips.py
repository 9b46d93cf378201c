"""A slip that nobody named: the lab's own body with one place of it changed."""

import ast
import contextlib
import inspect
import linecache
import textwrap
from dataclasses import replace
from types import FunctionType, SimpleNamespace

import numpy as np
import pytest
from test_claims import right, told

from labkit.base.exchange import Reply
from labkit.judge import effort, limits
from labkit.judge.ask import asked_of
from labkit.judge.judge import judge
from labkit.judge.mistake import AS_A_SOLUTION
from labkit.judge.mutant import Body
from labkit.judge.row import row_of
from labkit.judge.sentence import has_its_kind, of_a_step, what
from labkit.judge.sentence import told as says_of
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit

TEXT = "def f(x, y):\n    z = 2.0 * x + y\n    return z - x @ y.T\n"


def body(text=TEXT):
    return Body(ast.parse(text).body[0], {"np": np})


def of(kind, text=TEXT):
    return {one.text for one in body(text).near if one.kind == kind}


def test_signs_factors_names_and_lines_are_changed_one_at_a_time():
    assert "z = 2.0 * x - y" in of("sign")
    assert "z - x @ y" in of("transpose")
    assert "3.0 * x + y" in of("number")
    assert "z - z @ y.T" in of("name")
    assert "without z = 2.0 * x + y" in of("line")


def test_a_function_is_put_back_as_it_was():
    one = body()
    before = ast.dump(one.function, include_attributes=True)
    mutants = [*one.near, *(mutant for mutant, _ in one.further())]
    assert all(mutant.code for mutant in one.near)
    assert all(other.code for other, _ in one.besides(mutants[0]))
    assert all(isinstance(mutant.text, str) for mutant in mutants)
    assert ast.dump(one.function, include_attributes=True) == before


def test_a_mutant_computes_what_it_reads():
    code = {one.text: one.code for one in body().near}
    x, y = np.array([1.0, 2.0]), np.array([3.0, 5.0])
    assert np.array_equal(code["z = 2.0 * x - y"](x, y), 2 * x - y - x @ y)


def test_mutants_that_are_compiled_together_compute_what_each_does_alone():
    one = body()
    x, y = np.array([1.0, 2.0]), np.array([3.0, 5.0])
    some = [*one.ready(one.near), *one.further()]
    assert len(some) > 500
    for mutant, code in some:
        answers = []
        for tried in (code, mutant.code):
            try:
                answers.append(tried(x.copy(), y.copy()))
            except Exception as error:
                answers.append(type(error))
        assert np.array_equal(*map(repr, answers)), mutant.text


def test_a_second_mutant_is_never_in_the_place_of_the_first():
    one = body()
    first = one.near[0]
    others = one.besides(first)
    assert others
    assert not any(first.overlaps(other) for other, _ in others)


def test_one_change_is_made_at_every_place_of_its_kind():
    text = "def f(x, y):\n    z = x.T @ y\n    return x.T @ z\n"
    every = [one for one, _ in body(text).further() if len(one.edits) > 1]
    A, b = np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([1.0, -1.0])
    assert any(np.array_equal(one.code(A, b), A @ A @ b) for one in every)


@pytest.mark.parametrize(
    "loop", ["while x < 3:\n        x = x + 1", "for _ in range(3):\n        x = x + 1"]
)
def test_a_loop_that_would_never_end_stops(loop):
    one = body(f"def f(x):\n    {loop}\n    return x\n")
    one.calibrate([0])
    ended, mutants = 0, [*one.ready(one.near), *one.further()]
    for _, code in mutants:
        with contextlib.suppress(Exception):
            code(0)
            ended += 1
    assert 0 < ended < len(mutants)


def test_a_search_ends_after_a_count_of_lines_that_no_clock_changes(monkeypatch):
    one = body("def f(x):\n    for _ in range(4):\n        x = x + 1\n    return x\n")
    one.calibrate([0])
    one.compiled()(0)
    once, step = one.steps.work
    assert one.steps.taken == one.steps.lines == once + 4 * step > one.steps.usual == 4
    next(b for a, b in one.further() if a.text == "for _ in list(range(4))[::2]:")(0)
    assert one.steps.taken == once + 2 * step
    monkeypatch.setattr(effort.time, "process_time", lambda: 0.0)
    some = effort.Effort()
    while not some.spent():
        some.spend(one.steps.taken)
    assert -effort.ONCE - one.steps.taken < some.left <= 0


def costs(*texts, **space):
    """Return what calls of functions of one module cost, by their names."""
    linecache.cache["<costs>"] = (0, None, "\n".join(texts).splitlines(True), "<costs>")
    exec(compile("\n".join(texts), "<costs>", "exec"), space)
    made = [name for name in space if isinstance(space[name], FunctionType)]
    trees = {
        name: ast.parse(f"def f(x):\n    return {name}(x)").body[0] for name in made
    }
    return {name: effort.work(tree, space).lines(1) for name, tree in trees.items()}


def test_the_lines_of_the_functions_that_are_called_are_counted():
    lines = "".join(f"    x = x + {k}\n" for k in range(60))
    cost = costs(
        f"def long(x):\n{lines}    return x\n",
        "def short(x):\n    return x\n",
        "def both(x):\n    return long(x) + short(x)\n",
        "def again(x):\n    return again(x - 1) if x else 0\n",
    )
    assert cost["short"] < 2 * effort.NUMPY
    assert cost["long"] > 60 * effort.OPERATOR
    assert cost["both"] > cost["long"] + cost["short"] - 4
    assert cost["again"] < 6 * effort.NUMPY


def test_what_a_line_does_says_what_it_costs():
    cost = costs(
        "def plain(x):\n    return x\n",
        "def adds(x):\n    return x + x\n",
        "def sums(x):\n    return np.sum(x)\n",
        "def inverts(x):\n    return np.linalg.inv(x)\n",
        "def turns(x):\n    return np.cross(x, x)\n",
        "def asks(x, f):\n    return f(x)\n",
        "def loops(x):\n    for _ in x:\n        x = np.cross(x, x)\n    return x\n",
        "def seeks(x):\n    while x:\n        x = np.cross(x, x)\n    return x\n",
        "def within(x):\n    def f(x):\n        return np.cross(x, x)\n"
        "    return f(x)\n",
        np=np,
    )
    order = ["plain", "adds", "sums", "inverts", "asks", "turns", "loops", "seeks"]
    assert sorted(order, key=cost.__getitem__) == order
    assert cost["loops"] > effort.TURNS * effort.SLOW
    assert cost["seeks"] > effort.SEARCH * effort.SLOW
    assert cost["within"] > effort.SLOW


def test_an_outer_product_in_a_loop_does_not_fill_the_memory():
    text = "for _ in range(9):\n        x = np.outer(x, x)"
    one = body(f"def f(x):\n    {text}\n    return x\n")
    with pytest.raises(limits.TooLongError):
        one.compiled()(np.ones(10))


@pytest.mark.parametrize(
    "made",
    [
        "np.zeros(10 * n)",
        "np.ones((n, 10))",
        "np.empty(shape=10 * n)",
        "np.full((10, n), 1.0)",
        "np.arange(10 * n)",
        "np.arange(0, n, 0.1)",
        "np.linspace(0.0, 1.0, 10 * n)",
        "np.linspace(0.0, 1.0, num=10 * n)",
        "np.tile(np.ones(10), n)",
        "np.tile(np.ones(2), (5, n))",
        "np.repeat(np.ones(10), n)",
        "np.eye(10, n)",
        "np.eye(n // 10)",
        "np.diag(np.ones(n // 10))",
        "np.bincount([10 * n])",
        "np.outer(np.ones(n // 10), np.ones(100))",
    ],
)
def test_a_mutant_makes_no_array_whose_size_is_a_changed_number(made):
    one = body(f"def f(n):\n    return {made}\n")
    one.calibrate([100])
    code = one.compiled()
    assert np.size(code(900)) >= 100  # the right function may make as many again
    with pytest.raises(limits.TooLongError):
        code(2_000_000)


def test_what_a_right_function_makes_allows_its_mutants_some_times_as_much():
    one = body("def f(n):\n    return np.zeros(n)\n")
    one.calibrate([50_000])
    assert one.compiled()(20 * 50_000).size == 1_000_000
    one.calibrate([10])
    assert one.compiled()(10_000).size == 10_000
    with pytest.raises(limits.TooLongError):
        one.compiled()(10_001)
    one.calibrate([50_000])  # it is remembered
    assert one.compiled()(10_001).size == 10_001


def test_an_array_that_doubles_in_a_loop_does_not_fill_the_memory():
    text = "for _ in range(30):\n        x = np.array([x, x])"
    one = body(f"def f(x):\n    {text}\n    return x\n")
    with pytest.raises(limits.TooLongError):
        one.compiled()(np.ones(2))


def test_lapack_is_not_asked_of_what_is_not_finite():
    one = body("def f(A, b):\n    return np.linalg.lstsq(A, b)[0]\n")
    with pytest.raises(np.linalg.LinAlgError):
        one.compiled()(np.full((2, 2), np.inf), np.ones(2))


def test_a_slip_is_told_by_its_kind_and_its_step():
    move, skew = right(2, "exp_screw"), right(2, "skew")

    def exp_screw(S, theta):
        T = move(S, theta)
        K = skew(S[:3])
        T[:3, 3] += 2 * np.sin(theta) * K @ K @ S[3:]
        return T

    says = told(2, "2.4", exp_screw=exp_screw)
    assert says.startswith(f"{AS_A_SOLUTION} whose code for the integrated rotation ")
    assert "reverses one sign." in says
    assert "`" not in says  # `(theta + s) * K @ K` is not in the file


def test_an_answer_that_is_infinite_is_not_told_how_far_it_is_off():
    bounds = right(12, "path_accel_bounds")

    def path_accel_bounds(a, b, c, limits, sd):
        return bounds(np.abs(a), b, c, limits, sd)

    says = told(12, "12.8", path_accel_bounds=path_accel_bounds)
    assert "every entry of `a` were replaced with its absolute value. The" in says


def test_one_slip_that_explains_all_is_told_before_two():
    bias = right(6, "bias_acceleration")

    def bias_acceleration(J_space, qd, p):
        a = bias(J_space, qd, p)
        V = J_space @ qd
        flat = bias(J_space, qd, 0 * p)
        at_0 = flat[3:] - np.cross(V[:3], V[3:])
        return np.append(a[:3], 2 * at_0 - a[3:])

    says = told(6, "6.2", bias_acceleration=bias_acceleration)
    assert says.startswith(f"{AS_A_SOLUTION} whose code for the acceleration of the ")
    assert "site reverses one sign." in says


def test_a_slip_that_the_fresh_questions_do_not_show_is_not_told():
    turn = right(1, "quat_to_R")

    def quat_to_R(quat):
        R = turn(quat)
        R[0, 2] += 1e-3 * (abs(quat[0]) > 0.9)
        return R

    assert "gives the same output" not in told(1, "1.4", quat_to_R=quat_to_R)


def test_a_whenever_holds_for_arguments_of_other_sizes_as_well():
    solve = right(10, "hand_eye")

    def hand_eye(A, B):
        X = solve(A, B)
        X[:3, 3] = solve(A[:2], B[:2])[:3, 3]
        return X

    assert "whenever" not in told(10, "10.8", hand_eye=hand_eye)


def test_what_a_condition_is_made_of_is_no_factor_and_no_sign():
    text = "def f(x, y):\n    return x if 2.0 * y > x else y\n"
    near = body(text).near
    assert "x if 1.0 * y > x else y" in {o.text for o in near if o.kind == "condition"}
    assert not [one for one in near if one.kind == "number"]
    assert all("2.0 * y > x" in one.text for one in near if one.kind == "factor")


@pytest.mark.parametrize(
    ("line", "may"),
    [
        ("return x if y > 2.0 else y", True),
        ("return np.maximum(x, y)", True),
        ("return x + np.sqrt(y)", False),
    ],
)
def test_a_condition_is_wrong_only_in_a_function_that_compares_something(line, may):
    text = "def f(x, y):\n    return x if 2.0 * y > x else y\n"
    bisects = Body(ast.parse(text).body[0], {"np": np}, name="f")
    some = [one for one in bisects.near if one.kind == "condition"]
    assert some
    m = SimpleNamespace(case=SimpleNamespace(source=f"def f(x, y):\n    {line}\n"))
    assert all(has_its_kind(m, one) is may for one in some)


def judged(number, task, function):
    """Return the verdict on a file that has this function alone, as it stands here."""
    text = textwrap.dedent(inspect.getsource(function))
    return judged_text(number, task, text, function)


def judged_text(number, task, text, function=None):
    """Return the same of a text; the function is what it defines, if None."""
    if function is None:
        exec(text, space := {"np": np})
        function = space[ast.parse(text).body[0].name]
    name = function.__name__
    asked = asked_of(task, name, row_of(find_day(number), name).ask, 47)
    for one in asked.exchanges:
        value = function(*one.question.args)
        one.reply = Reply(value=value, again=value)
    return judge(asked, text, tuple(inspect.signature(function).parameters))


def test_a_gain_of_another_root_formula_is_not_called_a_wrong_condition(monkeypatch):
    row = row_of(find_day(9), "delay_margin")
    monkeypatch.setitem(vars(row), "ask", replace(row.ask, mistakes=()))

    def delay_margin(kp, kd):
        w = np.sqrt(kd**2 + np.sqrt(kd**4 + kp**2))
        return np.arctan2(kd * w, kp) / w

    verdict = judged(9, "9.2", delay_margin)
    assert verdict.status == "wrong"
    assert "condition" not in verdict.message


def test_a_change_that_no_line_of_the_file_has_is_told_of_the_correct_formula():
    skew, spatial_inertia = right(2, "skew"), right(4, "spatial_inertia")

    def link_inertias(T_links, masses, coms, inertias):
        found = []
        for T, *numbers in zip(T_links, masses, coms, inertias, strict=True):
            R, p = T[:3, :3], T[:3, 3]
            X = np.zeros((6, 6))
            X[:3, :3] = X[3:, 3:] = R.T
            X[3:, :3] = -skew(p) @ R.T  # right is R.T @ skew(p)
            found.append(X.T @ spatial_inertia(*numbers) @ X)
        return np.array(found)

    says = judged(4, "4.2", link_inertias).message
    assert says.startswith(
        "Your code gives the same result as a solution whose code for the centre of "
        "mass in the world frame contains a mistake."
    )
    assert "gives the same output" not in says  # the first sentence says it


def test_a_product_in_the_wrong_order_may_lack_a_transpose():
    text = "def f(A, b):\n    hidden = A @ b\n    return hidden\n"
    (one,) = [o for o in body(text).near if o.kind == "order"]
    case = SimpleNamespace(source="def f(A, b):\n    return [0]\n", names=("A", "x"))
    says = says_of(SimpleNamespace(case=case, known={}), one)
    does = "puts two operands in the wrong order, or omits a transpose"
    assert says == f"your code {does}"


@pytest.mark.parametrize(
    ("new", "size", "says"),
    [
        (
            "2.0 * x",
            "twice",
            "has a factor of two too many, or omits a division by two",
        ),
        ("0.5 * x", "half of", "omits a factor of two, or divides by two"),
    ],
)
def test_a_factor_of_two_says_which_way_it_goes(new, size, says):
    function = ast.parse("def f(x):\n    return x / x").body[0]
    division = function.body[0].value

    def mutant(node):
        edits = [(SimpleNamespace(node=node), ast.parse(new, mode="eval").body)]
        body = SimpleNamespace(function=function)
        return SimpleNamespace(kind="factor", edits=edits, body=body)

    above, below = mutant(division.left), mutant(division.right)
    assert what(above, given={"x": "theta"}) == f"uses {size} `theta`"
    assert what(above) == says
    assert what(below) == "omits a factor of two, or has one too many"


MLP_GRADIENT = """
def mlp_gradient(x, target, W1, b1, W2, b2, W3, b3):
    first = np.tanh(x @ W1 + b1)
    second = np.tanh(first @ W2 + b2)
    d3 = HERE
    d2 = (d3 @ W3.T) * (1 - second**2)
    d1 = (d2 @ W2.T) * (1 - first**2)
    grads = x.T @ d1, d1.sum(axis=0), first.T @ d2, d2.sum(axis=0)
    return (*grads, second.T @ d3, d3.sum(axis=0))
"""
MSE = """
def mse(pred, target):
    return 0.0, 2 * (pred - target) / target.size
"""


@pytest.mark.parametrize(
    ("line", "says"),
    [
        (
            "2 * (target - (second @ W3 + b3)) / target.size",
            "whose code for the gradient with respect to the output reverses one sign.",
        ),
        ("mse(target, second @ W3 + b3)[1]", "puts two arguments in the wrong order"),
        ("(second @ W3 + b3 - target) / target.size", "omits a factor of two, or"),
    ],
)
def test_arguments_are_in_the_wrong_order_only_where_a_function_is_called(line, says):
    text = MLP_GRADIENT.replace("HERE", line)
    exec(MSE + text, space := {"np": np})
    verdict = judged_text(15, "15.6", text, space["mlp_gradient"])
    assert says in verdict.message


POLICY_COST = """
def policy_cost(K, std, A, B, Q, R, S, T):
    M = A - B @ K
    X, J = S, 0.0
    for _ in range(T):
        J += np.trace((Q + K.T @ R @ K) @ X) + std**2 * np.trace(R)
        X = M @ X @ M.T + std**2 * B @ B.T
    return J + np.trace(Q @ X)
"""


def test_an_expression_of_another_right_solution_is_not_quoted(monkeypatch):
    row = row_of(find_day(20), "policy_cost")
    named = [one for one in row.ask.named if one.slug != "last-state-added"]
    monkeypatch.setitem(vars(row), "ask", replace(row.ask, mistakes=named))
    assert "`" not in judged_text(20, "20.7", POLICY_COST).message


def test_the_students_expression_is_quoted_as_it_reads_in_the_file():
    own = """
def f(first, second):
    if first > 0: return second
    return max(3, np.sin(second * 2 - first) * second)
"""
    m = SimpleNamespace(case=SimpleNamespace(source=own, names=()), known={})
    text = "def f(x, y):\n    w = np.sin(2.0 * y + x)\n    return w * y\n"
    right = Body(ast.parse(text).body[0], {"np": np}, name="f")
    says = {one: says_of(m, one) for one in right.near if one.kind != "left-out"}
    quoted = {text for text in says.values() if "`" in text}
    assert quoted == {"in `np.sin(second * 2 - first)`, your code reverses one sign"}


@pytest.mark.parametrize(
    ("gloss", "step"),
    [
        ("overdamped response", "the overdamped response"),
        ("the two gains", "the two gains"),
        ("omega, and -omega x point", "omega, and -omega x point"),
        ("Jacobian of link i", "the Jacobian of link i"),
        ("x of the hand", "x of the hand"),
        ("lower triangle: the joints distal to j", "the lower triangle"),
        ("without qdd", 'the step "without qdd"'),
        (
            "0 where another episode follows",
            'the step "0 where another episode follows"',
        ),
    ],
)
def test_a_comment_of_the_solution_reads_as_a_noun(gloss, step):
    assert of_a_step(gloss) == step
