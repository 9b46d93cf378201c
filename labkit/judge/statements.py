"""Mutation operators on statements: lines left out, exchanged, done twice, returned."""

import ast
import copy
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

Lines = list[ast.stmt]
Changed = tuple[Lines, str]  # other lines, and what "your code" does that has them
OF_A_LOOP = {
    "[:-1]": "skips the last element in a loop",
    "[1:]": "skips the first element in a loop",
    "[::-1]": "runs a loop in the reverse order",
}
FAR_OF_A_LOOP = {
    "[:1]": "stops a loop after its first element",
    "[-1:]": "runs a loop only for its last element",
    "[:2]": "stops a loop after two elements",
    "[::2]": "skips every second element in a loop",
}


class Block(NamedTuple):
    """The lines of a body or of a loop, and the one that a change is about."""

    lines: Lines
    before: Lines  # what stood there
    at: int
    says: str  # of the lines that stand there instead

    @property
    def node(self) -> ast.stmt:
        """The line that a change is about."""
        return self.before[self.at]

    def put(self, new: Lines) -> None:
        """Set other lines there."""
        self.lines[:] = new


def changes(function: ast.FunctionDef) -> Iterator[tuple[Block, Lines, bool]]:
    """Yield a block, other lines to stand there, and whether that is far."""
    blocks = [function.body]
    for node in ast.walk(function):
        if isinstance(node, ast.For | ast.If | ast.While):
            blocks += [some for some in (node.body, node.orelse) if some]
    for lines in blocks:
        for at, line in enumerate(list(lines)):
            if at == 0 and _is_docstring(line):
                continue
            before = list(lines)
            for far, some in ((False, _near), (True, _far)):
                for new, says in some(before, at, line):
                    yield Block(lines, before, at, says), new, far


def shown(new: Lines, block: Block, most: int) -> str:
    """Return how a changed line reads, or that it is not there; "" if that is long."""
    before, at = block.before, block.at
    if len(new) < len(before) or isinstance(new[at], ast.Pass):
        text = f"without {_first(before[at])}"
    elif at + 1 < len(new) and new[at + 1] is before[at]:
        text = f"{_first(new[at])}, then {_first(before[at])}"
    else:
        text = _first(new[at])
    return text if len(text) <= most else ""


def _first(line: ast.stmt) -> str:
    return ast.unparse(line).splitlines()[0]


def _is_docstring(line: ast.stmt) -> bool:
    return isinstance(line, ast.Expr) and isinstance(line.value, ast.Constant)


def _near(body: Lines, at: int, line: ast.stmt) -> Iterator[Changed]:
    """Yield a body with another line in one's place, or with two exchanged."""
    before, after = body[:at], body[at + 1 :]
    if not isinstance(line, ast.Return | ast.Expr):
        yield [*before, ast.Pass(), *after], "omits a step"
    if after and isinstance(line, ast.Assign | ast.AugAssign):
        yield [*before, after[0], line, *after[1:]], "does two steps in the wrong order"
    if isinstance(line, ast.AugAssign):
        for new, says in _instead_of_adding(line):
            yield [*before, new, *after], says
    if isinstance(line, ast.For):
        for new, says in _over_some(line, OF_A_LOOP):
            yield [*before, new, *after], says


def _far(body: Lines, at: int, line: ast.stmt) -> Iterator[Changed]:
    before, after = body[:at], body[at + 1 :]
    if isinstance(line, ast.For | ast.While):
        for new, says in _other_loops(body, at, line):
            yield [*before, new, *after], says
        yield (
            [*before, *line.body, *after],
            "omits a loop, so its body runs only once",
        )
        yield [*before, line, line, *after], "runs a loop twice"
    if isinstance(line, ast.For):
        for new, says in _over_some(line, FAR_OF_A_LOOP):
            yield [*before, new, *after], says
    if isinstance(line, ast.If):
        says = "omits a case distinction"
        yield [*before, *line.body, *after], says
        yield [*before, *(line.orelse or [ast.Pass()]), *after], says
    if isinstance(line, ast.Continue | ast.Break):
        stops = isinstance(line, ast.Continue)
        other = ast.Break() if stops else ast.Continue()
        says = (
            "ends a loop that should continue"
            if stops
            else "does not end a loop that should end"
        )
        yield [*before, other, *after], says
    if isinstance(line, ast.Assign | ast.AugAssign):
        yield [*before, line, line, *after], "does a step twice"
        last = after[-1:] if after and isinstance(after[-1], ast.Return) else []
        late = [*before, *after[: len(after) - len(last)], line, *last]
        yield late, "does a step too late"
        yield from _early_return(before, line, after)
    if isinstance(line, ast.Expr):
        yield [*before, ast.Pass(), *after], "omits a step"


def _early_return(before: Lines, line: Any, after: Lines) -> Iterator[Changed]:
    """Yield a body that returns what a line has made, and no more."""
    targets = line.targets if isinstance(line, ast.Assign) else [line.target]
    if after and isinstance(targets[0], ast.Name):
        early = ast.Return(ast.Name(targets[0].id, ast.Load()))
        yield [*before, line, early, *after], "omits the last steps"


def _other_loops(body: Lines, at: int, loop: Any) -> Iterator[tuple[ast.stmt, str]]:
    """Yield a loop that ends after one pass, returns in it, or starts anew in each."""
    yield (
        _with(loop, [*loop.body, ast.Break()]),
        "stops a loop after its first iteration",
    )
    after = body[at + 1 : at + 2]
    if after and isinstance(after[0], ast.Return):
        inside = _with(loop, [*loop.body, after[0]])
        yield (
            inside,
            "returns inside a loop, so the loop stops after one iteration",
        )
    carried = _stored(loop.body)
    for line in body[:at]:
        if isinstance(line, ast.Assign) and carried & _stored([line]):
            reset = _with(loop, [line, *loop.body])
            yield reset, "resets a value in every iteration of a loop"
            stale = _with(loop, _stale(loop.body, line))
            yield stale, "uses the value from before a loop in every iteration"


def _stale(lines: Lines, first: ast.Assign) -> Lines:
    """Return a loop's lines that read what a name was before the loop."""
    target = first.targets[0]
    found = copy.deepcopy(lines)
    if not isinstance(target, ast.Name):
        return found
    for node in [n for line in found for n in ast.walk(line)]:
        for name, value in ast.iter_fields(node):
            same = isinstance(value, ast.Name) and value.id == target.id
            if same and not _is_stored(value):
                setattr(node, name, first.value)
    return found


def _stored(lines: Sequence[ast.stmt]) -> set[str]:
    nodes = (node for line in lines for node in ast.walk(line))
    return {n.id for n in nodes if isinstance(n, ast.Name) and _is_stored(n)}


def _is_stored(node: ast.Name) -> bool:
    return isinstance(node.ctx, ast.Store)


def _with(loop: Any, body: Lines) -> Any:
    fields = dict(ast.iter_fields(loop))
    return type(loop)(**{**fields, "body": body})


def _over_some(
    loop: ast.For, ends: Mapping[str, str]
) -> Iterator[tuple[ast.stmt, str]]:
    for end, says in ends.items():
        text = f"list({ast.unparse(loop.iter)}){end}"
        again = ast.parse(text, mode="eval").body
        yield ast.For(loop.target, again, loop.body, loop.orelse), says


def _instead_of_adding(line: ast.AugAssign) -> Iterator[tuple[ast.stmt, str]]:
    value = line.value
    if isinstance(line.op, ast.Sub):
        plus = ast.AugAssign(line.target, ast.Add(), value)
        yield plus, "adds a term instead of subtracting it"
        value = ast.UnaryOp(ast.USub(), value)
    elif isinstance(line.op, ast.Add):
        minus = ast.AugAssign(line.target, ast.Sub(), value)
        yield minus, "subtracts a term instead of adding it"
    only = ast.Assign([line.target], value, lineno=line.lineno)
    yield (
        only,
        "keeps only the last term of a sum, because it assigns each term",
    )
