"""What a slip does to arguments, or to a finished answer: a sign, a swap, a transpose.

Many a named mistake is one of these: "the damper drives the hand on" is the right
answer with -V_err. Whether it is one is found by trying it, and what is made with an
argument can be made together with any other mistake.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from labkit.judge.answers import listed, own, rigid
from labkit.judge.matrices import rigid_inverse
from robo47.checks import Array

Call = tuple[Any, ...]  # the arguments of one question
FEW = 16  # numbers of a call, up to which any two entries of a vector are exchanged
SHARED = 3  # entries that two arguments have in common, one for each joint, say


class Move(NamedTuple):
    """A change of a call's arguments."""

    slug: str  # "exchanged"
    says: str  # what they are then, "qd and qdd exchanged"
    change: Callable[..., Call]  # a function of all of them


def of_arguments(call: Call, names: Sequence[str]) -> Iterator[Move]:
    """Yield changes of a call's arguments, which have names."""
    for k, x in enumerate(call):
        for slug, says, change in _of_one(x):
            yield Move(slug, says.format(names[k]), partial(_at, k, change))
    for k, m in combinations(range(len(call)), 2):
        if _number(call[k]) and _number(call[m]) and _shape(call[k]) == _shape(call[m]):
            says = f"{names[k]} and {names[m]} exchanged"
            yield Move("exchanged", says, partial(_exchanged, k, m))
    if sum(map(np.size, call)) <= FEW:
        for k, x in enumerate(call):
            yield from _entries_exchanged(k, x, names[k])
    lengths = [len(x) for x in call if isinstance(x, np.ndarray) and x.ndim]
    for n in sorted({n for n in lengths if n >= SHARED and lengths.count(n) > 1}):
        alike = [f"{name}" for name, x in zip(names, call, strict=True) if _long(x, n)]
        says = f"{listed(alike)} read from the end"
        yield Move("backwards", says, partial(_backwards, n))


def _entries_exchanged(k: int, x: Any, name: str) -> Iterator[Move]:
    if not (_number(x) and len(_shape(x)) == 1):
        return
    for i, j in combinations(range(len(x)), 2):
        says = f"{name}[{i}] and {name}[{j}] exchanged"
        change = partial(_at, k, partial(_swapped, i, j))
        yield Move("entries-exchanged", says, change)


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


def _of_one(x: Any) -> Iterator[tuple[str, str, Callable[[Any], Any]]]:
    if not _number(x):
        return
    yield "sign", "-{0} for {0}", np.negative
    yield "left-out", "0 for {0}", np.zeros_like
    yield "doubled", "2 {0} for {0}", _doubled
    yield "halved", "{0} / 2 for {0}", _halved
    shape = _shape(x)
    if len(shape) > 1 and shape[-1] == shape[-2]:
        yield "transposed", "{0} transposed", np.matrix_transpose
        if shape[-1] == 4 and rigid(x.reshape(-1, 4, 4)):
            yield "inverted", "{0} inverted", rigid_inverse
    if shape == (6,):
        yield "halves-exchanged", "the halves of {0} exchanged", _halves_exchanged
    if shape and shape[0] >= SHARED:
        yield "backwards", "{0} read from its end", partial(np.flip, axis=0)


def _number(x: Any) -> bool:
    """Return whether x is a number, or an array of such, that has a sign."""
    if isinstance(x, np.ndarray):
        return x.dtype.kind == "f" and x.size > 0
    return isinstance(x, float)


def _shape(x: Any) -> tuple[int, ...]:
    return np.shape(x)


def _long(x: Any, n: int) -> bool:
    return isinstance(x, np.ndarray) and x.ndim > 0 and len(x) == n


def _swapped(i: int, j: int, x: Array) -> Array:
    found = x.copy()
    found[[i, j]] = x[[j, i]]
    return found


def _halves_exchanged(x: Array) -> Array:
    return np.roll(x, 3)


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
    return tuple(x[::-1] if _long(x, n) else x for x in call)
