"""Calls and values as a student can type them.

A whole number is typed without a point, except where one entry alone would make it an
integer; a truth value is True or False, an index an index.
"""

import math
import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from labkit.base.exchange import Question

DUST = 4  # last bits that a sum or a product may leave
TYPED = 12  # digits that a person may type
LOGARITHMS = 10  # of whole numbers, up to which they are typed as such


def typed(
    question: Question, names: Sequence[str] = (), longest: float = np.inf
) -> str:
    """Return a call as a student can type it; what is too long goes by its name."""
    args = question.args
    others = names if len(names) == len(args) else ["..."] * len(args)
    words = [
        value if 0 < len(value := typed_one(arg)) <= longest else name
        for arg, name in zip(args, others, strict=True)
    ]
    return f"{question.function}({', '.join(words)})"


def in_words(question: Question, names: Sequence[str] = ()) -> str:
    """Return a question's input as a student can type it, or "" where it is too long.

    Numbers and vectors can be typed; where a matrix is among them, the rest would
    mislead.
    """
    args = question.args
    if any(isinstance(arg, np.ndarray) and arg.ndim != 1 for arg in args):
        return ""
    named = len(names) == len(args) > 1
    words = [
        f"{names[i]} = {says}" if named else says
        for i, arg in enumerate(args)
        if (says := typed_one(arg))  # not the robot, or a path along it
    ]
    return (", " if named else " and ").join(words)


def typed_one(arg: Any) -> str:
    """Return a number, a vector, a text or a tuple of them as typed, else ""."""
    if isinstance(arg, np.generic) or (isinstance(arg, np.ndarray) and not arg.ndim):
        arg = arg.item()
    if arg is None or isinstance(arg, bool | str):
        return repr(arg)
    if isinstance(arg, int | float):
        small = isinstance(arg, float) or abs(arg) < 2**53
        return number(float(arg)) if small else repr(arg)
    if isinstance(arg, np.ndarray) and arg.ndim == 1:
        items = [typed_one(x) for x in arg]
        if len(arg) == 1 and arg.dtype.kind == "f" and items[0].lstrip("-").isdigit():
            items = [f"{items[0]}.0"]
    elif isinstance(arg, tuple | list):
        items = [typed_one(x) for x in arg]
    else:
        return ""
    if not all(items):
        return ""
    comma = "," * (len(items) == 1 and not isinstance(arg, list))
    inside = ", ".join(items) + comma
    return f"[{inside}]" if isinstance(arg, list) else f"({inside})"


def shown(value: Any) -> str:
    """Return an answer, or an array, as Python reads it."""
    if isinstance(value, tuple):
        comma = "," * (len(value) == 1)
        return f"({', '.join(map(shown, value))}{comma})"
    if isinstance(value, np.ndarray) and not value.size and value.ndim > 1:
        return f"np.zeros({value.shape})"
    if isinstance(value, np.ndarray) and value.dtype.kind == "f":
        return repr((value.astype(np.float64) + 0.0).tolist())  # + 0.0: no -0.0
    if isinstance(value, np.ndarray | np.generic):
        return repr(value.tolist())
    return repr(value + 0.0 if isinstance(value, float) else value)


def number(x: float) -> str:
    """Return a number as Python reads it back, "pi / 2" for a fraction of pi."""
    if not math.isfinite(x):
        return f"np.{x!r}" if x >= 0 or x != x else f"-np.{-x!r}"
    for over in (1, 2, 3, 4, 6):
        times = x * over / np.pi
        if times and times == round(times) and abs(times) <= 2 * over:
            sign = "-" if times < 0 else ""
            many = "" if abs(times) == 1 else f"{abs(round(times))} * "
            return f"{sign}{many}pi" + (f" / {over}" if over > 1 else "")
    if abs(x - (short := float(f"{x:.{TYPED}g}"))) <= DUST * np.spacing(abs(x)):
        x = short  # 0.831, and not the 0.8310000000000001 of a sum
    for n in range(2, LOGARITHMS + 1):
        if abs(abs(x) - math.log(n)) <= np.spacing(1.0):
            return f"{'-' * (x < 0)}np.log({n})"
    if x == round(x) and abs(x) < 1e6:
        return repr(round(x))
    text = re.sub(r"e\+0?", "e", f"{x:.6g}") if abs(x) >= 1e6 else ""  # 1e14
    return text if "e" in text and float(text) == x else repr(x)
