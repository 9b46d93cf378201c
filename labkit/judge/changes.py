"""Changes of one argument, or of a finished answer: a sign, an order, a unit.

Many a mistake is one of these: "the damper drives the hand on" is the right answer with
-V_err. Whether it is one is found by trying it, and a change of an argument can be made
together with any other mistake.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from labkit.base.text import count
from labkit.judge.answers import listed, own, rigid
from labkit.judge.matrices import rigid_inverse
from robo47.checks import Array

Call = tuple[Any, ...]  # the arguments of one question
FEW = 16  # numbers of a call, up to which any two entries of a vector are swapped
SHARED = 3  # entries that two arguments have in common, one for each joint, say
# Slugs of changes that are no question of size: they may explain all but the digits.
LIKELY = {"sign", "left-out", "doubled", "halved", "transposed", "inverted",
          "halves-exchanged", "backwards", "exchanged",
          "entries-exchanged"}  # fmt: skip
OF_UNITS = {"thousandths", "thousands"}  # as an output in another unit has them, too
# A matrix is symmetric as a rule, and then a student may have used either side.
ON_ONE_SIDE = "on one side of the diagonal"
CONSTANTS = (0.0, 1.0, 9.8, 9.80665, 9.81, 1.645, 1.96, 0.5, 2.0, 1e-3, 1e-6)


class Change(NamedTuple):
    """A change of a call's arguments."""

    slug: str  # "exchanged"
    # What follows "Your code ": "acts as if `qd` and `qdd` were swapped".
    says: str
    change: Callable[..., Call]  # a function of all of them


def likely(call: Call, names: Sequence[str]) -> Iterator[Change]:
    """Yield the changes of a call's arguments that are made most often.

    Args:
        call: one call, which says what an argument may be changed into.
        names: of the arguments; without them they are counted.
    """
    call, names = tuple(map(own, call)), _named(call, names)
    for k, x in enumerate(call):
        yield from _made(k, names[k], _near(x))
    for k, m in combinations(range(len(call)), 2):
        if _number(call[k]) and _number(call[m]) and _shape(call[k]) == _shape(call[m]):
            says = f"acts as if `{names[k]}` and `{names[m]}` were swapped"
            yield Change("exchanged", says, partial(_exchanged, k, m))
    if sum(map(np.size, call)) <= FEW:
        for k, x in enumerate(call):
            yield from _made(k, names[k], _entries_exchanged(x))
    lengths = [len(x) for x in call if isinstance(x, np.ndarray) and x.ndim]
    for n in sorted({n for n in lengths if n >= SHARED and lengths.count(n) > 1}):
        alike = [
            f"`{name}`" for name, x in zip(names, call, strict=True) if _long(x, n)
        ]
        says = f"acts as if {listed(alike)} were each in reverse order"
        if any(np.ndim(x) > 1 and _long(x, n) for x in call):
            says += " along the first axis"
        yield Change("backwards", says, partial(_backwards, n))


def others(call: Call, names: Sequence[str]) -> Iterator[Change]:
    """Yield other changes; the arguments are those of `likely`."""
    names = _named(call, names)
    for k, x in enumerate(call):
        yield from _made(k, names[k], _far(own(x)))


def _named(call: Call, names: Sequence[str]) -> Sequence[str]:
    if len(names) >= len(call) > 0:
        return names[: len(call)]  # the others have defaults, and were not given
    return [f"argument {k + 1}" for k in range(len(call))]


def of_answer() -> Iterator[tuple[str, Callable[[Array], Any]]]:
    """Yield changes of finished answers, (n, ...), each as a noun: "the square of {}".

    A factor and a sign are none of them: their kind tells these with what they are.
    """
    yield "the absolute value of {}", np.abs
    yield "the square of {}", np.square
    yield "the square root of {}", np.sqrt
    yield "the reciprocal of {}", lambda T: 1.0 / T
    yield "1 minus {}", lambda T: 1.0 - T
    yield "{} with 0 in place of negative values", lambda T: np.maximum(T, 0.0)
    yield "{} clamped to [0, 1]", lambda T: np.clip(T, 0.0, 1.0)
    yield "{} clamped to [-1, 1]", lambda T: np.clip(T, -1.0, 1.0)
    for decimals in range(4):
        rounded = partial(np.round, decimals=decimals)
        yield f"{{}} rounded to {count(decimals, 'decimal')}", rounded
    yield "{} rounded down", np.floor
    yield "{} rounded up", np.ceil
    yield "{} divided by its norm", _normalised
    yield "{} in reverse order", partial(np.flip, axis=1)
    yield "{} shifted by one entry", partial(np.roll, shift=1, axis=1)
    yield "{} shifted by one entry", partial(np.roll, shift=-1, axis=1)
    yield "{} with its halves swapped", partial(_rolled, axis=1)
    yield "{} with its halves swapped", partial(_rolled, axis=-1)
    yield "the transpose of {}", np.matrix_transpose
    yield "the diagonal of {} alone", lambda T: T * np.eye(T.shape[-1])
    yield "the upper triangle of {} alone", np.triu
    yield "the lower triangle of {} alone", np.tril
    yield "the inverse of {}", np.linalg.inv
    yield "the cumulative sum of {}", partial(np.cumsum, axis=1)
    yield "{} with its columns in reverse order", partial(np.flip, axis=-1)


def simple(answer: Array) -> Iterator[Callable[[Array], Array]]:
    """Yield changes of a finished answer that may follow another mistake."""
    yield np.negative
    yield partial(np.multiply, 2.0)
    yield partial(np.multiply, 0.5)
    if answer.ndim and len(answer) > 1:
        yield partial(np.flip, axis=1)
    if answer.ndim == 1 and len(answer) == 6:
        yield partial(np.roll, shift=3, axis=-1)
    if answer.ndim == 2 and answer.shape[0] == answer.shape[1]:
        yield np.matrix_transpose


Made = Iterator[tuple[str, str, Callable[[Any], Any]]]


def _made(k: int, name: str, some: Made) -> Iterator[Change]:
    for slug, says, change in some:
        does = f"acts as if {says}".format(name)
        yield Change(slug, does, partial(_at, k, change))


def _near(x: Any) -> Made:
    if not _number(x):
        return
    yield "sign", "`{0}` had the opposite sign", np.negative
    yield "left-out", "`{0}` were 0", np.zeros_like
    yield "doubled", "`{0}` were twice as large", partial(np.multiply, 2.0)
    yield "halved", "`{0}` were half as large", partial(np.multiply, 0.5)
    shape = _shape(x)
    if len(shape) > 1 and shape[-1] == shape[-2]:
        yield "transposed", "`{0}` were transposed", np.matrix_transpose
        if shape[-1] == 4 and rigid(x.reshape(-1, 4, 4)):
            yield "inverted", "`{0}` were replaced with its inverse", rigid_inverse
    if shape == (6,):
        yield "halves-exchanged", "the halves of `{0}` were swapped", _rolled
    if shape and shape[0] >= SHARED:
        yield "backwards", _reversed(shape, "rows", "first"), partial(np.flip, axis=0)


def _entries_exchanged(x: Any) -> Made:
    if not (_number(x) and len(_shape(x)) == 1):
        return
    for i, j in combinations(range(len(x)), 2):
        says = f"`{{0}}[{i}]` and `{{0}}[{j}]` were swapped"
        yield "entries-exchanged", says, partial(_swapped, i, j)


def _far(x: Any) -> Made:
    """Yield changes of an argument that are made more seldom."""
    if isinstance(x, int | np.integer) and not isinstance(x, bool):
        yield "one-more", "`{0}` were larger by 1", lambda n: n + 1
        yield "one-less", "`{0}` were smaller by 1", lambda n: n - 1
    if not _number(x):
        return
    each = "every entry of `{0}`" if _shape(x) else "`{0}`"
    yield "ones", f"{each} were 1", np.ones_like
    yield "sign-lost", f"{each} were replaced with its absolute value", np.abs
    yield "degrees", "`{0}` had been converted to degrees", np.rad2deg
    yield "radians", "`{0}` had been converted from degrees to radians", np.deg2rad
    yield "squared", f"{each} were replaced with its square", np.square
    yield "root", f"{each} were replaced with its square root", np.sqrt
    yield "reciprocal", f"{each} were replaced with its reciprocal", lambda x: 1.0 / x
    yield "thousandths", "`{0}` were 1000 times as large", partial(np.multiply, 1000.0)
    yield "thousands", "`{0}` were divided by 1000", partial(np.multiply, 1e-3)
    yield (
        "clamped",
        f"{each} were clamped to [-1, 1]",
        partial(np.clip, a_min=-1, a_max=1),
    )
    yield (
        "clamped",
        f"{each} were clamped to [0, 1]",
        partial(np.clip, a_min=0, a_max=1),
    )
    yield "clamped", "negative values of `{0}` were 0", lambda x: np.maximum(x, 0.0)
    yield "whole", f"{each} were truncated to a whole number", np.trunc
    yield "rounded", f"{each} were rounded to a whole number", np.round
    for decimals in range(1, 4):
        says = f"{each} were rounded to {count(decimals, 'decimal')}"
        yield "rounded", says, partial(np.round, decimals=decimals)
    for small in (1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1):
        says = f"values of `{{0}}` between {-small:g} and {small:g} were 0"
        yield "small", says, partial(_without_small, small)
    if not _shape(x):
        for value in CONSTANTS:
            yield (
                "constant",
                f"`{{0}}` were {value:g}",
                partial(_constant, value),
            )
    else:
        yield from _far_of_array(x)


_ENTRIES = {1: ("entry", "entries"), 2: ("row", "rows")}  # by the number of axes


def _reversed(shape: tuple[int, ...], lines: str, axis: str) -> str:
    """Return that an array is in reverse order, and along which axis."""
    if len(shape) == 1:
        return "`{0}` were in reverse order"
    if len(shape) == 2:
        return f"the {lines} of `{{0}}` were in reverse order"
    return f"`{{0}}` were in reverse order along its {axis} axis"


def _far_of_array(x: Array) -> Made:
    shape = _shape(x)
    yield "normalised", "`{0}` were divided by its norm", _unit
    entry, entries = _ENTRIES.get(len(shape), ("element", "elements"))
    every = f"every {entry} of `{{0}}` were"
    yield "first-for-all", f"{every} the first {entry}", _first
    yield "last-for-all", f"{every} the last {entry}", _last
    yield "mean", f"{every} the mean of all {entries}", _mean
    yield "sorted", "`{0}` were sorted", partial(np.sort, axis=0)
    yield (
        "summed-up",
        "`{0}` were replaced with its cumulative sum",
        partial(np.cumsum, axis=0),
    )
    if shape[0] > 1:
        for end, where in ((slice(-1), "last"), (slice(1, None), "first")):
            missing = partial(_only, end)
            yield (
                "entry-missing",
                f"the {where} {entry} of `{{0}}` were 0",
                missing,
            )
            says = f"the {where} {entry} of `{{0}}` were missing"
            yield "entry-missing", says, partial(_cut, end)
        for some, where in ((slice(1), "first"), (slice(-1, None), "last")):
            says = f"all {entries} of `{{0}}` except the {where} were 0"
            yield f"{where}-only", says, partial(_only, some)
        for by in (1, -1):
            says = f"the {entries} of `{{0}}` were shifted by one position"
            yield "shifted", says, partial(np.roll, shift=by, axis=0)
            yield "shifted", says, partial(_shifted, by)
    if shape == (3,):
        yield "downwards", "`{0}` were (0, 0, -|{0}|)", _downwards
        yield (
            "constant",
            "`{0}` were (0, 0, -9.81)",
            partial(_constant, (0, 0, -9.81)),
        )
    if len(shape) > 1 and shape[-1] == shape[-2]:
        yield (
            "diagonal",
            "every off-diagonal entry of `{0}` were 0",
            lambda x: x * np.eye(len(x)),
        )
        yield "identity", "`{0}` were the identity matrix", lambda x: np.eye(len(x))
        yield "inverted", "`{0}` were replaced with its inverse", np.linalg.inv
        yield "upper", f"every entry of `{{0}}` {ON_ONE_SIDE} were 0", np.triu
        yield "lower", f"every entry of `{{0}}` {ON_ONE_SIDE} were 0", np.tril
    if len(shape) > 1:
        yield (
            "columns",
            _reversed(shape, "columns", "second"),
            partial(np.flip, axis=1),
        )


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


def _rolled(x: Array, axis: int = 0) -> Array:
    return np.roll(x, 3, axis=axis)


def _constant(value: Any, x: Any) -> Any:
    return np.zeros_like(x) + value


def _unit(x: Array) -> Array:
    return x / np.linalg.norm(x)


def _normalised(T: Array) -> Array:
    axes = tuple(range(1, T.ndim))
    return T / np.sqrt(np.sum(T * T, axis=axes, keepdims=True))


def _first(x: Array) -> Array:
    return np.zeros_like(x) + x[:1]


def _last(x: Array) -> Array:
    return np.zeros_like(x) + x[-1:]


def _mean(x: Array) -> Array:
    return np.zeros_like(x) + x.mean(axis=0)


def _cut(some: slice, x: Array) -> Array:
    return x[some]


def _only(some: slice, x: Array) -> Array:
    found = np.zeros_like(x)
    found[some] = x[some]
    return found


def _shifted(by: int, x: Array) -> Array:
    found = np.roll(x, by, axis=0)
    found[0 if by > 0 else -1] = 0.0
    return found


def _downwards(x: Array) -> Array:
    return np.array([0.0, 0.0, -np.linalg.norm(x)])


def _without_small(small: float, x: Any) -> Any:
    return x * (np.abs(x) >= small)


def _at(k: int, change: Callable[[Any], Any], *call: Any) -> Call:
    """Return a call with one argument changed; a number stays a Python number."""
    new = change(own(call[k]))
    plain = np.ndim(new) == 0 and isinstance(call[k], float)
    return (*call[:k], float(new) if plain else new, *call[k + 1 :])


def _exchanged(k: int, m: int, *call: Any) -> Call:
    new = list(call)
    new[k] = call[m]
    new[m] = call[k]
    return tuple(new)


def _backwards(n: int, *call: Any) -> Call:
    """Return a call with every argument that has n entries read from its end."""
    return tuple(x[::-1] if _long(x, n) else x for x in call)
