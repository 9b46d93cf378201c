"""Calls of a case that are made of calls of other cases, which were answered wrongly.

A function that tests one disc alone is right for edges of length 0 until such an edge
meets discs at which another edge was answered wrongly. Fresh calls seldom have both.
Here a call takes some arguments from a call of the case and the others from another
call; or some entries of one vector; or it takes one argument twice, if calls of the
case have equal ones; or it is another call with the sizes of one of the case.
"""

from collections.abc import Iterator, Sequence
from itertools import permutations
from typing import Any

import numpy as np

from labkit.judge.resized import Axis, size_of, sizes_by_axis, with_size

TRIES = 600  # calls that are put together, of which some are of the case
# Of these the share that is resized alone, of the others the share with an argument
# twice, of the rest the share with a vector of both calls' entries, and of all others
# the share that is crossed without new sizes.
RESIZED, COPIED, MINGLED, CROSSED = 1 / 4, 1 / 3, 1 / 4, 1 / 2
SEED = 6151
Call = tuple[Any, ...]


def carried(
    calls: Sequence[Call], others: Sequence[Call], known: Sequence[Call]
) -> Iterator[Call]:
    """Yield calls that have arguments of both, the same at every check.

    Args:
        calls: of a case.
        others: which were answered wrongly.
        known: all calls; they show which sizes belong together.
    """
    n = len(calls[0]) if calls else 0
    calls, others, known = (
        [call for call in some if len(call) == n] for some in (calls, others, known)
    )
    if not n or not others:
        return
    rng = np.random.default_rng(SEED)
    groups = [*sizes_by_axis(known).values()]
    pairs = _equal(calls)
    for _ in range(TRIES):
        one, other = (some[int(rng.integers(len(some)))] for some in (calls, others))
        alike = _with_sizes_of(one, other, groups, rng)
        if rng.random() < RESIZED and alike is not other:
            call = alike
        elif pairs and rng.random() < COPIED:
            call = _copied(other, *pairs[int(rng.integers(len(pairs)))])
        elif (places := _vectors(one, alike)) and rng.random() < MINGLED:
            call = _mingled(one, alike, places[int(rng.integers(len(places)))], rng)
        elif n > 1:
            call = _crossed(one, other if rng.random() < CROSSED else alike, rng)
        else:
            continue
        if _fit(call, groups):
            yield call


def _with_sizes_of(
    one: Call, other: Call, groups: Sequence[Sequence[Axis]], rng: np.random.Generator
) -> Call:
    """Return another call with the sizes of one, or itself if it has them."""
    for axes in groups:
        if (size := size_of(one, axes)) != size_of(other, axes):
            other = with_size(other, axes, size, rng)
    return other


def _crossed(one: Call, other: Call, rng: np.random.Generator) -> Call:
    """Return a call with some arguments of one call and the others of another."""
    n = len(one)
    mask = int(rng.integers(1, 2**n - 1))
    return tuple(one[i] if mask >> i & 1 else other[i] for i in range(n))


def _vectors(one: Call, other: Call) -> list[int]:
    """Return which arguments are vectors of one size in both, and no unit vectors."""
    return [
        i
        for i, (x, y) in enumerate(zip(one, other, strict=True))
        if isinstance(x, np.ndarray)
        and isinstance(y, np.ndarray)
        and x.shape == y.shape
        and x.ndim == 1 < x.size
        and not all(np.isclose(np.linalg.norm(v), 1.0) for v in (x, y))
    ]


def _mingled(one: Call, other: Call, i: int, rng: np.random.Generator) -> Call:
    """Return a call with some entries of its i-th argument from another call."""
    n = len(one[i])
    kept = rng.permutation(n) < rng.integers(1, n)
    return (*one[:i], np.where(kept, one[i], other[i]), *one[i + 1 :])


def _equal(calls: Sequence[Call]) -> list[tuple[int, int]]:
    """Return which two arguments are equal in some call, and not 0: both ways."""
    return [
        (i, j)
        for i, j in permutations(range(len(calls[0])), 2)
        if any(_same(call[i], call[j]) for call in calls)
    ]


def _same(x: Any, y: Any) -> bool:
    plain = type(x) is type(y) and isinstance(x, float | np.ndarray)
    return plain and np.array_equal(x, y) and bool(np.any(x))


def _copied(call: Call, i: int, j: int) -> Call:
    """Return a call with argument j in the place of argument i, too."""
    value = call[j].copy() if isinstance(call[j], np.ndarray) else call[j]
    return (*call[:i], value, *call[i + 1 :])


def _fit(call: Call, groups: Sequence[Sequence[Axis]]) -> bool:
    """Return whether the axes that always have one size have it here too."""
    return all(len({call[i].shape[axis] for i, axis in axes}) == 1 for axes in groups)
