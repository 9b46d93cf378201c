"""46.7 `seen_from(T_world_hand, p_world)`: a pose and a point."""

import numpy as np

from labkit.judge import Row, Vector
from robo47 import se3

row = Row(
    Vector((3,), "m"),
    truth=lambda T, p: (se3.inverse(T) @ np.append(p, 1.0))[:3],
    near=1e-4,
)


@row.inputs
def _(rng):
    yield from ((T, rng.numbers(-1, 1, 3)) for T in rng.poses(6))


@row.wrong
def not_undone(T_world_hand, p_world):
    """T is used as it is; it maps the hand to the world, and you want back"""
    return (T_world_hand @ np.append(p_world, 1.0))[:3]
