"""What is said of a function that is right at ordinary inputs alone.

The calls that are not right show which inputs are meant, if all of them have one
argument that is clearly smaller, or larger, than in every call that is always asked, or
a matrix whose condition number is clearly larger. A call that is right refutes it.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from labkit.base.exchange import Exchange
from labkit.judge.ask import as_plain

CLEARLY = 3.0  # times smaller or larger; the entries of a rotation never differ so much
ANY = "inputs that are very small, very large or exactly at a limit"
Range = tuple[float, float]
Unusual = tuple[int, str]  # which argument, and whether it is "small" or "large"
CONDITION = "a large condition number"
GUARD = "Does a guard, a clamp or a tolerance in your code affect the result for these"
DIGITS = "Does your code lose digits, or stop an iteration too early, for these"


def beyond(
    failing: Sequence[Exchange] = (),
    usual: Sequence[Exchange] = (),
    names: Sequence[str] = (),
) -> str:
    """Return where a function is wrong that is right at ordinary inputs.

    Args:
        failing: calls that are not right.
        usual: those that are always asked, and others that are right.
        names: of the arguments.
    """
    inputs, these = _in_common(failing, usual, names) or (ANY, "inputs")
    asks = DIGITS if these == "matrices" else GUARD
    return (
        f"Your function is correct for ordinary inputs, but it is wrong for {inputs}. "
        f"Such {these} occur in the lab or in a later task. {asks} {these}?"
    )


def _in_common(
    failing: Sequence[Exchange], usual: Sequence[Exchange], names: Sequence[str]
) -> tuple[str, str] | None:
    """Return which inputs all failing calls have, and what to call them; or None."""
    sizes = _all_unusual(failing, usual, size_of)
    conditions = _of_conditions(failing, usual)
    # A pose that is far away has a large condition number because its entries are.
    found = {one or other for one, other in zip(sizes, conditions, strict=True)}
    if len(found) != 1 or len(only := found.pop()) != 1:
        return None
    ((k, how),) = only
    if how == CONDITION:
        return f"matrices `{names[k]}` with {CONDITION}", "matrices"
    these = "entries" if np.ndim(as_plain(failing[0].question.args[k])) else "values"
    return f"very {how} {these} of `{names[k]}`", these


def _all_unusual(
    failing: Sequence[Exchange], usual: Sequence[Exchange], size: Callable[[Any], float]
) -> Iterator[tuple[Unusual, ...]]:
    """Yield of each failing call which arguments have an unusual size."""
    ranges = [*map(_range, _columns(usual, size))]
    yield from (tuple(_unusual(one, ranges)) for one in _rows(failing, size))


def _of_conditions(
    failing: Sequence[Exchange], usual: Sequence[Exchange]
) -> Iterator[tuple[Unusual, ...]]:
    """Yield of each failing call which matrices have a larger condition number."""
    for some in _all_unusual(failing, usual, condition_of):
        yield tuple((k, CONDITION) for k, how in some if how == "large")


def _unusual(sizes: Sequence[float], ranges: Sequence[Range]) -> Iterator[Unusual]:
    """Yield each argument of a call that is outside its range, and on which side."""
    for k, (size, (least, most)) in enumerate(zip(sizes, ranges, strict=False)):
        if size > CLEARLY * most > 0.0:
            yield k, "large"
        elif 0.0 < CLEARLY * size < least:
            yield k, "small"


def _rows(calls: Sequence[Exchange], size: Callable[[Any], float]) -> list[list[float]]:
    return [[*map(size, map(as_plain, one.question.args))] for one in calls]


def _columns(
    calls: Sequence[Exchange], size: Callable[[Any], float]
) -> list[tuple[float, ...]]:
    return [*zip(*_rows(calls, size), strict=False)]


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


def condition_of(value: Any) -> float:
    """Return the condition number of a square matrix; 0 of others."""
    shape = np.shape(value)
    if len(shape) != 2 or shape[0] != shape[1] or not size_of(value):
        return 0.0
    found = float(np.linalg.cond(value))
    return found if np.isfinite(found) else 0.0
