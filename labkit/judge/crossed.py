"""Calls whose arguments are drawn one by one: at their ends, between them, mixed.

What is right for v between 0.3 and 1 may be so only because no short way was asked
with it. Here each argument takes its own low and high end, alone and together with the
others', and any value between.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np

AT_ENDS = 6  # calls with one argument at one of its ends
CORNERS = 32  # ways to have all at their ends, at most; each is asked twice
MIXED = 30  # with each argument anywhere between
SMALLER = 0.1  # of the lowest of a size: what is short enough may be shorter still
SEED = 47
Call = tuple[Any, ...]


def crossed(calls: Sequence[Call], k: int = -1) -> list[Call]:
    """Return calls with the arguments of others mixed, the same at every check.

    Args:
        calls: as asked, of the same shapes.
        k: an argument that stays as it is in one of them: it is set afterwards.
    """
    rng = np.random.default_rng(SEED)
    columns = list(zip(*calls, strict=True))
    free = [i for i, column in enumerate(columns) if i != k and _varies(column)]
    if not free:
        return []

    def drawn() -> list[Any]:
        call = list(calls[int(rng.integers(len(calls)))])
        for i in free:
            call[i] = _between(columns[i], rng)
        return call

    def found() -> Iterator[Call]:
        every = list(product(*(_ends(columns[i]) for i in free[:6])))
        for n in np.repeat(rng.permutation(len(every))[:CORNERS], 2):
            call = drawn()
            for i, end in zip(free, every[n], strict=False):
                call[i] = end  # what is beyond six arguments stays as drawn
            yield tuple(call)
        for i in free:
            for end in _ends(columns[i]):
                for _ in range(AT_ENDS):
                    call = drawn()
                    call[i] = end
                    yield tuple(call)
        for _ in range(MIXED):
            yield tuple(drawn())

    some = list(found())
    return [some[n] for n in rng.permutation(len(some))]


def _varies(column: Sequence[Any]) -> bool:
    first = column[0]
    if isinstance(first, bool) or not isinstance(first, float | np.ndarray):
        return False
    return any(not np.array_equal(x, first) for x in column)


def _ends(column: Sequence[Any]) -> list[Any]:
    """Return the least and the largest of an argument; of a positive one a smaller."""
    sizes = [x if isinstance(x, float) else float(np.linalg.norm(x)) for x in column]
    low, high = int(np.argmin(sizes)), int(np.argmax(sizes))
    ends = [column[low], column[high]]
    if isinstance(ends[0], float) and ends[0] > 0:
        ends.append(SMALLER * ends[0])
    return ends


def _between(column: Sequence[Any], rng: np.random.Generator) -> Any:
    """Return one of an argument's values, or a number anywhere between them."""
    one = column[int(rng.integers(len(column)))]
    if isinstance(one, float) and rng.random() < 1 / 2:
        return float(rng.uniform(min(column), max(column)))
    return one
