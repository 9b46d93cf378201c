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
    for some in _sets(options):
        how = {key: value for one in some for key, value in one.how.items()}
        if all(_same(make, calls[k], how, mine[k]) for k in order):
            says = "; ".join(one.says for one in some)
            what = "Two things at once: " if len(some) > 1 else ""
            both = "both together give" if len(some) > 1 else "that gives"
            text = f"{what}{says}. ({both[0].upper()}{both[1:]} your arrays exactly.)"
            slug = "+".join(one.slug for one in some)
            return Finding(slug, capitalised(text))
    return None


def _sets(options: Sequence[Option]) -> Iterator[tuple[Option, ...]]:
    """Yield each option, then all pairs that are of different things."""
    yield from ((one,) for one in options)
    for pair in combinations(options, 2):
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
