"""Mutation operators: what may stand in an expression's place.

The near ones are what a hand mistypes: a sign, a factor, a name, an order. The far ones
are other steps: a clamp, a norm, a root, a unit, a usual constant.
"""

import ast
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import combinations
from typing import Any, NamedTuple

FEW = 7  # entries of a list, of which any two are exchanged
NUMBERED = (ast.List, ast.Tuple)
SHIFTED = {":-1": "1:", "1:": ":-1"}
Mutation = tuple[str, ast.expr]  # what kind of change it is, and the new expression

# Replacements by what stands there. A and B are its operands, X is all of it.
OF_OPERATION = {
    ast.Add: "sign: A - B | B - A; left-out: A | B; operation: A * B",
    ast.Sub: "sign: A + B; order: B - A; left-out: A | -B | B; sign-lost: np.abs(X)",
    ast.Mult: "operation: A / B | B / A | A @ B | A + B | A ** B; left-out: A | B; "
    "negated: -X",
    ast.Div: "operation: A * B; left-out: A; order: B / A",
    ast.MatMult: "operation: A * B; order: B @ A; left-out: A | B; negated: -X",
    ast.Pow: "left-out: A; operation: A * B; factor: 2.0 * X | 0.5 * X",
}
FACTOR = "factor: 2.0 * X | 0.5 * X"
OF_A_NAME = "squared: X ** 2; factor: 2.0 * X | 0.5 * X; left-out: 1; transpose: X.mT"
IN_A_PRODUCT = "transpose: X.mT; inverse: np.linalg.inv(X)"
# What may happen to a value as a whole.
OF_A_VALUE = """
    clamp: np.maximum(X, 0.0) | np.minimum(X, 1.0) | np.clip(X, 0.0, 1.0)
        | np.clip(X, -1.0, 1.0);
    sign-lost: np.abs(X); negated: -X;
    norm: X / np.linalg.norm(X) | np.linalg.norm(X) | np.sum(np.square(X));
    root: np.sqrt(X); squared: X ** 2;
    inverse: 1.0 / X | np.linalg.inv(X); operation: 1.0 - X;
    transpose: X.mT; unit: np.rad2deg(X) | np.deg2rad(X) | 1000.0 * X | X / 1000.0;
    rounded: np.round(X) | np.floor(X) | np.ceil(X) | np.round(X, 1) | np.round(X, 3);
    factor: 2.0 * X | 0.5 * X;
    diagonal: np.diag(np.diag(X)) | np.eye(len(X)) | 0.5 * (X + X.mT);
    left-out: np.zeros_like(X) | np.ones_like(X);
    entries: X[::-1] | np.roll(X, 1, axis=0) | np.roll(X, -1, axis=0)
        | np.roll(X, 3, axis=0);
    entry-some: X[:1] | X[-1:] | X[1:] | X[:-1] | X[0] | X[-1];
    entry-zero: np.append(0.0 * X[:1], X[1:]) | np.append(X[:-1], 0.0 * X[-1:]);
    number: 1.0 | 0.0
"""
WITH_A_NAME = "scaled: X * N | X / N | X @ N | N @ X; added: X + N | X - N | N - X"
OF_TWO = """
    function: np.cross(A, B) | np.outer(A, B) | np.maximum(A, B) | np.minimum(A, B);
    transpose: A @ B.mT | A.mT @ B | B.mT @ A; order: B @ A;
    operation: A * B | A / B | A // B | A % B;
    diagonal: np.diag(A) * B
"""
OF_A_CALL = {
    "solve": "transpose: A.mT @ B | np.linalg.inv(A).mT @ B; operation: B / A; "
    "diagonal: B / np.diag(A); left-out: B",
    "norm": "norm: np.sum(np.square(A)) | np.sum(np.abs(A)) | np.max(np.abs(A)) "
    "| np.sum(A) | np.abs(A) | A",
    "clip": "clamp: np.maximum(A, B) | np.minimum(A, C) | np.clip(A, -C, C) "
    "| np.clip(A, B, 10 * C) | np.where(A > C, 0.0, A)",
    "min": "clamp: A | B", "max": "clamp: A | B",
    "minimum": "clamp: A | B", "maximum": "clamp: A | B",
    "sqrt": "root: A | A ** 2", "range": "index: range(A - 1) | range(1, A) "
    "| range(A + 1) | range(1, A + 1) | range(1) | range(A - 1, -1, -1) "
    "| range(A + 1, B) | range(A - 1, B) | range(A, B - 1) | range(A, B + 1) "
    "| range(B) | range(B - 1, A - 1, -1)",
}  # fmt: skip
OF_A_CONDITION = (
    "condition: abs(A) < B | abs(A) > B | A < 2 * B | A > 2 * B | A < B / 2 | A > B / 2"
)
OF_A_RANGE = "index: list(X)[:-1] | list(X)[1:] | list(X)[::-1] | list(X)[:1]"
_SOMEWHERE = ast.parse("x", mode="eval").body
TWINS = [
    ("sin", "cos"), ("argmin", "argmax"), ("min", "max"), ("minimum", "maximum"),
    ("floor", "round"), ("ceil", "round"), ("trunc", "round"), ("sum", "mean"),
    ("cumsum", "cumprod"), ("sum", "prod"), ("prod", "min"), ("hstack", "vstack"),
    ("inv", "pinv"), ("any", "all"), ("eye", "ones"), ("arctan", "tan"),
    ("mean", "median"), ("zeros", "ones"), ("max", "mean"),
]  # fmt: skip
FAR_TWINS = [
    ("sum", "max"), ("sum", "min"), ("mean", "min"), ("cross", "multiply"),
    ("outer", "dot"), ("cross", "dot"), ("floor", "ceil"), ("ceil", "trunc"),
    ("sqrt", "square"), ("sin", "tan"), ("arcsin", "arccos"), ("arctan2", "arctan"),
    ("log", "log10"), ("norm", "sum"), ("eigvalsh", "diag"), ("zeros", "eye"),
    ("deg2rad", "rad2deg"), ("triu", "tril"), ("dot", "multiply"), ("exp", "expm1"),
]  # fmt: skip


class Place(NamedTuple):
    """Where an expression stands."""

    node: ast.expr
    parent: ast.AST
    field: str
    at: int | None  # in a list of the parent's

    def put(self, new: ast.expr) -> None:
        """Set another expression there."""
        if self.at is None:
            setattr(self.parent, self.field, new)
        else:
            getattr(self.parent, self.field)[self.at] = new


def places(tree: ast.AST) -> Iterator[Place]:
    """Yield where each expression in a tree stands, what is around it first."""
    for parent in ast.walk(tree):
        for field, value in ast.iter_fields(parent):
            several = value if isinstance(value, list) else [value]
            for at, one in enumerate(several):
                if isinstance(one, ast.expr):
                    yield Place(one, parent, field, at if value is several else None)


def near(place: Place, names: Sequence[str]) -> Iterator[Mutation]:
    """Yield what a hand may mistype for an expression.

    Args:
        place: where it stands.
        names: of the function's arguments, and of what it makes.
    """
    node = place.node
    if isinstance(node, ast.BinOp):
        table = OF_OPERATION.get(type(node.op), "")
        yield from filled(table, X=node, A=node.left, B=node.right)
        yield from _of_brackets(node)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield "sign", node.operand
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        yield from _of_number(node, place)
    elif isinstance(node, ast.Name):
        yield from _of_name(node, names, place)
    elif isinstance(node, ast.Attribute) and node.attr in ("T", "mT"):
        yield "transpose", node.value
    elif isinstance(node, ast.Call):
        yield from _of_call(node, names)
    elif isinstance(node, ast.Subscript):
        yield from _of_subscript(node)
    elif isinstance(node, ast.Compare) and len(node.ops) == 1:
        for op in (ast.Lt, ast.LtE, ast.Gt, ast.GtE):
            if not isinstance(node.ops[0], op):
                yield "condition", ast.Compare(node.left, [op()], node.comparators)
    elif isinstance(node, ast.IfExp):
        yield "left-out", node.body
        yield "left-out", node.orelse
    elif isinstance(node, NUMBERED) and len(node.elts) > 1:
        yield from _of_a_list(node)
    yield from _of_a_part(place, names)


def far(place: Place, names: Sequence[str]) -> Iterator[Mutation]:
    """Yield other steps in an expression's place; the arguments are those of `near`."""
    node = place.node
    if place.field in ("func", "keywords", "slice"):
        return
    if _valued(place, names):
        empty = isinstance(node, ast.Call) and called(node) in ("zeros", "eye")
        yield from () if empty else filled(OF_A_VALUE, X=node)
        for name in names:
            yield "name", _name(name)
            yield from filled(WITH_A_NAME, X=node, N=_name(name))
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        n: Any = node.value
        for value in (10 * n, n / 10, n**2, 3 * n):
            yield "number", ast.Constant(value)
        yield from (("number", _name(name)) for name in names)
    elif isinstance(node, ast.Call):
        yield from _far_of_call(node)
    elif isinstance(node, ast.IfExp):
        yield from filled("condition: A if not C else B", A=node.body, B=node.orelse,
                          C=node.test)  # fmt: skip
    elif isinstance(node, ast.BinOp):
        yield from filled(OF_TWO, A=node.left, B=node.right)
    elif isinstance(node, NUMBERED) and isinstance(node.ctx, ast.Load):
        yield from _far_of_a_list(node)
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        yield from filled(OF_A_CONDITION, A=node.left, B=node.comparators[0])
    if isinstance(node, ast.Compare | ast.BoolOp) or place.field == "test":
        yield from filled("condition: True | False | not X", X=node)
    if isinstance(node, ast.BoolOp):
        yield from _of_both(node)
    if place.field == "iter":
        yield from filled(OF_A_RANGE, X=node)
    if place.field == "ifs":
        yield "condition", ast.Constant(True)


def filled(table: str, **nodes: ast.expr) -> Iterator[Mutation]:
    """Yield the replacements of a table with expressions in its letters' places."""
    for kind, template, letters in _read(table):
        if letters <= nodes.keys():
            yield kind, _filled(template, nodes)


@cache
def _read(table: str) -> list[tuple[str, ast.expr, set[str]]]:
    found = []
    for group in filter(str.strip, table.split(";")):
        kind, _, texts = group.partition(":")
        if "lambda" in texts or not texts:
            raise ValueError(f"no replacement: {group!r}")
        for text in texts.split(" | "):
            tree = ast.parse(text.strip(), mode="eval").body
            names = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name)}
            found.append((kind.strip(), tree, {n for n in names if len(n) == 1}))
    return found


def _filled(template: Any, nodes: Mapping[str, ast.expr]) -> Any:
    """Return a copy of a template with some names replaced; these are not copied."""
    if isinstance(template, ast.Name) and template.id in nodes:
        return nodes[template.id]
    if isinstance(template, list):
        return [_filled(one, nodes) for one in template]
    if not isinstance(template, ast.AST):
        return template
    found = type(template)()
    for name in template._fields:
        setattr(found, name, _filled(getattr(template, name, None), nodes))
    return ast.copy_location(found, template) if found._attributes else found


def _name(text: str) -> ast.Name:
    """Return a name that is read, with a place in the text, as templates have one."""
    return ast.copy_location(ast.Name(text, ast.Load()), _SOMEWHERE)


def _valued(place: Place, names: Sequence[str]) -> bool:
    """Return whether an expression is a value, no module and no function."""
    node = place.node
    if isinstance(place.parent, ast.Attribute) or isinstance(node, ast.Constant):
        return False
    if isinstance(node, ast.Name):
        return node.id in names
    some = (ast.Call, ast.BinOp, ast.Subscript, ast.Attribute, ast.UnaryOp, ast.IfExp)
    return isinstance(node, some)


def _of_brackets(node: ast.BinOp) -> Iterator[Mutation]:
    """Yield a b + c for a (b + c), and the other way round."""
    adds, times = (ast.Add, ast.Sub), (ast.Mult, ast.MatMult, ast.Div)
    inside = adds if isinstance(node.op, times) else times
    left, right = node.left, node.right
    if not isinstance(node.op, adds + times):
        return
    if isinstance(right, ast.BinOp) and isinstance(right.op, inside):
        one = ast.BinOp(left, node.op, right.left)
        yield "bracket", ast.BinOp(one, right.op, right.right)
    if isinstance(left, ast.BinOp) and isinstance(left.op, inside):
        one = ast.BinOp(left.right, node.op, right)
        yield "bracket", ast.BinOp(left.left, left.op, one)


def _of_a_part(place: Place, names: Sequence[str]) -> Iterator[Mutation]:
    """Yield what depends on where an expression stands: in a product, or a list."""
    node, parent = place.node, place.parent
    part = isinstance(node, ast.Subscript | ast.Call)
    if part and isinstance(parent, ast.BinOp):
        yield from filled("squared: X ** 2", X=node)
        if isinstance(parent.op, ast.MatMult):
            yield from filled(IN_A_PRODUCT, X=node)
    if part and isinstance(parent, (ast.BinOp, ast.Assign, *NUMBERED)):
        yield from filled(FACTOR, X=node)
        if isinstance(node, ast.Subscript):
            yield "left-out", ast.Constant(1)
    if isinstance(node, ast.BinOp) and isinstance(parent, NUMBERED):
        yield from _names_exchanged(node, names)
    if isinstance(node, ast.BinOp) and ast.dump(node.left) == ast.dump(node.right):
        for one in (_name(name) for name in names):
            yield "name", ast.BinOp(one, node.op, one)
    if isinstance(parent, ast.stmt) and not isinstance(parent, ast.If):
        yield from _of_a_whole(node, names)
    inside = isinstance(parent, (*NUMBERED, ast.Call, ast.Return, ast.keyword))
    if inside and place.field != "func":
        if not isinstance(node, (*NUMBERED, ast.Constant, ast.UnaryOp, ast.Name)):
            yield "negated", ast.UnaryOp(ast.USub(), node)
        if isinstance(node, ast.Name | ast.BinOp):
            yield "left-out", ast.BinOp(ast.Constant(0), ast.Mult(), node)


def _names_exchanged(node: ast.expr, names: Sequence[str]) -> Iterator[Mutation]:
    there = {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}
    for a, b in combinations([name for name in names if name in there], 2):
        pair = {a: _name(b), b: _name(a)}
        yield "exchanged", _filled(node, pair)


def _of_a_whole(node: ast.expr, names: Sequence[str]) -> Iterator[Mutation]:
    """Yield mutations of all that stands in a line."""
    yield from _names_exchanged(node, names)
    some = node.elts if isinstance(node, ast.Tuple) else [node]
    for at, one in enumerate(some):
        for name in names:
            other = _name(name)
            for kind, new in filled("scaled: X * N | X / N", X=one, N=other):
                whole = ast.Tuple([*some[:at], new, *some[at + 1 :]], ast.Load())
                yield kind, new if one is node else whole


def _of_number(node: ast.Constant, place: Place) -> Iterator[Mutation]:
    value: Any = node.value
    kind = "index" if isinstance(place.parent, ast.Slice) else "number"
    whole = type(value) is int
    halved = [] if whole and value % 2 else [type(value)(value / 2)]
    some = [2 * value, *halved, -value, value + 1, value - 1, type(value)(0)]
    for one in dict.fromkeys(some):
        if one != value:
            yield kind, ast.Constant(one)
    if kind == "index":
        yield kind, ast.Constant(None)


def _of_name(node: ast.Name, names: Sequence[str], place: Place) -> Iterator[Mutation]:
    if node.id not in names or place.field == "func":
        return
    yield "negated", ast.UnaryOp(ast.USub(), node)
    for name in names:
        if name != node.id:
            yield "name", _name(name)
    if place.field == "slice":
        yield from filled("index: X + 1 | X - 1", X=node)
    if not isinstance(place.parent, ast.Attribute | ast.Subscript):
        yield from filled(OF_A_NAME, X=node)
        if isinstance(getattr(place.parent, "op", None), ast.MatMult):
            yield from filled("inverse: np.linalg.inv(X)", X=node)


def called(node: ast.Call) -> str:
    """Return the name of the function that is called, "sin" of np.sin."""
    return getattr(node.func, "attr", getattr(node.func, "id", ""))


def _of_call(node: ast.Call, names: Sequence[str]) -> Iterator[Mutation]:
    function, args, name = node.func, node.args, called(node)
    of_numpy = isinstance(function, ast.Attribute) and _is_module(function.value)
    if args:
        yield "left-out", args[0]
    if isinstance(function, ast.Attribute) and not of_numpy:
        yield "left-out", function.value
    elif of_numpy and args and isinstance(args[0], ast.BinOp):
        yield from _closed_early(node, args[0])
    for i, k in combinations(range(min(len(args), FEW)), 2):
        yield "order", ast.Call(function, _swapped(args, i, k), node.keywords)
    yield from _twins(node, TWINS)
    if name in ("mean", "sum", "median") and isinstance(function, ast.Attribute):
        whole = args[0] if of_numpy and args else function.value
        for end in (0, -1):
            yield "function", ast.Subscript(whole, ast.Constant(end), ast.Load())
    if name == "solve" and len(args) == 2:
        yield from filled("operation: A @ B", A=args[0], B=args[1])
    if name == "inv":
        yield from filled("operation: 1.0 / A", A=args[0])
    if name in ("ones", "zeros"):
        yield from (("name", _name(one)) for one in names)
    if args and name not in ("range", "len", "zip", "int", "enumerate"):
        yield from filled(FACTOR, X=node)


def _closed_early(node: ast.Call, inner: ast.BinOp) -> Iterator[Mutation]:
    """Yield f(a) + b for f(a + b): np.mean(x) ** 2 for np.mean(x ** 2)."""
    if isinstance(inner.op, ast.Add | ast.Sub | ast.Pow):
        part = ast.Call(node.func, [inner.left, *node.args[1:]], node.keywords)
        yield "bracket", ast.BinOp(part, inner.op, inner.right)


def _twins(node: ast.Call, twins: Sequence[tuple[str, str]]) -> Iterator[Mutation]:
    name = called(node)
    for pair in twins:
        if name in pair and isinstance(node.func, ast.Attribute):
            twin = pair[1 - pair.index(name)]
            again = ast.Attribute(node.func.value, twin, ast.Load())
            yield "function", ast.Call(again, node.args, node.keywords)


def _far_of_call(node: ast.Call) -> Iterator[Mutation]:
    some = dict(zip("ABC", node.args, strict=False))
    yield from filled(OF_A_CALL.get(called(node), ""), X=node, **some)
    yield from _twins(node, FAR_TWINS)
    if called(node) == "zeros" and node.args and isinstance(node.args[0], ast.Tuple):
        yield from filled("function: np.eye(N)", N=node.args[0].elts[0])
    yield from (("left-out", arg) for arg in node.args[1:])
    for k, one in enumerate(node.keywords):
        rest = node.keywords[:k] + node.keywords[k + 1 :]
        yield "function", ast.Call(node.func, node.args, rest)
        for axis in (0, 1, -1, -2) if one.arg == "axis" else ():
            other = ast.keyword("axis", ast.Constant(axis))
            yield "index", ast.Call(node.func, node.args, [*rest, other])


def _is_module(node: ast.expr) -> bool:
    """Return whether an expression is np, np.linalg or another module."""
    while isinstance(node, ast.Attribute):
        node = node.value
    return isinstance(node, ast.Name) and node.id in ("np", "se3", "screws", "mujoco")


def _of_subscript(node: ast.Subscript) -> Iterator[Mutation]:
    yield "index", node.value
    some = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
    for at, one in enumerate(some):
        if not isinstance(one, ast.Slice) or one.step:
            continue
        if (one.lower is None) == (one.upper is None):
            continue
        turned = ast.Slice(one.upper, one.lower)
        if ast.unparse(one) in SHIFTED:
            text = f"x[{SHIFTED[ast.unparse(one)]}]"
            turned = ast.parse(text, mode="eval").body.slice  # type: ignore[attr-defined]
        each = [*some[:at], turned, *some[at + 1 :]]
        where = ast.Tuple(each, ast.Load()) if len(each) > 1 else turned
        yield "index", ast.Subscript(node.value, where, ast.Load())
    if len(some) == 2:
        where = ast.Tuple(some[::-1], ast.Load())
        yield "index", ast.Subscript(node.value, where, ast.Load())
    elif isinstance(some[0], ast.Constant | ast.Name):  # R[:, 2] for R[2]
        where = ast.Tuple([ast.Slice(), some[0]], ast.Load())
        yield "index", ast.Subscript(node.value, where, ast.Load())


def _of_both(node: ast.BoolOp) -> Iterator[Mutation]:
    other = ast.Or() if isinstance(node.op, ast.And) else ast.And()
    yield "condition", ast.BoolOp(other, node.values)
    for k in range(len(node.values)):
        rest = node.values[:k] + node.values[k + 1 :]
        yield "condition", rest[0] if len(rest) == 1 else ast.BoolOp(node.op, rest)


def _of_a_list(node: Any) -> Iterator[Mutation]:
    for i, k in combinations(range(len(node.elts)), 2):
        if len(node.elts) <= FEW:
            yield "order", type(node)(_swapped(node.elts, i, k), ast.Load())


def _far_of_a_list(node: Any) -> Iterator[Mutation]:
    some = node.elts
    for k, j in combinations(range(len(some) if len(some) <= FEW else 0), 2):
        for at, other in ((k, j), (j, k)):
            new = [*some[:at], some[other], *some[at + 1 :]]
            yield "entry-twice", type(node)(new, ast.Load())
    for k in range(len(some)):
        new = [*some[:k], ast.Constant(0.0), *some[k + 1 :]]
        yield "entry-zero", type(node)(new, ast.Load())
    if len(some) > 2:
        yield "entries", type(node)(some[::-1], ast.Load())
        yield "entries", type(node)(some[1:] + some[:1], ast.Load())
        yield "entries", type(node)(some[-1:] + some[:-1], ast.Load())


def _swapped(some: Sequence[Any], i: int, k: int) -> list[Any]:
    found = list(some)
    found[i], found[k] = found[k], found[i]
    return found
