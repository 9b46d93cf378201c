"""The line of a student's function that a mutant's line corresponds to.

The two functions are compared by their syntax trees. Arguments are known by their
places, other variables by where they stand: `t = (b * s + e) / a` has the form of
`u = (p * q + r) / w`. Lines that occur once in both functions say which variable of the
student's is which of the reference's, so that a line with a wrong variable is found.
"""

import ast
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

LEAST = 4  # nodes of a line that tells something: x = y could be any
SYMMETRIC = (ast.Add, ast.Mult)
LOOPS = (ast.For, ast.comprehension)


class Line(NamedTuple):
    """A line of the student's function."""

    number: int
    text: str
    names: dict[str, str]  # the reference's variables there, and the student's


class _Form(NamedTuple):
    """A statement without the names of its variables, and these in their order."""

    text: str
    names: tuple[str, ...]
    size: int


@dataclass(frozen=True)
class OwnFunction:
    """A student's function beside the reference."""

    own: ast.FunctionDef
    reference: ast.FunctionDef

    def line(self, mutated: ast.stmt) -> Line | None:
        """Return the student's line with a mutant's statement; None without one."""
        form = _form(_head(mutated), self._arguments(self.reference))
        if form.size < LEAST:
            return None
        fits = [s for s in self._own if self._is_one(form, self._own[s])]
        if len(fits) != 1:
            return None
        pairs = zip(form.names, self._own[fits[0]].names, strict=True)
        text = ast.unparse(fits[0]).splitlines()[0].removesuffix(":")
        return Line(fits[0].lineno, text, {**self.names, **dict(pairs)})

    def expression(self, around: Sequence[ast.expr], most: int) -> str:
        """Return the student's text of a mutant's expression; "" without one.

        It is the largest of those around the change that the student's function has.
        One that the reference has as well says nothing.

        Args:
            around: the changed expression, what it is a part of, and so on.
            most: characters of the text.
        """
        found = ""
        for node in around:
            text = _named(node, self.names)
            mine = self._own_expressions.get(text)
            if mine is None or not self._knows(node):
                continue
            if _tells(node) and text not in self._right:
                one = ast.unparse(mine)
                found = one if len(one) <= most else found
        return found

    def _knows(self, node: ast.expr) -> bool:
        """Return whether the counters in an expression are the student's.

        An `i` of both may count other things.
        """
        names = {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}
        loops = (n for n in ast.walk(self.reference) if isinstance(n, LOOPS))
        counters = {
            n.id
            for loop in loops
            for n in ast.walk(loop.target)
            if isinstance(n, ast.Name)
        }
        return names & counters <= set(self.names)

    @cached_property
    def _own_expressions(self) -> dict[str, ast.expr]:
        """The student's expressions by their form, with their names."""
        some = (n for s in _statements(self.own) for n in ast.walk(s))
        return {_named(n, {}): n for n in some if isinstance(n, ast.expr)}

    @cached_property
    def _right(self) -> set[str]:
        """The expressions of the right function, in the student's names."""
        some = (n for s in _statements(self.reference) for n in ast.walk(s))
        return {_named(n, self.names) for n in some if isinstance(n, ast.expr)}

    def _is_one(self, form: _Form, other: _Form) -> bool:
        """Return whether a student's statement is one, with the variables known."""
        if form.text != other.text:
            return False
        pairs = zip(form.names, other.names, strict=True)
        return all(self.names.get(its, mine) == mine for its, mine in pairs)

    @cached_property
    def names(self) -> dict[str, str]:
        """Which variable of the student's is which of the reference's."""
        pairs = zip(self._arguments(self.reference), self._arguments(self.own),
                    strict=False)  # fmt: skip
        found = dict(pairs)
        theirs = Counter(form.text for form in self._reference.values())
        mine = Counter(form.text for form in self._own.values())
        own = {form.text: form for form in self._own.values()}
        for form in self._reference.values():
            if form.size >= LEAST and theirs[form.text] == mine[form.text] == 1:
                pairs = zip(form.names, own[form.text].names, strict=True)
                found = {**dict(pairs), **found}
        return found

    @cached_property
    def _own(self) -> dict[ast.stmt, _Form]:
        given = self._arguments(self.own)
        return {s: _form(_head(s), given) for s in _statements(self.own)}

    @cached_property
    def _reference(self) -> dict[ast.stmt, _Form]:
        given = self._arguments(self.reference)
        return {s: _form(_head(s), given) for s in _statements(self.reference)}

    @staticmethod
    def _arguments(function: ast.FunctionDef) -> list[str]:
        return [one.arg for one in function.args.args]


def _statements(function: ast.FunctionDef) -> Iterator[ast.stmt]:
    body = function.body[bool(ast.get_docstring(function)) :]
    for node in (inner for one in body for inner in ast.walk(one)):
        if isinstance(node, ast.stmt):
            yield node


def _tells(node: ast.expr) -> bool:
    """Return whether an expression joins two names or numbers: -x says too little."""
    return sum(isinstance(n, ast.Name | ast.Constant) for n in ast.walk(node)) > 1


def _head(statement: ast.stmt) -> ast.AST:
    """Return a statement, or what stands in the first line of a loop or a condition."""
    match statement:
        case ast.For():
            return ast.Assign([statement.target], statement.iter, lineno=0)
        case ast.If() | ast.While():
            return statement.test
        case _:
            return statement


def _form(node: ast.AST, arguments: list[str]) -> _Form:
    """Return a statement without the names of its own variables."""
    names: dict[str, str] = {}

    def called(name: str) -> str:
        if name in arguments:
            return f"argument {arguments.index(name)}"
        if name in _KNOWN:
            return name
        return names.setdefault(name, f"name {len(names)}")

    text = _written(node, called)
    return _Form(text, tuple(names), sum(1 for _ in ast.walk(node)))


def _named(node: ast.AST, names: Mapping[str, str]) -> str:
    """Return an expression in other names; one that has no other stays as it is."""
    return _written(node, lambda name: names.get(name, name))


def _written(node: Any, called: Callable[[str], str]) -> str:
    """Return what is the same of two expressions that are written alike."""
    if isinstance(node, ast.Name):
        return called(node.id)
    if isinstance(node, ast.Constant):
        return repr(float(node.value) if type(node.value) is int else node.value)
    if isinstance(node, ast.BinOp) and isinstance(node.op, SYMMETRIC):
        some = sorted((node.left, node.right), key=_blank)
        texts = [_written(one, called) for one in some]
        return f"{type(node.op).__name__}({', '.join(texts)})"
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        given = [*node.args, *(one.value for one in node.keywords)]
        texts = [_written(one, called) for one in given]
        return f"{node.func.id}({', '.join(texts)})"
    if isinstance(node, list):
        return f"[{', '.join(_written(one, called) for one in node)}]"
    if not isinstance(node, ast.AST):
        return repr(node)
    if isinstance(node, ast.expr_context):
        return ""
    fields = (value for _, value in ast.iter_fields(node))
    texts = [_written(value, called) for value in fields]
    return f"{type(node).__name__}({', '.join(texts)})"


def _blank(node: ast.expr) -> str:
    """Return an expression without any name, to order what may stand in any order."""
    some = (n for n in ast.walk(node))
    return " ".join(
        repr(n.value) if isinstance(n, ast.Constant) else type(n).__name__ for n in some
    )


_KNOWN = {
    "np",
    "numpy",
    "math",
    "range",
    "len",
    "zip",
    "enumerate",
    "abs",
    "min",
    "max",
}
