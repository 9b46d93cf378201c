"""Ranges in which a function is right: of a number, of the sizes of a vector's entries.

They are read from what was asked and how it was answered; `right_when` tries them.
"""

from collections.abc import Callable, Iterator, Sequence, Set
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from labkit.judge.typed import number
from robo47.checks import Array

BEFORE_AND_AFTER = 1e-3  # how near the ends of a range it is asked
LEAST = 3  # right answers in a range
SMALL = 0.2  # of a usual entry: a limit below which an entry is taken for 0
End = tuple[float, bool]  # of a range, and whether it is in the range
BEYOND = 20.0  # how much larger than the least entry that is asked


@dataclass(frozen=True)
class Span:
    """One range of an argument."""

    says: str  # "for `0 <= {} < pi`"
    holds: Callable[[Any], bool]  # whether a value of the argument is in it
    # From values of the argument, any, to values in the range, near its ends as well.
    values: Callable[[Sequence[Any]], list[Any]]


def spans(x: Any, asked: Sequence[Any], right: Sequence[bool]) -> Iterator[Span]:
    """Yield the ranges of an argument in which all answers are right.

    Args:
        x: one of its values.
        asked: all that it was.
        right: of each whether the answer was right.
    """
    if isinstance(x, float):
        between = _range(asked, right)
        sizes = [abs(one) for one in asked]
        beyond = _range(sizes, right)
        if beyond and beyond[1] == max(sizes) and 0.0 < beyond[0] < SMALL * beyond[1]:
            says = f"whenever `{{}}` has a magnitude of {number(beyond[0])} or more"
            yield Span(says, partial(_above, beyond[0]), partial(_beyond, *beyond))
        elif between:
            wrong = {x for x, ok in zip(asked, right, strict=True) if not ok}
            yield _between(*between, set(asked) - wrong)
        return
    if not isinstance(x, np.ndarray) or x.ndim != 1 or x.dtype.kind != "f":
        return
    if len({np.shape(one) for one in asked}) > 1 or len(x) < 2:
        return
    least = [float(np.abs(one).min()) for one in asked]
    if (between := _range(least, right)) and max(least) == between[1]:
        low = between[0]
        usual = float(np.median(np.abs(np.concatenate(list(asked)))))
        if min(least) < low <= SMALL * usual:
            says = "whenever every entry of `{}` has a magnitude of "
            says += f"{number(low)} or more"
            yield Span(says, partial(_above, low), partial(_lifted, low))


def _between(low: float, high: float, right: Set[float]) -> Span:
    """Return a range of a number; it contains an end that was answered rightly."""
    ends = (low, low in right), (high, high in right)
    left, last = ("<=" if there else "<" for _, there in ends)
    return Span(
        f"for `{number(low)} {left} {{}} {last} {number(high)}`",
        partial(_inside, *ends),
        partial(_up_to, *ends),
    )


def _inside(low: End, high: End, x: float) -> bool:
    return low[0] < x < high[0] or (x, True) in (low, high)


def _beyond(low: float, high: float, some: Sequence[float]) -> list[float]:
    sizes = np.geomspace(low, high, len(some))
    return [float(x) * (-1.0) ** i for i, x in enumerate(sizes)]


def _above(low: float, x: Any) -> bool:
    return bool((np.abs(x) >= low).all())


def _up_to(low: End, high: End, some: Sequence[float]) -> list[float]:
    tiny = BEFORE_AND_AFTER * (high[0] - low[0])
    inside = np.linspace(low[0], high[0], len(some))[1:-1]
    ends = low[0] + tiny * (not low[1]), high[0] - tiny * (not high[1])
    return [*ends, *map(float, inside)]


def _lifted(low: float, some: Sequence[Array]) -> list[Array]:
    """Return vectors without an entry that is smaller; many of them just reach it."""
    sizes = np.geomspace(1.0, BEYOND, len(some))
    signs = [np.where(x < 0, -1.0, 1.0) for x in some]
    pairs = zip(signs, some, sizes, strict=True)
    return [s * np.maximum(np.abs(x), low * size) for s, x, size in pairs]


def _range(
    values: Sequence[float], right: Sequence[bool]
) -> tuple[float, float] | None:
    """Return the range of a number in which all answers are right, or None.

    It ends at a fraction of pi, or a whole number, where one lies between what was
    right and what was wrong. None where nothing is wrong beyond it, or where under
    three values in it, or a fifth of all, were asked.
    """
    if len(values) != len(right) or not all(isinstance(x, float) for x in values):
        return None
    wrong = sorted({x for x, ok in zip(values, right, strict=True) if not ok})
    good = sorted({x for x, ok in zip(values, right, strict=True) if ok} - set(wrong))
    bounds = [-np.inf, *wrong, np.inf]
    runs = [
        ([x for x in good if low < x < high], low, high)
        for low, high in pairwise(bounds)
    ]
    run, low, high = max(runs, key=lambda one: len(one[0]))
    if len(run) < max(LEAST, len(good) // 5) or run[0] == run[-1] or not wrong:
        return None
    return _end(run[0], low), _end(run[-1], high)


def _end(last: float, beyond: float) -> float:
    """Return a number that people know from the last right one to a wrong one."""
    if not np.isfinite(beyond):
        return last
    low, high = sorted((last, beyond))
    decades = 10.0 ** np.arange(-6.0, 3.0)
    halves = np.arange(-12.0, 13.0) / 2
    for known in (np.pi * np.arange(-12, 13) / 6, halves, decades):
        between = [float(x) for x in known if low <= x <= high]
        if between:
            return min(between, key=lambda x: abs(x - last))
    return last
