"""Mutation operators on statements: lines left out, exchanged, done twice, returned."""

import ast
import copy
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

Lines = list[ast.stmt]
OF_A_LOOP = ("[:-1]", "[1:]", "[::-1]")
FAR_OF_A_LOOP = ("[:1]", "[-1:]", "[:2]", "[::2]")


class Block(NamedTuple):
    """The lines of a body or of a loop, and the one that a change is about."""

    lines: Lines
    before: Lines  # what stood there
    at: int

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
            block = Block(lines, list(lines), at)
            yield from ((block, new, False) for new in _near(block.before, at, line))
            yield from ((block, new, True) for new in _far(block.before, at, line))


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


def _near(body: Lines, at: int, line: ast.stmt) -> Iterator[Lines]:
    """Yield a body with another line in one's place, or with two exchanged."""
    before, after = body[:at], body[at + 1 :]
    if not isinstance(line, ast.Return | ast.Expr):
        yield [*before, ast.Pass(), *after]
    if after and isinstance(line, ast.Assign | ast.AugAssign):
        yield [*before, after[0], line, *after[1:]]
    if isinstance(line, ast.AugAssign):
        for new in _instead_of_adding(line):
            yield [*before, new, *after]
    if isinstance(line, ast.For):
        for new in _over_some(line, OF_A_LOOP):
            yield [*before, new, *after]


def _far(body: Lines, at: int, line: ast.stmt) -> Iterator[Lines]:
    before, after = body[:at], body[at + 1 :]
    if isinstance(line, ast.For | ast.While):
        yield from ([*before, new, *after] for new in _other_loops(body, at, line))
        yield [*before, *line.body, *after]
        yield [*before, line, line, *after]
    if isinstance(line, ast.For):
        for new in _over_some(line, FAR_OF_A_LOOP):
            yield [*before, new, *after]
    if isinstance(line, ast.If):
        yield [*before, *line.body, *after]
        yield [*before, *(line.orelse or [ast.Pass()]), *after]
    if isinstance(line, ast.Continue | ast.Break):
        other = ast.Break() if isinstance(line, ast.Continue) else ast.Continue()
        yield [*before, other, *after]
    if isinstance(line, ast.Assign | ast.AugAssign):
        yield [*before, line, line, *after]
        last = after[-1:] if after and isinstance(after[-1], ast.Return) else []
        yield [*before, *after[: len(after) - len(last)], line, *last]
        yield from _early_return(before, line, after)
    if isinstance(line, ast.Expr):
        yield [*before, ast.Pass(), *after]


def _early_return(before: Lines, line: Any, after: Lines) -> Iterator[Lines]:
    """Yield a body that returns what a line has made, and no more."""
    targets = line.targets if isinstance(line, ast.Assign) else [line.target]
    if after and isinstance(targets[0], ast.Name):
        value = ast.Name(targets[0].id, ast.Load())
        yield [*before, line, ast.Return(value), *after]


def _other_loops(body: Lines, at: int, loop: Any) -> Iterator[ast.stmt]:
    """Yield a loop that ends after one round, returns in it, or starts anew in each."""
    yield _with(loop, [*loop.body, ast.Break()])
    after = body[at + 1 : at + 2]
    if after and isinstance(after[0], ast.Return):
        yield _with(loop, [*loop.body, after[0]])
    carried = _stored(loop.body)
    for line in body[:at]:
        if isinstance(line, ast.Assign) and carried & _stored([line]):
            yield _with(loop, [line, *loop.body])  # what it carries is reset
            yield _with(loop, _stale(loop.body, line))


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


def _over_some(loop: ast.For, ends: Sequence[str]) -> Iterator[ast.stmt]:
    for end in ends:
        text = f"list({ast.unparse(loop.iter)}){end}"
        again = ast.parse(text, mode="eval").body
        yield ast.For(loop.target, again, loop.body, loop.orelse)


def _instead_of_adding(line: ast.AugAssign) -> Iterator[ast.stmt]:
    value = line.value
    if isinstance(line.op, ast.Sub):
        yield ast.AugAssign(line.target, ast.Add(), value)
        value = ast.UnaryOp(ast.USub(), value)
    elif isinstance(line.op, ast.Add):
        yield ast.AugAssign(line.target, ast.Sub(), value)
    yield ast.Assign([line.target], value, lineno=line.lineno)
