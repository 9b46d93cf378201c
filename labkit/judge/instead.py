"""What a hand may write in an expression's place: each is one slip."""

import ast
import copy
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import combinations
from typing import Any, NamedTuple

FEW = 7  # entries of a list, of which any two are exchanged
NUMBERED = (ast.List, ast.Tuple)
SHIFTED = {":-1": "1:", "1:": ":-1"}
TWINS = [
    ("sin", "cos"), ("argmin", "argmax"), ("min", "max"), ("minimum", "maximum"),
    ("floor", "round"), ("ceil", "round"), ("trunc", "round"), ("sum", "mean"),
    ("cumsum", "cumprod"), ("sum", "prod"), ("prod", "min"), ("hstack", "vstack"),
    ("inv", "pinv"), ("any", "all"), ("eye", "ones"), ("arctan", "tan"),
    ("mean", "median"), ("zeros", "ones"), ("max", "mean"),
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

    @contextmanager
    def holding(self, new: ast.expr) -> Iterator[None]:
        """Have another expression there for a while."""
        self.put(new)
        try:
            yield
        finally:
            self.put(self.node)


def places(tree: ast.AST) -> Iterator[Place]:
    """Yield where each expression in a tree stands, what is around it first."""
    for parent in ast.walk(tree):
        for field, value in ast.iter_fields(parent):
            several = value if isinstance(value, list) else [value]
            for at, one in enumerate(several):
                if isinstance(one, ast.expr):
                    yield Place(one, parent, field, at if value is several else None)


def instead(place: Place, names: Sequence[str]) -> Iterator[tuple[str, ast.expr]]:
    """Yield what may stand in an expression's place, and what kind of slip it is."""
    node = place.node
    if isinstance(node, ast.BinOp):
        yield from _of_operation(node)
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
        yield from _of_comparison(node)
    elif isinstance(node, ast.IfExp):
        yield "left-out", node.body
        yield "left-out", node.orelse
    elif isinstance(node, NUMBERED) and len(node.elts) > 1:
        yield from _of_a_list(node)
    if isinstance(node, ast.Subscript | ast.Call):
        yield from _of_a_part(node, place)
    if isinstance(node, ast.BinOp):
        yield from _of_brackets(node)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Sub):
        size = ast.Attribute(ast.Name("np", ast.Load()), "abs", ast.Load())
        yield "sign-lost", ast.Call(size, [node], [])
    if isinstance(node, ast.BinOp) and isinstance(place.parent, NUMBERED):
        yield from _names_exchanged(node, names)
    if isinstance(node, ast.BinOp) and _is_a_square(node):
        for name in names:
            one = ast.Name(name, ast.Load())
            yield "name", ast.BinOp(one, node.op, one)
    if isinstance(place.parent, ast.stmt) and not isinstance(place.parent, ast.If):
        yield from _of_a_whole(node, names)
    inside = isinstance(place.parent, (*NUMBERED, ast.Call, ast.Return, ast.keyword))
    plain = isinstance(node, (*NUMBERED, ast.Constant, ast.UnaryOp, ast.Name))
    if inside and place.field != "func" and not plain:
        yield "negated", ast.UnaryOp(ast.USub(), node)
    if inside and isinstance(node, ast.Name | ast.BinOp) and place.field != "func":
        yield "left-out", ast.BinOp(ast.Constant(0), ast.Mult(), node)


def _of_brackets(node: ast.BinOp) -> Iterator[tuple[str, ast.expr]]:
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


def _is_a_square(node: ast.BinOp) -> bool:
    named = isinstance(node.left, ast.Name)
    return named and ast.unparse(node.left) == ast.unparse(node.right)


def _names_exchanged(
    node: ast.expr, names: Sequence[str]
) -> Iterator[tuple[str, ast.expr]]:
    there = {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}
    for pair in combinations([name for name in names if name in there], 2):
        yield "exchanged", _Exchanged(*pair).visit(copy.deepcopy(node))


def _of_a_whole(node: ast.expr, names: Sequence[str]) -> Iterator[tuple[str, ast.expr]]:
    """Yield slips of all that stands in a line."""
    yield from _names_exchanged(node, names)
    for at, one in enumerate(_results(node)):
        for name in names:
            for op in (ast.Mult(), ast.Div()):
                new: ast.expr = ast.BinOp(one, op, ast.Name(name, ast.Load()))
                if one is not node:
                    some = _results(node)
                    new = ast.Tuple([*some[:at], new, *some[at + 1 :]], ast.Load())
                yield "scaled", new


def _results(node: ast.expr) -> list[ast.expr]:
    return node.elts if isinstance(node, ast.Tuple) else [node]


class _Exchanged(ast.NodeTransformer):
    """Two names in each other's places."""

    def __init__(self, one: str, other: str) -> None:
        """Begin with two names."""
        self.other = {one: other, other: one}

    def visit_Name(self, node: ast.Name) -> ast.Name:
        """Return the other name of the two."""
        node.id = self.other.get(node.id, node.id)
        return node


def _of_a_part(node: ast.expr, place: Place) -> Iterator[tuple[str, ast.expr]]:
    """Yield slips of an entry, or of a function's answer, within a product."""
    if isinstance(place.parent, ast.BinOp):
        yield "squared", ast.BinOp(node, ast.Pow(), ast.Constant(2))
        if isinstance(place.parent.op, ast.MatMult):
            yield "transpose", ast.Attribute(node, "mT", ast.Load())
            yield "inverse", _inverse(node)
    if isinstance(place.parent, (ast.BinOp, ast.Assign, *NUMBERED)):
        yield from _of_a_factor(node)
        if isinstance(node, ast.Subscript):
            yield "left-out", ast.Constant(1)


def _of_operation(node: ast.BinOp) -> Iterator[tuple[str, ast.expr]]:
    left, right = node.left, node.right

    def other(op: ast.operator, a: ast.expr = left, b: ast.expr = right) -> ast.expr:
        return ast.BinOp(a, op, b)

    def minus(x: ast.expr) -> ast.expr:
        return ast.UnaryOp(ast.USub(), x)

    if isinstance(node.op, ast.Add):
        yield "sign", other(ast.Sub())
        yield "sign", other(ast.Sub(), right, left)
        yield "left-out", left
        yield "left-out", right
        yield "operation", other(ast.Mult())
    elif isinstance(node.op, ast.Sub):
        yield "sign", other(ast.Add())
        yield "order", other(ast.Sub(), right, left)
        yield "left-out", left
        yield "left-out", minus(right)
        yield "left-out", right
    elif isinstance(node.op, ast.Mult):
        yield "operation", other(ast.Div())
        yield "left-out", left
        yield "left-out", right
        yield "negated", minus(node)
        for op in (ast.MatMult(), ast.Add(), ast.Pow()):
            yield "operation", other(op)
    elif isinstance(node.op, ast.Div):
        yield "operation", other(ast.Mult())
        yield "left-out", left
        yield "order", other(ast.Div(), right, left)
    elif isinstance(node.op, ast.MatMult):
        yield "operation", other(ast.Mult())
        yield "order", other(ast.MatMult(), right, left)
        yield "left-out", left
        yield "left-out", right
        yield "negated", minus(node)
    elif isinstance(node.op, ast.Pow):
        yield "left-out", left
        yield "operation", other(ast.Mult())
        yield from _of_a_factor(node)


def _of_a_factor(node: ast.expr) -> Iterator[tuple[str, ast.expr]]:
    for factor in (2.0, 0.5):
        yield "factor", ast.BinOp(ast.Constant(factor), ast.Mult(), node)


def _of_number(node: ast.Constant, place: Place) -> Iterator[tuple[str, ast.expr]]:
    value: Any = node.value
    kind = "index" if isinstance(place.parent, ast.Slice) else "number"
    whole = type(value) is int
    halved = [] if whole and value % 2 else [type(value)(value / 2)]
    some = [2 * value, *halved, -value, value + 1, value - 1, type(value)(0)]
    for one in dict.fromkeys(some):
        if one != value:
            yield kind, ast.Constant(one)
    if kind == "index" and isinstance(place.parent, ast.Slice):
        yield kind, ast.Constant(None)


def _of_name(
    node: ast.Name, names: Sequence[str], place: Place
) -> Iterator[tuple[str, ast.expr]]:
    if node.id not in names or place.field == "func":
        return
    yield "negated", ast.UnaryOp(ast.USub(), node)
    for name in names:
        if name != node.id:
            yield "name", ast.Name(name, ast.Load())
    if not isinstance(place.parent, ast.Attribute | ast.Subscript):
        yield "squared", ast.BinOp(node, ast.Pow(), ast.Constant(2))
        yield from _of_a_factor(node)
        yield "left-out", ast.Constant(1)
        yield "transpose", ast.Attribute(node, "mT", ast.Load())
        if isinstance(getattr(place.parent, "op", None), ast.MatMult):
            yield "inverse", _inverse(node)


def _inverse(node: ast.expr) -> ast.expr:
    linalg = ast.Attribute(ast.Name("np", ast.Load()), "linalg", ast.Load())
    return ast.Call(ast.Attribute(linalg, "inv", ast.Load()), [node], [])


def _of_call(node: ast.Call, names: Sequence[str]) -> Iterator[tuple[str, ast.expr]]:
    function = node.func
    name = getattr(function, "attr", getattr(function, "id", ""))
    of_numpy = isinstance(function, ast.Attribute) and _is_module(function.value)
    if node.args:
        yield "left-out", node.args[0]
    if isinstance(function, ast.Attribute) and not of_numpy:
        yield "left-out", function.value
    for i, k in combinations(range(min(len(node.args), FEW)), 2):
        args = list(node.args)
        args[i], args[k] = args[k], args[i]
        yield "order", ast.Call(function, args, node.keywords)
    for pair in TWINS:
        if name in pair and isinstance(function, ast.Attribute):
            twin = pair[1 - pair.index(name)]
            again = ast.Attribute(function.value, twin, ast.Load())
            yield "function", ast.Call(again, node.args, node.keywords)
    if name in ("mean", "sum", "median") and isinstance(function, ast.Attribute):
        whole = node.args[0] if of_numpy and node.args else function.value
        for end in (0, -1):
            yield "function", ast.Subscript(whole, ast.Constant(end), ast.Load())
    if name == "solve" and len(node.args) == 2:
        yield "operation", ast.BinOp(node.args[0], ast.MatMult(), node.args[1])
    if name == "inv":
        yield "operation", ast.BinOp(ast.Constant(1.0), ast.Div(), node.args[0])
    if name in ("ones", "zeros"):
        yield from (("name", ast.Name(one, ast.Load())) for one in names)
    if node.args and name not in ("range", "len", "zip", "int", "enumerate"):
        yield from _of_a_factor(node)


def _is_module(node: ast.expr) -> bool:
    """Return whether an expression is np, np.linalg or another module."""
    while isinstance(node, ast.Attribute):
        node = node.value
    return isinstance(node, ast.Name) and node.id in ("np", "se3", "screws", "mujoco")


def _of_subscript(node: ast.Subscript) -> Iterator[tuple[str, ast.expr]]:
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


def _of_comparison(node: ast.Compare) -> Iterator[tuple[str, ast.expr]]:
    for op in (ast.Lt, ast.LtE, ast.Gt, ast.GtE):
        if not isinstance(node.ops[0], op):
            yield "condition", ast.Compare(node.left, [op()], node.comparators)


def _of_a_list(node: Any) -> Iterator[tuple[str, ast.expr]]:
    elements = node.elts
    for i, k in combinations(range(len(elements) if len(elements) <= FEW else 0), 2):
        again = list(elements)
        again[i], again[k] = again[k], again[i]
        yield "order", type(node)(again, ast.Load())
