"""What a search may cost: it is counted in lines of Python, and not in seconds.

So the same mistake gets the same name on a slow machine. How many lines a function
executes is read off its text: CPython 3.11 can end in an endless loop if a trace or a
profile is set in a process that has thrown an exception into another thread.
"""

import ast
import builtins
import inspect
import textwrap
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache
from types import FunctionType, ModuleType
from typing import Any, NamedTuple

LINES = 6_000_000  # that a search may execute; a third of a second, or so
ONCE = 1000  # lines that take as long as to compile a mutant and compare its answer
LATE = 2.0  # seconds of the processor, whatever the lines take
LOOKS = 16  # hypotheses after which the clock is looked at: it is slow
# How many short lines take as long as an operator between arrays, as a function of
# NumPy, as one of its linear algebra, as a function that is an argument, and as a slow
# one of NumPy.
OPERATOR, NUMPY, LINALG, GIVEN, SLOW = 2, 10, 80, 150, 300
ITERATIVE = (
    "lstsq", "svd", "eigh", "eigvalsh", "eig", "eigvals", "pinv", "matrix_rank",
)  # fmt: skip
_SLOW = {*ITERATIVE, "allclose", "block", "cross", "isclose", "kron", "percentile",
         "polyfit", "quantile"}  # fmt: skip
DEEP = 3  # functions that call each other, whose lines are counted
TURNS, SEARCH = 2, 8  # of a loop in them, and of one that ends when it has found it
_OPERATORS = (ast.BinOp, ast.Subscript, ast.Compare)
_LOOPS = (ast.For, ast.While, ast.ListComp, ast.GeneratorExp, ast.SetComp, ast.DictComp)


@dataclass
class Effort:
    """What is left of a search."""

    left: int = LINES
    began: float = field(default_factory=time.process_time)
    asked: int = 0  # how often
    late: bool = False

    def spend(self, lines: int) -> None:
        """Note that a hypothesis was asked for one answer."""
        self.left -= ONCE + lines

    def spent(self, keep: float = 0.0) -> bool:
        """Return whether a search has to end, to leave a share for what comes later."""
        self.asked += 1
        if self.asked % LOOKS == 0:
            self.late = time.process_time() > self.began + LATE
        return self.late or self.left <= keep * LINES


class Work(NamedTuple):
    """How many lines a function executes, or so."""

    once: int = 0  # outside of its loops
    step: int = 0  # in each step of them

    def lines(self, steps: int) -> int:
        """Return how many a call executes whose loops take some steps together."""
        return self.once + self.step * max(steps, 1)


NONE = Work()


def work(function: ast.FunctionDef, space: Mapping[str, Any]) -> Work:
    """Return what a call of a function executes.

    Args:
        function: the syntax tree.
        space: the names of its module. The lines of a Python function among them that
            it calls are counted, too.
    """
    own = [one for one in ast.walk(function) if isinstance(one, ast.FunctionDef)][1:]
    space = {**space, **{one.name: _lines(one, space) for one in own}}
    loops = _loops(function)
    inner = {id(one) for loop in loops for one in _loops(loop)[1:]}
    inside = sum(_lines(one, space) for one in loops if id(one) not in inner)
    return Work(_lines(function, space) - inside, inside // max(len(loops), 1))


def _loops(tree: ast.AST) -> list[ast.AST]:
    """Return the loops and comprehensions of a tree."""
    return [one for one in ast.walk(tree) if isinstance(one, _LOOPS)]


def _lines(tree: ast.AST, space: Mapping[str, Any], deep: int = DEEP) -> int:
    """Return the lines of a tree whose loops are passed once."""
    return sum(_lines_of(node, space, deep) for node in ast.walk(tree))


def _lines_of(node: ast.AST, space: Mapping[str, Any], deep: int) -> int:
    """Return the lines of a node without those below it."""
    if isinstance(node, ast.Call):
        return _of_call(_found(node.func, space), deep)
    return isinstance(node, ast.stmt) + OPERATOR * isinstance(node, _OPERATORS)


def _of_call(called: Any, deep: int) -> int:
    """Return the lines of a call; a number is these, and None stands for a method."""
    if isinstance(called, int):
        return called
    module = getattr(called, "__module__", None) or ""
    if module.startswith("numpy"):
        if called.__name__ in _SLOW:
            return SLOW
        return LINALG if "linalg" in module else NUMPY
    if isinstance(called, FunctionType):
        return _inside(called, deep)
    return OPERATOR


def _found(name: ast.expr, space: Mapping[str, Any]) -> Any:
    """Return what a name stands for; None of a method, `GIVEN` of an argument."""
    match name:
        case ast.Name(id):
            return space.get(id, getattr(builtins, id, GIVEN))
        case ast.Attribute(value, attr):
            owner = _found(value, space)
            return getattr(owner, attr, None) if isinstance(owner, ModuleType) else None
    return None


@cache
def _inside(function: Callable[..., Any], deep: int) -> int:
    """Return how many lines a call of a function executes, `NUMPY` at least."""
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    except (OSError, TypeError, SyntaxError):
        return NUMPY
    space = inspect.unwrap(function).__globals__
    if not deep:
        return NUMPY
    again = sum(_again(one) * _lines(one, space, deep - 1) for one in _loops(tree))
    return NUMPY + _lines(tree, space, deep - 1) + again


def _again(loop: ast.AST) -> int:
    """Return how often a loop is passed, or so, after the first time."""
    ends = ast.While | ast.Break | ast.Return
    return (SEARCH if any(isinstance(x, ends) for x in ast.walk(loop)) else TURNS) - 1
