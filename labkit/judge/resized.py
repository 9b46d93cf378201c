"""Calls of another size: what is right for one key may be so for one query alone.

The calls of a case often have few sizes, or one, which the case does not ask for.
Axes that have the same size in every call belong together: the rows of the keys and
those of the values, say. They are resized together, with entries that a call has.
"""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

EACH = 2  # calls of a case that are given each other size
SIZES = 3  # other sizes of an axis, at most: small ones, and the largest
SEED = 4759
Axis = tuple[int, int]  # of which argument, and which of its axes
Call = tuple[Any, ...]


def sizes_by_axis(calls: Sequence[Call]) -> dict[tuple[int, ...], list[Axis]]:
    """Return the axes that all calls have, by their sizes in each call.

    Those of a key belong together. Axes that never vary are left out: a position has
    three entries.
    """
    found = [_axes(call) for call in calls]
    shared = set(found[0]).intersection(*found[1:]) if found else set()
    together: dict[tuple[int, ...], list[Axis]] = {}
    for axis in sorted(shared):
        together.setdefault(tuple(each[axis] for each in found), []).append(axis)
    return {sizes: axes for sizes, axes in together.items() if len(set(sizes)) > 1}


def resized(
    calls: Sequence[Call], known: Sequence[Call], twice: bool = True
) -> Iterator[Call]:
    """Yield some calls with a size that none of them has.

    Args:
        calls: of a case.
        known: all calls, of which calls are some.
        twice: whether an entry may be given twice; else sizes are smaller ones.
    """
    rng = np.random.default_rng(SEED)
    for sizes, axes in sizes_by_axis(known).items():
        of_case = {size_of(call, axes) for call in calls}
        others = sorted(set(sizes) - of_case)
        if not twice:
            others = [size for size in others if size < min(of_case)]
        for size in [*others[: SIZES - 1], *others[SIZES - 1 :][-1:]]:
            for at in rng.permutation(len(calls))[:EACH]:
                yield with_size(calls[at], axes, size, rng)


def size_of(call: Call, axes: Sequence[Axis]) -> int:
    """Return the size of some axes of a call that belong together."""
    argument, axis = axes[0]
    return int(call[argument].shape[axis])


def one_of_them(call: Call, axes: Sequence[Axis]) -> tuple[int, str]:
    """Return an argument that has some axes, one of numbers first, and a part of it."""
    k, axis = min(axes, key=lambda one: (np.ndim(call[one[0]]), one[1]))
    flat = np.ndim(call[k]) == 1
    return k, "entry" if flat else ("row", "column")[axis] if axis < 2 else "element"


def has_one(axes: Sequence[Axis], call: Call) -> bool:
    """Return whether some axes of a call have the size 1."""
    return size_of(call, axes) == 1


def with_one(axes: Sequence[Axis], call: Call) -> list[Call]:
    """Return calls with one entry of a call along its axes: the first, and the last."""
    n = size_of(call, axes)
    return [_taken(call, axes, np.array([at])) for at in {0, n - 1} if n > 0]


def _axes(call: Call) -> dict[Axis, int]:
    """Return the size of each axis of a call's arrays."""
    return {
        (i, axis): size
        for i, argument in enumerate(call)
        if isinstance(argument, np.ndarray)
        for axis, size in enumerate(argument.shape)
    }


def with_size(
    call: Call, axes: Sequence[Axis], size: int, rng: np.random.Generator
) -> Call:
    """Return a call with some entries along its axes, in their order; some twice."""
    i, axis = axes[0]
    whole, rest = divmod(size, max(1, call[i].shape[axis]))
    some = rng.permutation(call[i].shape[axis])[:rest]
    at = np.sort(np.append(np.tile(np.arange(call[i].shape[axis]), whole), some))
    return _taken(call, axes, at.astype(int))


def _taken(call: Call, axes: Sequence[Axis], at: NDArray[np.intp]) -> Call:
    """Return a call with the entries at some places along its axes."""
    changed = list(call)
    for i, axis in axes:
        changed[i] = np.take(changed[i], at, axis=axis)
    return tuple(changed)
