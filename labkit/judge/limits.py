"""Limits of one call of a search, which a mutation may keep busy for ever.

Loops count their steps and look at the clock, which needs no signal: a search runs in
threads and on Windows as well. LAPACK may not return from numbers that are not finite,
so these are refused before. An array whose size is a changed number is refused before
it is made.
"""

import ast
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial, wraps
from types import ModuleType
from typing import Any

import numpy as np

from labkit.judge.effort import ITERATIVE, NONE, Work

Code = Callable[..., Any]
STEP = "_step_"  # the name that a limited body calls
MOST = 1_000_000  # steps of a call of a right function
# A mutant may take so many times the steps and the time of the right function.
LEAST, TIMES = 100, 20
SECONDS = 0.02  # at least
LOOKS = 16  # steps, or hypotheses, after which the clock is looked at: it is slow
HUGE = 10_000  # numbers of an array that a mutant may make, or ...
LONG = 1_000  # of a range: all pairs of its numbers are made of it in the next step
MANY = 1_000_000  # that a right function may make
GROWS = 4  # steps after which variables are looked at: arrays may double at each
LARGE = 1_000_000  # numbers of an array in a loop
RANGES = ("arange", "linspace", "logspace", "geomspace")


class TooLongError(Exception):
    """A mutant takes more steps than any right function."""


Measured = tuple[int, float, Work, dict[str, int]]


@dataclass
class Steps:
    """The steps of one call."""

    most: int = MOST  # of one call
    left: int = MOST
    seconds: float = 60.0  # of one call
    ends: float = 0.0  # when a call has taken too long
    usual: int = 0  # steps of the right function
    work: Work = NONE  # what it executes
    # Numbers of the largest array that it makes, by the function that makes it; None
    # before it is known.
    largest: dict[str, int] | None = None
    _made: dict[str, int] | None = None  # the same, while a right function is measured

    @property
    def measured(self) -> Measured:
        """What a call of the right function takes: steps, seconds, lines, numbers."""
        return self.usual, self.seconds, self.work, self.largest or {}

    @measured.setter
    def measured(self, measured: Measured) -> None:
        self.usual, self.seconds, self.work, self.largest = measured
        self._allow()

    def _allow(self) -> None:
        """Allow a mutant some times what the right function takes."""
        self.most = self.left = LEAST + TIMES * self.usual

    def __call__(self, some: Iterable[Any] = ()) -> Iterator[Any]:
        """Yield some things, and count them."""
        for one in some:
            self.count(2)
            yield one

    def count(self, up: int = 1) -> None:
        """Count a step.

        Args:
            up: how many frames above this one the loop is.

        Raises:
            TooLongError: it is one too many, or an array has grown too large: an array
                of its own former self doubles at each step.
        """
        self.left -= 1
        if self.left < 0 or (self.left % LOOKS == 0 and self._is_late()):
            raise TooLongError
        if self.left % GROWS == 0:
            for one in sys._getframe(up).f_locals.values():
                if isinstance(one, np.ndarray) and one.size > LARGE:
                    raise TooLongError

    def _is_late(self) -> bool:
        """Return whether a call takes too long; the clock begins when it is asked."""
        now = time.process_time()
        self.ends = self.ends or now + self.seconds
        return now > self.ends

    def make(self, numbers: float, name: str) -> None:
        """Note that a function of NumPy is to make an array.

        Args:
            numbers: how many it will hold.
            name: of the function.

        Raises:
            TooLongError: it is too large; filling it would take seconds.
        """
        if numbers > self._room(name):
            raise TooLongError
        if self._made is not None:
            self._made[name] = max(self._made.get(name, 0), int(numbers))

    def _room(self, name: str) -> float:
        """Return how many numbers an array may hold that a function makes."""
        if self.largest is None:
            return MANY
        least = LONG if name in RANGES else HUGE
        return max(least, TIMES * self.largest.get(name, 0))

    def limiting(self, code: Callable[..., Any]) -> Callable[..., Any]:
        """Return a function whose calls begin to count anew."""

        @wraps(code)
        def call(*args: Any) -> Any:
            self.left, self.ends = self.most, 0.0
            return code(*args)

        return call

    def calibrate(self, call: Callable[[], Any], work: Work) -> None:
        """Allow a mutant some times the steps that a call of the right one takes.

        Args:
            call: of the right function.
            work: what that executes.
        """
        self.most, self.left, began = MOST, MOST, time.process_time()
        self.largest, self._made = None, {}
        with suppress(Exception):  # not all right bodies take what a lab's does
            call()
            self.usual = MOST - self.left
            self.seconds = SECONDS + TIMES * (time.process_time() - began)
        self.work = work
        self.largest, self._made = self._made, None
        self._allow()

    @property
    def lines(self) -> int:
        """The lines that a call of the right function executes, or so."""
        return self.work.lines(self.usual)

    @property
    def taken(self) -> int:
        """The lines that the last call has executed, by its steps."""
        return self.work.lines(self.most - self.left)


def loops(trees: Iterable[ast.AST]) -> list[Any]:
    """Return the loops and comprehensions in some trees."""
    nodes = (node for tree in trees for node in ast.walk(tree))
    return [n for n in nodes if isinstance(n, ast.For | ast.While | ast.comprehension)]


def limited(loops: Iterable[Any]) -> list[Callable[[], None]]:
    """Have loops count their steps; return what undoes it."""
    undo: list[Callable[[], None]] = []
    for node in {id(one): one for one in loops}.values():
        if isinstance(node, ast.For | ast.comprehension):
            undo.append(partial(setattr, node, "iter", node.iter))
            name = ast.copy_location(ast.Name(STEP, ast.Load()), node.iter)
            node.iter = ast.copy_location(ast.Call(name, [node.iter], []), node.iter)
        else:
            text = ast.parse(f"{STEP}.count()").body[0]
            undo.append(partial(setattr, node, "body", node.body))
            for inner in ast.walk(text):
                ast.copy_location(inner, node.body[0])
            node.body = [text, *node.body]
    return undo


def _guarded(real: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(real)
    def call(*args: Any, **options: Any) -> Any:
        arrays = [x for x in args if isinstance(x, np.ndarray) and x.dtype.kind == "f"]
        if not all(np.isfinite(x).all() for x in arrays):
            raise np.linalg.LinAlgError("not finite")
        return real(*args, **options)

    return call


def _sized(name: str, steps: Steps) -> Code:
    real, size = getattr(np, name), SIZES[name]

    @wraps(real)
    def call(*args: Any, **options: Any) -> Any:
        numbers = 0.0
        with suppress(Exception):  # the real one says what is wrong with its arguments
            numbers = float(size(*args, **options))
        steps.make(numbers, name)
        return real(*args, **options)

    return call


def _of_shape(shape: Any, *_: Any, **__: Any) -> Any:
    return np.prod(np.atleast_1d(shape), dtype=float)


def _of_range(start: Any, stop: Any = None, step: Any = 1, **_: Any) -> Any:
    return (start if stop is None else stop - start) / step


def _of_steps(start: Any, stop: Any, num: Any = 50, *_: Any, **__: Any) -> Any:
    return num * np.size(start)


def _of_times(a: Any, times: Any, *_: Any, **__: Any) -> Any:
    return np.size(a) * np.prod(np.atleast_1d(times), dtype=float)


def _of_each(a: Any, repeats: Any, *_: Any, **__: Any) -> Any:
    return np.size(a) * np.max(repeats)


def _of_pairs(a: Any, b: Any, *_: Any, **__: Any) -> Any:
    return np.size(a) * np.size(b)


def _of_square(n: Any, m: Any = None, *_: Any, **__: Any) -> Any:
    return n * (n if m is None else m)


def _of_diagonal(v: Any, *_: Any, **__: Any) -> Any:
    return np.size(v) ** (3 - min(np.ndim(v), 2))


def _of_counts(x: Any, weights: Any = None, minlength: Any = 0) -> Any:
    return max(np.max(x, initial=0) + 1, minlength)


# How many numbers a function makes of its arguments.
SIZES: Mapping[str, Code] = {
    **dict.fromkeys(("zeros", "ones", "empty", "full", "indices"), _of_shape),
    **dict.fromkeys(RANGES[1:], _of_steps),
    **dict.fromkeys(("outer", "kron"), _of_pairs),
    **dict.fromkeys(("eye", "identity", "tri"), _of_square),
    **dict.fromkeys(("diag", "diagflat"), _of_diagonal),
    RANGES[0]: _of_range,
    "tile": _of_times,
    "repeat": _of_each,
    "bincount": _of_counts,
}


def numpy(steps: Steps) -> ModuleType:
    """Return NumPy with a guard before the routines that iterate, or that grow.

    Args:
        steps: of the function that uses it, which say how large its arrays may be.
    """
    linalg = ModuleType("numpy.linalg")
    vars(linalg).update(vars(np.linalg))
    for name in ITERATIVE:
        setattr(linalg, name, _guarded(getattr(np.linalg, name)))
    sized = {name: _sized(name, steps) for name in SIZES}
    guarded = ModuleType("numpy")
    vars(guarded).update({**vars(np), "linalg": linalg, **sized})
    return guarded
