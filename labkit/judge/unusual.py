"""What is said of a function that is right at ordinary inputs alone.

The calls that are not right show which inputs are meant, if all of them have one
argument that is clearly smaller, or larger, than in every call that is always asked.
"""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from labkit.base.exchange import Exchange
from labkit.judge.ask import as_plain

CLEARLY = 3.0  # times smaller or larger; the entries of a rotation never differ so much
ANY = "inputs that are very small, very large or exactly at a limit"
Range = tuple[float, float]
Unusual = tuple[int, str]  # which argument, and whether it is "small" or "large"


def beyond(
    failing: Sequence[Exchange] = (),
    usual: Sequence[Exchange] = (),
    names: Sequence[str] = (),
) -> str:
    """Return where a function is wrong that is right at ordinary inputs.

    Args:
        failing: calls that are not right.
        usual: those that are always asked.
        names: of the arguments.
    """
    inputs, these = _in_common(failing, usual, names) or (ANY, "inputs")
    return (
        f"Your function is correct for ordinary inputs, but it is wrong for {inputs}. "
        f"Such {these} occur in the lab or in a later task. Does a guard, a clamp or a "
        f"tolerance in your code affect the result for these {these}?"
    )


def _in_common(
    failing: Sequence[Exchange], usual: Sequence[Exchange], names: Sequence[str]
) -> tuple[str, str] | None:
    """Return which inputs all failing calls have, and what to call them; or None."""
    ranges = [*map(_range, _columns(usual))]
    found = {tuple(_unusual(one, ranges)) for one in _rows(failing)}
    if len(found) != 1 or len(only := found.pop()) != 1:
        return None
    ((k, how),) = only
    these = "entries" if np.ndim(as_plain(failing[0].question.args[k])) else "values"
    return f"very {how} {these} of `{names[k]}`", these


def _unusual(sizes: Sequence[float], ranges: Sequence[Range]) -> Iterator[Unusual]:
    """Yield each argument of a call that is outside its range, and on which side."""
    for k, (size, (least, most)) in enumerate(zip(sizes, ranges, strict=False)):
        if size > CLEARLY * most > 0.0:
            yield k, "large"
        elif 0.0 < CLEARLY * size < least:
            yield k, "small"


def _rows(calls: Sequence[Exchange]) -> list[list[float]]:
    return [[*map(size_of, map(as_plain, one.question.args))] for one in calls]


def _columns(calls: Sequence[Exchange]) -> list[tuple[float, ...]]:
    return [*zip(*_rows(calls), strict=False)]


def _range(sizes: Sequence[float]) -> Range:
    """Return the smallest and the largest of the sizes that are not 0; 0 of none."""
    some = [size for size in sizes if size] or [0.0]
    return min(some), max(some)


def size_of(value: Any) -> float:
    """Return the size of a number, or of an array's largest entry; 0 of others."""
    if not isinstance(value, int | float | np.ndarray | np.number):
        return 0.0
    some = np.asarray(value)
    if some.dtype.kind not in "fiu" or not some.size or not np.isfinite(some).all():
        return 0.0
    return float(np.abs(some).max())
