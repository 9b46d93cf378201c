"""What a slip does to arguments, or to a finished answer: a sign, a swap, a transpose.

Many a named mistake is one of these: "the damper drives the hand on" is the right
answer with -V_err. Whether it is one is found by trying it, and what is made with an
argument can be made together with any other mistake.
"""

from collections.abc import Callable, Iterator
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np

from labkit.judge.answers import own, rigid
from labkit.judge.matrices import rigid_inverse
from robo47.checks import Array

Call = tuple[Any, ...]  # the arguments of one question
SHARED = 3  # entries that two arguments have in common, one for each joint, say


def of_arguments(call: Call) -> Iterator[Callable[..., Call]]:
    """Yield changes of a call's arguments, each a function of all of them."""
    for k, x in enumerate(call):
        for change in _of_one(x):
            yield partial(_at, k, change)
    for k, m in combinations(range(len(call)), 2):
        if _number(call[k]) and _number(call[m]) and _shape(call[k]) == _shape(call[m]):
            yield partial(_exchanged, k, m)
    lengths = [len(x) for x in call if isinstance(x, np.ndarray) and x.ndim]
    for n in sorted({n for n in lengths if n >= SHARED and lengths.count(n) > 1}):
        yield partial(_backwards, n)


def of_answer(answer: Array) -> Iterator[Callable[[Array], Array]]:
    """Yield changes of a finished answer; they take all answers, (n, ...)."""
    yield np.negative
    yield _doubled
    yield _halved
    if answer.ndim and len(answer) > 1:
        yield partial(np.flip, axis=1)
    if answer.ndim == 1 and len(answer) == 6:
        yield partial(np.roll, shift=3, axis=-1)
    if answer.ndim == 2 and answer.shape[0] == answer.shape[1]:
        yield np.matrix_transpose


def _of_one(x: Any) -> Iterator[Callable[[Any], Any]]:
    if not _number(x):
        return
    yield np.negative
    yield np.zeros_like
    yield _doubled
    yield _halved
    shape = _shape(x)
    if len(shape) > 1 and shape[-1] == shape[-2]:
        yield np.matrix_transpose
        if shape[-1] == 4 and rigid(x.reshape(-1, 4, 4)):
            yield rigid_inverse
    if shape == (6,):
        yield partial(np.roll, shift=3)
    if shape and shape[0] >= SHARED:
        yield partial(np.flip, axis=0)


def _number(x: Any) -> bool:
    """Return whether x is a number, or an array of such, that has a sign."""
    if isinstance(x, np.ndarray):
        return x.dtype.kind == "f" and x.size > 0
    return isinstance(x, float)


def _shape(x: Any) -> tuple[int, ...]:
    return np.shape(x)


def _doubled(x: Any) -> Any:
    return 2.0 * x


def _halved(x: Any) -> Any:
    return 0.5 * x


def _at(k: int, change: Callable[[Any], Any], *call: Any) -> Call:
    return (*call[:k], change(own(call[k])), *call[k + 1 :])


def _exchanged(k: int, m: int, *call: Any) -> Call:
    new = list(call)
    new[k] = call[m]
    new[m] = call[k]
    return tuple(new)


def _backwards(n: int, *call: Any) -> Call:
    """Return a call with every argument that has n entries read from its end."""
    return tuple(
        x[::-1] if isinstance(x, np.ndarray) and x.ndim and len(x) == n else x
        for x in call
    )
