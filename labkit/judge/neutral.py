"""Values of an argument at which a term drops out: 0, the identity, one entry alone."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from labkit.judge.answers import rigid
from robo47.checks import Array

# That another input has, in units of what was asked. The last is far smaller: what is
# right wherever 1 - e^(-x) is 1 to all digits, say, is not right there.
SIZES = (-1.0, 5.0, -0.2, 0.01)
SHORT = 4  # entries of a vector in which the sign of one entry is tried
_SEVERAL = (1.0, -1.0, 5.0, -0.2, 0.2, -5.0)


@dataclass(frozen=True)
class Neutral:
    """One way for an argument to be neutral."""

    says: str  # "`{}` is 0"
    value: Any  # the argument made so with as little change as that takes
    holds: Callable[[Any], bool]  # whether a value of such an argument is so
    others: tuple[Any, ...] = ()  # further values that are so: signs, sizes, places


def neutrals(x: Any) -> Iterator[Neutral]:
    """Yield the neutral values of an argument, the most telling first.

    Args:
        x: a number, a vector, a matrix, a rotation or a pose; anything else has none.
    """
    if isinstance(x, float) and not isinstance(x, bool):
        yield Neutral("`{}` is 0", 0.0, lambda v: v == 0)
        yield Neutral("`{}` is 1", 1.0, lambda v: v == 1)
    elif not isinstance(x, np.ndarray):
        return
    elif x.ndim == 1 and len(x) > 1:
        yield from _of_a_vector(x)
    elif x.ndim == 3 and len(x) > 1 and x.dtype.kind == "f":
        yield from _of_a_stack(x)
    elif x.ndim == 2:
        yield from _of_a_matrix(x)


def scaled(x: Any, size: float, fixed: Any = False) -> Any:
    """Return an argument of another size: a number or plain array; others stay.

    Args:
        x: the argument.
        size: by which it grows.
        fixed: of which entries it does not, such as the 1 in a camera's matrix.
    """
    if isinstance(x, float):
        return x * size
    if not isinstance(x, np.ndarray) or x.dtype.kind != "f":
        return x
    square = x.ndim == 2 and x.shape[0] == x.shape[1]
    if x.shape[-2:] in ((3, 3), (4, 4)) and rigid(x.reshape(-1, *x.shape[-2:])):
        return x
    if square and np.array_equal(x, x.T) and (np.diag(x) > 0).all():
        size = abs(size)  # a mass matrix stays one
    return np.where(fixed, x, x * size)


def _of_a_vector(x: Array) -> Iterator[Neutral]:
    size = float(np.abs(x).max()) or 1.0
    length = float(np.linalg.norm(x)) or 1.0  # what is normed depends on it
    ends = [s * each for each in (size, length) for s in (1.0, -1.0)]
    all_of = [np.full_like(x, s * size) for s in _SEVERAL]
    all_of += [np.full_like(x, s * length / np.sqrt(len(x))) for s in (1.0, -1.0)]
    yield Neutral("`{}` is 0", np.zeros_like(x), lambda v: not v.any())
    yield Neutral(
        "all entries of `{}` are equal",
        np.full_like(x, x[0]),
        lambda v: bool((v == v[0]).all()),
        tuple(all_of),
    )
    places = np.eye(len(x), dtype=x.dtype)
    yield Neutral(
        "only one entry of `{}` is not 0",
        np.where(np.arange(len(x)) == np.argmax(np.abs(x)), x, 0.0),
        lambda v: int(np.count_nonzero(v)) == 1,
        tuple(s * one for s in (*ends, 5.0 * size, -0.2 * size) for one in places),
    )
    if len(x) == 6:
        for some, where in ((slice(3), "[:3]"), (slice(3, None), "[3:]")):
            yield _half(x, some, where)
    if x.dtype.kind == "f":
        for sign, word in ((1.0, "negative"), (-1.0, "positive")):
            sized = sign * np.abs(x)
            yield Neutral(
                f"no entry of `{{}}` is {word}",
                sized,
                lambda v, sign=sign: bool((sign * v >= 0).all()),  # type: ignore[misc]
                tuple(s * np.roll(sized, i) for i, s in enumerate((5.0, 0.2))),
            )
        if len(x) <= SHORT:
            yield from _of_an_entry(x)


def _of_an_entry(x: Array) -> Iterator[Neutral]:
    """Yield that one entry has one sign, such as the w of a quaternion."""
    for i in range(len(x)):
        for sign, word in ((1.0, "negative"), (-1.0, "positive")):
            here = np.arange(len(x)) == i
            found = np.where(here, sign * np.abs(x), x)
            mirrored = np.where(here, found, -x)
            yield Neutral(
                f"`{{}}[{i}]` is not {word}",
                found,
                lambda v, i=i, sign=sign: bool(sign * v[i] >= 0),  # type: ignore[misc]
                (5.0 * found, mirrored, 0.2 * mirrored),
            )


def _half(x: Array, some: slice, where: str) -> Neutral:
    """Return a twist or a wrench with one of its halves 0."""
    found = x.copy()
    found[some] = 0.0
    others = tuple(s * found for s in _SEVERAL[1:])
    return Neutral(f"`{{}}{where}` is 0", found, lambda v: not v[some].any(), others)


def _of_a_stack(x: Array) -> Iterator[Neutral]:
    """Yield what poses, rotations or any matrices have in common, (n, m, k)."""
    kind = {(4, 4): "poses", (3, 3): "rotations"}.get(x.shape[1:])
    if kind is None or not rigid(x):
        kind = "matrices"
    if kind == "poses":
        turned = x.copy()
        moved = x.copy()
        turned[:, :3, 3] = 0.0
        moved[:, :3, :3] = np.eye(3)
        yield Neutral(
            "every pose of `{}` is the identity",
            np.zeros_like(x) + np.eye(4),
            lambda v: not (v - np.eye(4)).any(),
        )
        yield Neutral(
            "no pose of `{}` translates", turned, lambda v: not v[:, :3, 3].any()
        )
        yield Neutral(
            "no pose of `{}` rotates",
            moved,
            lambda v: not (v[:, :3, :3] - np.eye(3)).any(),
        )
    if kind == "rotations":
        yield Neutral(
            "every rotation of `{}` is the identity",
            np.zeros_like(x) + np.eye(3),
            lambda v: not (v - np.eye(3)).any(),
        )
    yield Neutral(
        f"all {kind} of `{{}}` are the same",
        np.zeros_like(x) + x[0],
        lambda v: not (v - v[0]).any(),
        tuple(np.zeros_like(x) + one for one in x[1:]),
    )


def _of_a_matrix(x: Array) -> Iterator[Neutral]:
    square = x.shape[0] == x.shape[1]
    if x.shape == (4, 4) and rigid(x[None]):
        yield from _of_a_pose(x)
    elif x.shape == (3, 3) and rigid(x[None]):
        yield Neutral("`{}` is the identity matrix", np.eye(3), _is_identity)
    elif square:
        diagonal = np.diag(np.diag(x))
        yield Neutral(
            "`{}` is diagonal",
            diagonal,
            lambda v: len(v) == v.shape[1] and not (v - np.diag(np.diag(v))).any(),
            tuple(scaled(diagonal, s) for s in _SEVERAL[1:]),
        )
        yield Neutral("`{}` is the identity matrix", np.eye(len(x)), _is_identity)
        yield Neutral("`{}` is 0", np.zeros_like(x), lambda v: not v.any())
    else:
        columns = [x * (np.arange(x.shape[1]) == i) for i in range(x.shape[1])]
        yield Neutral(
            "only one column of `{}` is not 0",
            columns[0],
            lambda v: int(v.any(axis=0).sum()) == 1,
            tuple(s * one for one in columns for s in _SEVERAL[:4]),
        )


def _of_a_pose(T: Array) -> Iterator[Neutral]:
    turned = T.copy()
    moved = T.copy()
    turned[:3, 3] = 0.0
    moved[:3, :3] = np.eye(3)
    yield Neutral("`{}` does not translate", turned, lambda v: not v[:3, 3].any())
    yield Neutral(
        "`{}` does not rotate",
        moved,
        lambda v: np.array_equal(v[:3, :3], np.eye(3)),
        tuple(_moved(moved, s) for s in _SEVERAL[1:]),
    )


def _moved(T: Array, size: float) -> Array:
    """Return a pose with its translation in another size."""
    found = T.copy()
    found[:3, 3] *= size
    return found


def _is_identity(v: Array) -> bool:
    return np.array_equal(v, np.eye(len(v)))
