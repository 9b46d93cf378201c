"""A limit for code that a mutation may keep busy for ever.

Loops count their steps and look at the clock, which needs no signal: a search runs in
threads and on Windows as well. LAPACK may not return from numbers that are not finite,
so these are refused before.
"""

import ast
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial, wraps
from types import ModuleType
from typing import Any

import numpy as np

STEP = "_step_"  # the name that a limited body calls
MOST = 1_000_000  # steps of a call of a right function
# A mutant may take so many times the steps and the time of the right function.
LEAST, TIMES = 100, 20
SECONDS = 0.02  # at least
GUARDED = ("lstsq", "svd", "eigh", "eigvalsh", "eig", "eigvals", "pinv", "matrix_rank")


class TooLongError(Exception):
    """A mutant takes more steps than any right function."""


@dataclass
class Steps:
    """The steps of one call."""

    most: int = MOST  # of one call
    left: int = MOST
    seconds: float = 60.0  # of one call
    ends: float = 0.0  # when a call has taken too long

    def __call__(self, some: Iterable[Any] = ()) -> Iterator[Any]:
        """Yield some things, and count them."""
        for one in some:
            self.count()
            yield one

    def count(self) -> None:
        """Count a step.

        Raises:
            TooLongError: it is one too many.
        """
        self.left -= 1
        if self.left < 0 or time.process_time() > self.ends:
            raise TooLongError

    def limiting(self, code: Callable[..., Any]) -> Callable[..., Any]:
        """Return a function whose calls begin to count anew."""

        @wraps(code)
        def call(*args: Any) -> Any:
            self.left = self.most
            self.ends = time.process_time() + self.seconds
            return code(*args)

        return call

    def calibrate(self, code: Callable[..., Any], call: Sequence[Any]) -> None:
        """Allow a mutant some times the steps that the right function takes."""
        self.most, began = MOST, time.process_time()
        with suppress(Exception):  # not all right bodies take what a lab's does
            code(*call)
            self.most = LEAST + TIMES * (MOST - self.left)
            self.seconds = SECONDS + TIMES * (time.process_time() - began)


def limited(function: ast.FunctionDef) -> list[Callable[[], None]]:
    """Have all loops of a function count their steps; return what undoes it."""
    undo: list[Callable[[], None]] = []
    for node in list(ast.walk(function)):
        if isinstance(node, ast.For | ast.comprehension):
            undo.append(partial(setattr, node, "iter", node.iter))
            counted = ast.Call(ast.Name(STEP, ast.Load()), [node.iter], [])
            node.iter = ast.fix_missing_locations(ast.copy_location(counted, node.iter))
        elif isinstance(node, ast.While):
            text = ast.parse(f"{STEP}.count()").body[0]
            undo.append(partial(setattr, node, "body", node.body))
            for inner in ast.walk(text):
                ast.copy_location(inner, node.body[0])
            node.body = [text, *node.body]
    return undo[::-1]  # a loop may stand there twice


def _guarded(real: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(real)
    def call(*args: Any, **options: Any) -> Any:
        arrays = [x for x in args if isinstance(x, np.ndarray) and x.dtype.kind == "f"]
        if not all(np.isfinite(x).all() for x in arrays):
            raise np.linalg.LinAlgError("not finite")
        return real(*args, **options)

    return call


def _numpy() -> ModuleType:
    """Return NumPy with a guard before the routines that iterate."""
    linalg = ModuleType("numpy.linalg")
    vars(linalg).update(vars(np.linalg))
    for name in GUARDED:
        setattr(linalg, name, _guarded(getattr(np.linalg, name)))
    guarded = ModuleType("numpy")
    vars(guarded).update({**vars(np), "linalg": linalg})
    return guarded


NUMPY = _numpy()
