"""One slip in a function's body: each place of it changed, as a hand slips.

A named mistake is thought of by an author; a slip is made by machine: a sign turned
round, a factor left out, a name for another, two lines exchanged. Whether a wrong
function has one is found by making each in the lab's own.
"""

import ast
from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice
from typing import Any, NamedTuple

from labkit.judge.instead import Place, instead, places

SHORT = 44  # characters of a body that are shown, at most
MOST = 1500  # slips of one function
Span = tuple[int, int, int, int]  # line and column, and those of the end
Change = tuple[str, Span, Callable[[], str]]  # kind and place, and what reads it
# What a slip is called, and what is said of it.
SAYS = {
    "sign": "one sign is the other way round",
    "order": "two things have changed places",
    "left-out": "something is left out",
    "operation": "one operation stands for another",
    "sign-lost": "one sign is lost: what is negative counts as positive",
    "name": "one name stands for another",
    "index": "one index or range stands for another",
    "number": "one number stands for another",
    "factor": "a factor of two is missing, or too many",
    "negated": "one sign is the other way round",
    "bracket": "a bracket begins or ends elsewhere",
    "transpose": "one transpose is too many, or missing",
    "inverse": "one inverse is too many, or missing",
    "squared": "something is squared that should not be",
    "exchanged": "two names have changed places",
    "scaled": "something is multiplied, or divided, by what does not belong there",
    "function": "one function stands for another",
    "condition": "one condition is another",
    "line": "one line is missing, is another or stands elsewhere",
}


class Miswritten(NamedTuple):
    """A function whose body differs in one place."""

    kind: str  # one of `SAYS`
    at: int  # which of all slips, for `reads`
    place: Span  # in the text
    code: Callable[..., Any]


def miswritten(function: ast.FunctionDef, names: dict[str, Any]) -> list[Miswritten]:
    """Return the slips of a function, those first that are made most often.

    A body with a loop that runs until something happens has none: with a slip it may
    run for ever. So may `np.linalg.lstsq`, where a slip makes its numbers infinite.

    Args:
        function: as it stands in a file; it is changed and put back.
        names: of its module, which it may use.
    """
    for node in ast.walk(function):
        if isinstance(node, ast.While) or getattr(node, "attr", "") == "lstsq":
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


def _places(function: ast.FunctionDef) -> Iterator[Place]:
    body = function.body[bool(ast.get_docstring(function)) :]
    targets = [t for one in ast.walk(function) if isinstance(one, ast.Assign)
               for t in one.targets]  # fmt: skip
    set_there = {id(node) for target in targets for node in ast.walk(target)}
    for statement in body:
        for place in places(statement):
            if place.field in ("annotation", "ctx", "targets", "target"):
                continue
            if isinstance(place.node, ast.Constant) or id(place.node) not in set_there:
                yield place


def _changes(function: ast.FunctionDef) -> Iterator[Change]:
    """Change one place after the other; yield what kind that is, and how it reads."""
    names = _names(function)
    places = list(_places(function))
    above = {id(place.node): place for place in places}
    for place in places:
        around = above.get(id(place.parent))
        index = "slice" in (place.field, around and around.field)
        decides = _decides(place, above)
        for kind, new in instead(place, names):
            kind = "condition" if decides else "index" if index else kind
            ast.fix_missing_locations(ast.copy_location(new, place.node))
            with place.holding(new):
                yield (
                    kind,
                    _where(_spot(place.node, kind)),
                    partial(_shown, new, place, above),
                )
    yield from _of_lines(function)


def _decides(place: Place, above: dict[int, Place]) -> bool:
    """Return whether a place stands in a condition: what it is made of hardly shows."""
    around: Place | None = place
    while around:
        if isinstance(around.node, ast.Compare) or around.field == "test":
            return True
        around = above.get(id(around.parent))
    return False


def _spot(node: ast.expr, kind: str) -> ast.expr:
    """Return what a slip is about: of a sum's sign the term behind it."""
    return node.right if kind == "sign" and isinstance(node, ast.BinOp) else node


def _where(node: ast.expr | ast.stmt) -> Span:
    end = node.end_lineno, node.end_col_offset
    return node.lineno, node.col_offset, end[0] or 0, end[1] or 0


def _names(function: ast.FunctionDef) -> list[str]:
    """Return the names of a function's arguments and of what it makes."""
    made = [n.id for n in ast.walk(function)
            if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]  # fmt: skip
    return list(dict.fromkeys([*(a.arg for a in function.args.args), *made]))


def _shown(new: ast.expr, place: Place, above: dict[int, Place]) -> str:
    """Return the changed place with what stands around it, if that is short."""
    text = ast.unparse(new)
    around: Place | None = place
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
    if isinstance(place.parent, ast.Assign):
        text = f"{ast.unparse(place.parent.targets[0])} = {text}"
    return text if len(text) <= SHORT else ""


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
