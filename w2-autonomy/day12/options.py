"""Two options at once: a planner, a cut or a motion made again in another way.

The judge tries pairs of named mistakes where they add up; here the same is done where
they are options of one function, which hardly ever add up.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from labkit.judge import Finding
from labkit.judge.answers import capitalised
from robo47.checks import Array

MATCHES = 1e-8


class Option(NamedTuple):
    """One way in which a function may differ."""

    slug: str
    says: str  # what it does, a clause
    how: Mapping[str, Any]  # the arguments that make it so
    alone: bool = False  # whether it is tried by itself only: pairs cost time


def together(
    options: Sequence[Option],
    make: Callable[..., Array],
    calls: Sequence[tuple[Any, ...]],
    mine: Sequence[Array],
) -> Finding | None:
    """Return the option, or the two, that give all of the student's arrays, or None.

    Args:
        options: what may differ.
        make: the function, from a call's arguments and an option's.
        calls: the arguments of all calls.
        mine: the student's answers, each in its own shape.
    """
    order = sorted(range(len(calls)), key=lambda k: sum(map(np.size, calls[k])))

    def gives(*some: Option) -> bool:
        how = {key: value for one in some for key, value in one.how.items()}
        return all(_same(make, calls[k], how, mine[k]) for k in order)

    alone = {one.says: one for one in options if gives(one)}
    if alone:
        some = list(alone.values())[:2]
        says = "; or: ".join(one.says for one in some)
        either = "Either: " if len(some) > 1 else ""
        text = f"{either}{says}. (That gives your arrays exactly.)"
        return Finding(some[0].slug, capitalised(text))
    for pair in _pairs(options):
        if gives(*pair):
            says = "; ".join(one.says for one in pair)
            how = "Both together give your arrays exactly."
            slug = "+".join(one.slug for one in pair)
            return Finding(slug, f"Two things at once: {says}. ({how})")
    return None


def _pairs(options: Sequence[Option]) -> Iterator[tuple[Option, Option]]:
    """Yield all pairs that are of different things."""
    for pair in combinations([one for one in options if not one.alone], 2):
        if not pair[0].how.keys() & pair[1].how.keys():
            yield pair


def _same(
    make: Callable[..., Array], call: tuple[Any, ...], how: dict[str, Any], mine: Array
) -> bool:
    try:
        with np.errstate(all="ignore"):
            again = np.asarray(make(*call, **how), dtype=np.float64)
    except (ValueError, IndexError, np.linalg.LinAlgError):
        return False
    return again.shape == mine.shape and np.allclose(
        again, mine, rtol=MATCHES, atol=MATCHES
    )
