"""Two options at once: a planner, a cut or a motion made again in another way.

The judge tries pairs of named mistakes where they add up; here the same is done where
they are options of one function, which hardly ever add up.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from labkit.judge import Case, Finding
from labkit.judge.answers import capitalised
from labkit.judge.ask import as_plain
from labkit.judge.hypothesis import evidence
from labkit.judge.mistake import BOTH, both_told
from robo47.checks import Array

from .ways import without_filling

MATCHES = 1e-8
NEAR = 1e-7  # two answers, or two lengths, that are the same but for rounding


class Asked(NamedTuple):
    """One call: its arguments, the student's answer and the right one, in parts."""

    arguments: tuple[Any, ...]
    mine: tuple[Array, ...]
    right: tuple[Array, ...]

    def wrong(self, part: int = 0) -> bool:
        """Return whether a part of the answer is wrong."""
        with np.errstate(invalid="ignore"):
            off = np.abs(self.mine[part] - self.right[part])
        same = self.mine[part] == self.right[part]  # an infinity that is right
        return not bool(np.all((off <= NEAR) | same))

    def wrong_rows(self) -> bool:
        """Return whether an array of any number of rows is wrong."""
        a, b = (without_filling(x[0]) for x in (self.mine, self.right))
        return a.shape != b.shape or not np.allclose(a, b, rtol=0.0, atol=NEAR)


def calls(case: Case) -> list[Asked]:
    """Return all calls that have an answer, first those that are always asked."""
    found = list(_calls(case.arguments, case.S, case.T))
    if case.further:
        more = case.further
        found += _calls(more.arguments, more.S, more.T)
    return found


def _calls(arguments: Sequence[Any], S: Any, T: Any) -> Iterator[Asked]:
    mine, right = (x if isinstance(x, tuple) else (x,) for x in (S, T))
    n = len(mine[0])
    columns = [c if isinstance(c, np.ndarray) else [c] * n for c in arguments]
    for args, s, t in zip(
        zip(*columns, strict=True),
        zip(*mine, strict=True),
        zip(*right, strict=True),
        strict=True,
    ):
        yield Asked(tuple(map(as_plain, args)), s, t)


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
    usual = partial(_made, make, how={})
    first = next((k for k in order if not _same(usual(calls[k]), mine[k])), order[0])
    order.sort(key=lambda k: k != first)

    def gives(*some: Option) -> bool:
        how = {key: value for one in some for key, value in one.how.items()}
        return all(_same(_made(make, calls[k], how), mine[k]) for k in order)

    alone = {one.says: one for one in options if gives(one)}
    if alone:
        some = list(alone.values())[:2]
        says = some[0].says
        if len(some) > 1:
            says = "each of two mistakes would explain your result. The first "
            says += f"possibility: {some[0].says}. "
            says += f"The second possibility: {some[1].says}"
        this = "either" if len(some) > 1 else "this"
        how = f"The reference solution with {this} mistake "
        how += "gives the same output as your code."
        text = f"{says}. {how}"
        return Finding(some[0].slug, capitalised(text))
    right = usual(calls[first])
    each = {id(one): _made(make, calls[first], one.how) for one in options}
    shows = {k for k, answer in each.items() if not _same(answer, right)}
    nearly = {k for k, answer in each.items() if _same(answer, mine[first])}
    for pair in _pairs(options):
        # What changes nothing in this call needs another that explains it alone.
        if not ({*map(id, pair)} <= shows or nearly & {*map(id, pair)}):
            continue
        if gives(*pair):
            how = f"{capitalised(BOTH)} {evidence(True)}."
            slug = "+".join(one.slug for one in pair)
            return Finding(slug, f"{both_told(*(one.says for one in pair))} {how}")
    return None


def _pairs(options: Sequence[Option]) -> Iterator[tuple[Option, Option]]:
    """Yield all pairs that are of different things."""
    for pair in combinations([one for one in options if not one.alone], 2):
        if not pair[0].how.keys() & pair[1].how.keys():
            yield pair


def _made(
    make: Callable[..., Array], call: tuple[Any, ...], how: Mapping[str, Any]
) -> Array | None:
    """Return the answer to a call with some options, None where there is none."""
    try:
        with np.errstate(all="ignore"):
            return np.asarray(make(*call, **how), dtype=np.float64)
    except (ValueError, IndexError, np.linalg.LinAlgError):
        return None


def _same(again: Array | None, mine: Array | None) -> bool:
    """Return whether two answers are the same; None equals no answer."""
    if again is None or mine is None or again.shape != mine.shape:
        return False
    return np.allclose(again, mine, rtol=MATCHES, atol=MATCHES)
