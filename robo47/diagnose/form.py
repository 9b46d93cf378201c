"""The first look: did an answer come back at all, and is it the right kind of thing?"""

from typing import NamedTuple

import numpy as np

from robo47.checks import Array
from robo47.diagnose.verdict import Answer

_KIND: dict[tuple[int, ...], str] = {
    (4, 4): "a 4x4 matrix",
    (3, 3): "a 3x3 matrix",
    (2, 3): "two vectors of 3",
}


class Finding(NamedTuple):
    """A mistake that was found: its name, and what to say."""

    slug: str
    message: str


def unwritten(answers: list[Answer]) -> str | None:
    """Return the error that names a task as unwritten, or None."""
    errors = (answer.error or "" for answer in answers)
    return next((e for e in errors if e.startswith("NotImplementedError")), None)


def look(answers: list[Answer], shape: tuple[int, ...]) -> Array | Finding:
    """Return the answers stacked as float64, (n, *shape), or what keeps them from it.

    Args:
        answers: of one function, one per call.
        shape: what each must have; (2, 3) may come as a tuple of two vectors.
    """
    if broken := [answer.error for answer in answers if answer.error]:
        often = f"in {len(broken)} of {len(answers)} calls"
        return Finding("raises", f"It stops with {broken[0]}, {often}.")
    if any(answer.value is None for answer in answers):
        return Finding(
            "nothing-returned",
            "It returns nothing (None): the result is worked out, but not handed back.",
        )
    values = []
    for answer in answers:
        value = _array(answer.value, shape)
        if isinstance(value, Finding):
            return value
        values.append(value)
    return np.stack(values).astype(np.float64)


def single_precision(answers: list[Answer], values: Array) -> bool:
    """Return whether all numbers came as float32, or are ones that float32 can hold."""
    if all(getattr(a.value, "dtype", None) == np.float32 for a in answers):
        return True
    with np.errstate(over="ignore"):
        return bool(np.array_equal(values.astype(np.float32), values))


def _array(value: object, shape: tuple[int, ...]) -> Array | Finding:
    try:
        array = np.asarray(value)
    except ValueError:  # parts of different shapes
        parts = value if isinstance(value, tuple | list) else ()
        shapes = ", ".join(str(np.shape(part)) for part in parts)
        return Finding("shape", f"Its parts have shapes {shapes}; {_expected(shape)}.")
    if array.dtype.kind not in "fiub":
        return Finding(
            "not-numbers",
            f"It returns {array.dtype} values; {_expected(shape)} of real numbers.",
        )
    if array.shape != shape:
        return Finding("shape", _wrong_shape(array.shape, shape))
    return array


def _expected(shape: tuple[int, ...]) -> str:
    return f"expected is {_KIND[shape]}"


def _wrong_shape(got: tuple[int, ...], shape: tuple[int, ...]) -> str:
    reasons: dict[tuple[tuple[int, ...], ...], str] = {
        ((3, 4), (4, 4)): "the bottom row (0, 0, 0, 1) is missing",
        ((3, 3), (4, 4)): "this is the rotation alone",
        ((2, 2), (3, 3)): "it is a turn in space, so z is there too",
        ((4, 4), (3, 3)): "only the rotation is asked for",
        ((2, 4), (2, 3)): "leave the fourth entry of each point out",
        ((2, 4, 4), (2, 3)): "only the translations are asked for",
        ((2, 3, 1), (2, 3)): "columns of shape (3, 1) are not plain vectors",
    }
    text = f"It returns shape {got}; {_expected(shape)}, shape {shape}"
    reason = reasons.get((got, shape))
    return f"{text}: {reason}." if reason else f"{text}."
