"""Answers of functions that are given, a lab's own: asked row by row."""

from collections.abc import Callable
from typing import Any

import numpy as np

from robo47.checks import Array

Function = Callable[..., Array]  # one of the lab's own


def each(function: Callable[..., Any], *columns: Array) -> Array:
    """Return a function's answers to each row of its arguments.

    Args:
        function: takes one row of each column.
        columns: arguments, (n, ...) each.

    Returns:
        Answers, (n, ...).
    """
    return np.array([function(*row) for row in zip(*columns, strict=True)])
