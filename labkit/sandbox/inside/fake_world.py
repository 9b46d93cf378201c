"""Worlds of balls, which answer questions and show no numbers."""

from typing import Any

import numpy as np


class Balls:
    """A world as an argument: it has a method `edge_free(a, b)`, and nothing else.

    It stands for a robot among walls, which cannot travel to the sandbox; nor can the
    library's `segment_free_of_discs`, which a test of Day 12 holds it against.
    """

    def __init__(self, rows: Any) -> None:
        """Take centre and radius of each, (m, k + 1)."""
        self.rows = np.array(rows, dtype=np.float64)

    def edge_free(self, a: Any, b: Any) -> bool:
        """Return whether the straight edge from a to b, (k,) each, touches no ball."""
        along = np.subtract(b, a)
        to_centres = self.rows[:, :-1] - a
        part = to_centres @ along / max(along @ along, 1e-300)
        feet = np.clip(part, 0.0, 1.0)[:, None] * along
        away = np.linalg.norm(to_centres - feet, axis=1)
        return bool(np.all(away > self.rows[:, -1]))

    def __repr__(self) -> str:
        """Return what one sees of it."""
        return "a world with its own edge_free(a, b)"
