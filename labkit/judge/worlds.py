"""Worlds as arguments: they have a method `edge_free(a, b)`, and nothing else.

They stand for a robot among walls. A world does not travel to the sandbox: what the
function gets there asks back (`labkit.sandbox.inside.fake_world`).
"""

from typing import Any

import numpy as np


class _World:
    """What one sees of a world in a sentence."""

    def __repr__(self) -> str:
        """Return what one sees of it."""
        return "a world with its own edge_free(a, b)"


class Balls(_World):
    """A world of balls, as the library's `segment_free_of_discs` has them."""

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


class HalfSpace(_World):
    """A world of one flat wall: what lies behind it is not free."""

    def __init__(self, normal: Any, offset: float) -> None:
        """Take the wall: x is free where normal . x is over the offset."""
        self.normal = np.array(normal, dtype=np.float64)
        self.offset = offset

    def edge_free(self, a: Any, b: Any) -> bool:
        """Return whether both ends, and so all between them, lie before the wall."""
        return bool(min(self.normal @ a, self.normal @ b) > self.offset)


def is_world(arg: Any) -> bool:
    """Return whether an argument answers questions itself, and so stays here."""
    return callable(getattr(arg, "edge_free", None))
