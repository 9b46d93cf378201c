"""One slip in a function's body: each place of it changed, as a hand slips.

A named mistake is thought of by an author; a slip is made by machine: a sign turned
round, a factor left out, a name for another, two lines exchanged. Whether a wrong
function has one is found by making each in the lab's own.
"""

import ast
import copy
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import combinations, islice
from typing import Any, NamedTuple

SHORT = 44  # characters of a body that are shown, at most
FEW = 7  # entries of a list, of which any two are exchanged
MOST = 1500  # slips of one function
Place = tuple[int, int, int, int]  # line and column, and those of the end
Change = tuple[str, Place, Callable[[], str]]  # kind and place, and what reads it
NUMBERED = (ast.List, ast.Tuple)
TWINS = [
    ("sin", "cos"), ("argmin", "argmax"), ("min", "max"), ("minimum", "maximum"),
    ("floor", "round"), ("ceil", "round"), ("trunc", "round"), ("sum", "mean"),
    ("cumsum", "cumprod"), ("sum", "prod"), ("prod", "min"), ("hstack", "vstack"),
    ("inv", "pinv"), ("any", "all"), ("eye", "ones"), ("arctan", "tan"),
    ("mean", "median"), ("zeros", "ones"), ("max", "mean"),
]  # fmt: skip
# What a slip is called, and what is said of it.
SAYS = {
    "sign": "one sign is the other way round",
    "negated": "one sign is the other way round",
    "left-out": "something is left out",
    "operation": "one operation stands for another",
    "number": "one number stands for another",
    "factor": "a factor of two is missing, or too many",
    "name": "one name stands for another",
    "order": "two things have changed places",
    "transpose": "one transpose is too many, or missing",
    "index": "one index or range stands for another",
    "squared": "something is squared that should not be",
    "exchanged": "two names have changed places",
    "scaled": "something is multiplied, or divided, by what does not belong there",
    "function": "one function stands for another",
    "comparison": "one comparison stands for another",
    "line": "one line is missing, is another or stands elsewhere",
}


class Miswritten(NamedTuple):
    """A function whose body differs in one place."""

    kind: str  # one of `SAYS`
    at: int  # which of all slips, for `reads`
    place: Place  # in the text
    code: Callable[..., Any]


def miswritten(function: ast.FunctionDef, names: dict[str, Any]) -> list[Miswritten]:
    """Return the slips of a function, those first that are made most often.

    A body with a loop that runs until something happens has none: with a slip it may
    run for ever.

    Args:
        function: as it stands in a file; it is changed and put back.
        names: of its module, which it may use.
    """
    if any(isinstance(node, ast.While) for node in ast.walk(function)):
        return []
    space = dict(names)
    found = []
    function.decorator_list.clear()
    for at, (kind, place, _) in enumerate(islice(_changes(function), MOST)):
        if code := _compiled(function, space):
            found.append(Miswritten(kind, at, place, code))
    return sorted(found, key=rank)


def rank(slip: Miswritten) -> int:
    """Return how often a slip of this kind is made: 0 is most often."""
    return list(SAYS).index(slip.kind)


def besides(
    function: ast.FunctionDef, names: dict[str, Any], slip: Miswritten
) -> list[Miswritten]:
    """Return the functions with a slip and with another one each, by the other."""
    changes = islice(_changes(function), slip.at, None)
    next(changes)
    others = miswritten(function, names)
    del changes  # it puts the place back
    return [one for one in others if not overlap(one, slip)]


def overlap(one: Miswritten, other: Miswritten) -> bool:
    """Return whether one slip lies within the place of the other."""
    a, b = one.place, other.place
    return not (a[2:] <= b[:2] or b[2:] <= a[:2])


def reads(
    function: ast.FunctionDef, slip: Miswritten, after: Miswritten | None = None
) -> str:
    """Return how the place of a slip reads, "theta + s"; "" where that is long.

    Args:
        function: as it stands in a file.
        slip: one of its slips.
        after: the slip beside which that is one.
    """
    before = islice(_changes(function), after.at, None) if after else iter(())
    next(before, None)
    changes = islice(_changes(function), slip.at, None)
    *_, shown = next(changes)
    text = shown()
    del changes, before  # they put the places back
    return text


def _compiled(
    function: ast.FunctionDef, space: dict[str, Any]
) -> Callable[..., Any] | None:
    try:
        exec(compile(ast.Module([function], []), "<slip>", "exec"), space)
    except (SyntaxError, ValueError, TypeError):
        return None
    return space[function.name]


class _Place(NamedTuple):
    """Where an expression stands."""

    node: ast.expr
    parent: ast.AST
    field: str
    at: int | None  # in a list of the parent's

    def put(self, new: ast.expr) -> None:
        if self.at is None:
            setattr(self.parent, self.field, new)
        else:
            getattr(self.parent, self.field)[self.at] = new


def _places(function: ast.FunctionDef) -> Iterator[_Place]:
    body = function.body[bool(ast.get_docstring(function)) :]
    for statement in body:
        for parent in ast.walk(statement):
            for field, value in ast.iter_fields(parent):
                if field in ("annotation", "ctx", "targets", "target"):
                    continue
                several = value if isinstance(value, list) else [value]
                for at, one in enumerate(several):
                    if isinstance(one, ast.expr):
                        place = at if isinstance(value, list) else None
                        yield _Place(one, parent, field, place)


def _changes(function: ast.FunctionDef) -> Iterator[Change]:
    """Change one place after the other; yield what kind that is, and how it reads."""
    names = _names(function)
    places = list(_places(function))
    above = {id(place.node): place for place in places}
    for place in places:
        around = above.get(id(place.parent))
        index = "slice" in (place.field, around and around.field)
        for kind, new in _instead(place, names):
            kind = "index" if index else kind
            place.put(ast.fix_missing_locations(ast.copy_location(new, place.node)))
            try:
                yield (
                    kind,
                    _where(_spot(place.node, kind)),
                    partial(_shown, new, place, above),
                )
            finally:
                place.put(place.node)
    yield from _of_lines(function)


def _spot(node: ast.expr, kind: str) -> ast.expr:
    """Return what a slip is about: of a sum's sign the term behind it."""
    return node.right if kind == "sign" and isinstance(node, ast.BinOp) else node


def _where(node: ast.expr | ast.stmt) -> Place:
    end = node.end_lineno, node.end_col_offset
    return node.lineno, node.col_offset, end[0] or 0, end[1] or 0


def _names(function: ast.FunctionDef) -> list[str]:
    """Return the names of a function's arguments and of what it makes."""
    made = [n.id for n in ast.walk(function)
            if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]  # fmt: skip
    return list(dict.fromkeys([*(a.arg for a in function.args.args), *made]))


def _shown(new: ast.expr, place: _Place, above: dict[int, _Place]) -> str:
    """Return the changed place with what stands around it, if that is short."""
    text = ast.unparse(new)
    around: _Place | None = place
    while around and isinstance(around.parent, ast.expr):
        if len(wider := ast.unparse(around.parent)) > SHORT:
            break
        text = wider
        around = above.get(id(around.parent))
    dots = ast.Name("...", ast.Load())
    if len(text) > SHORT and isinstance(new, ast.BinOp):
        text = ast.unparse(ast.BinOp(dots, new.op, new.right))
    elif text.isidentifier() and isinstance(place.parent, ast.BinOp):
        left = place.field == "left"
        pair = (new, dots) if left else (dots, new)
        text = ast.unparse(ast.BinOp(pair[0], place.parent.op, pair[1]))
    return text if len(text) <= SHORT else ""


def _instead(place: _Place, names: Sequence[str]) -> Iterator[tuple[str, ast.expr]]:
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
    if isinstance(place.parent, ast.stmt) and not isinstance(place.parent, ast.If):
        yield from _of_a_whole(node, names)
    inside = isinstance(place.parent, (*NUMBERED, ast.Call, ast.Return, ast.keyword))
    plain = isinstance(node, (*NUMBERED, ast.Constant, ast.UnaryOp, ast.Name))
    if inside and place.field != "func" and not plain:
        yield "negated", ast.UnaryOp(ast.USub(), node)


def _of_a_whole(node: ast.expr, names: Sequence[str]) -> Iterator[tuple[str, ast.expr]]:
    """Yield slips of all that stands in a line."""
    there = {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}
    for pair in combinations([name for name in names if name in there], 2):
        yield "exchanged", _Exchanged(*pair).visit(copy.deepcopy(node))
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


def _of_a_part(node: ast.expr, place: _Place) -> Iterator[tuple[str, ast.expr]]:
    """Yield slips of an entry, or of a function's answer, within a product."""
    if isinstance(place.parent, ast.BinOp):
        yield "squared", ast.BinOp(node, ast.Pow(), ast.Constant(2))
        if isinstance(place.parent.op, ast.MatMult):
            yield "transpose", ast.Attribute(node, "T", ast.Load())
        if isinstance(node, ast.Subscript):
            yield from _of_a_factor(node)


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


def _of_number(node: ast.Constant, place: _Place) -> Iterator[tuple[str, ast.expr]]:
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
    node: ast.Name, names: Sequence[str], place: _Place
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
        yield "transpose", ast.Attribute(node, "T", ast.Load())


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
        each = [*some[:at], turned, *some[at + 1 :]]
        where = ast.Tuple(each, ast.Load()) if len(each) > 1 else turned
        yield "index", ast.Subscript(node.value, where, ast.Load())
    if len(some) == 2:
        where = ast.Tuple(some[::-1], ast.Load())
        yield "index", ast.Subscript(node.value, where, ast.Load())


def _of_comparison(node: ast.Compare) -> Iterator[tuple[str, ast.expr]]:
    for op in (ast.Lt, ast.LtE, ast.Gt, ast.GtE):
        if not isinstance(node.ops[0], op):
            yield "comparison", ast.Compare(node.left, [op()], node.comparators)


def _of_a_list(node: Any) -> Iterator[tuple[str, ast.expr]]:
    elements = node.elts
    for i, k in combinations(range(len(elements) if len(elements) <= FEW else 0), 2):
        again = list(elements)
        again[i], again[k] = again[k], again[i]
        yield "order", type(node)(again, ast.Load())


def _of_lines(function: ast.FunctionDef) -> Iterator[Change]:
    """Leave lines out, exchange neighbours, and take what adds up for what is set."""
    bodies = [function.body]
    for node in ast.walk(function):
        if isinstance(node, ast.For | ast.If):
            bodies += [some for some in (node.body, node.orelse) if some]
    for body in bodies:
        for at, line in enumerate(list(body)):
            yield from _of_line(body, at, line)


def _of_line(body: list[ast.stmt], at: int, line: ast.stmt) -> Iterator[Change]:
    before = list(body)
    for some in _other_lines(before, at, line):
        for new in some[at : at + 2]:
            ast.fix_missing_locations(ast.copy_location(new, line))
        body[:] = some
        try:
            yield "line", _where(line), partial(_line_shown, some, at, line)
        finally:
            body[:] = before


def _line_shown(body: list[ast.stmt], at: int, line: ast.stmt) -> str:
    """Return how a changed line reads, or that it is not there."""
    new = body[at]
    if isinstance(new, ast.Pass):
        text = f"without {_first(line)}"
    elif at + 1 < len(body) and body[at + 1] is line:
        text = f"{_first(new)}, then {_first(line)}"
    else:
        text = _first(new)
    return text if len(text) <= 2 * SHORT else ""


def _first(line: ast.stmt) -> str:
    return ast.unparse(line).splitlines()[0]


def _other_lines(
    body: list[ast.stmt], at: int, line: ast.stmt
) -> Iterator[list[ast.stmt]]:
    """Yield a body with another line in one's place, or with two exchanged."""
    if not isinstance(line, ast.Return | ast.Expr):
        yield [*body[:at], ast.Pass(), *body[at + 1 :]]
    if at + 1 < len(body) and isinstance(line, ast.Assign | ast.AugAssign):
        yield [*body[:at], body[at + 1], line, *body[at + 2 :]]
    if isinstance(line, ast.AugAssign):
        for new in _instead_of_adding(line):
            yield [*body[:at], new, *body[at + 1 :]]
    if isinstance(line, ast.For):
        for end in ("[:-1]", "[1:]", "[::-1]"):
            again = ast.parse(f"list({ast.unparse(line.iter)}){end}", mode="eval").body
            new = ast.For(line.target, again, line.body, line.orelse)
            yield [*body[:at], new, *body[at + 1 :]]


def _instead_of_adding(line: ast.AugAssign) -> Iterator[ast.stmt]:
    value = line.value
    if isinstance(line.op, ast.Sub):
        yield ast.AugAssign(line.target, ast.Add(), value)
        value = ast.UnaryOp(ast.USub(), value)
    elif isinstance(line.op, ast.Add):
        yield ast.AugAssign(line.target, ast.Sub(), value)
    yield ast.Assign([line.target], value, lineno=line.lineno)
