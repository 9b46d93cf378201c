"""A Panda whose links are a little longer and turned: asked of every passing chain.

Numbers that were copied from somewhere, or typed in, fit the real Panda alone. A chain
that reads its model is right on this one too.
"""

from functools import cache

import mujoco
import numpy as np

from robo47 import panda, se3, verify
from robo47.checks import Array

SEED = 2047
REACH, TURN = 0.03, 0.3  # at most so many metres and radians per link and axis
AGREES = 1e-6
FRAMES = {"compose_fk": "site:attachment_site", "link4_to_world": "body:link4"}


@cache
def model() -> mujoco.MjModel:
    """Return the changed Panda, compiled; do not change it."""
    changed = panda.load("panda_nohand")
    rng = np.random.default_rng(SEED)
    for body in range(1, changed.nbody):  # 0 is the world
        changed.body_pos[body] += rng.uniform(-REACH, REACH, 3)
        R = se3.quat_to_R(changed.body_quat[body])
        R = R @ se3.axis_angle(rng.normal(size=3), rng.uniform(0, TURN))
        changed.body_quat[body] = se3.R_to_quat(R)
    return changed


@cache
def configurations() -> Array:
    """Return the joint angles to ask at, (2, 7)."""
    return verify.random_q(model(), 2, SEED)


def worst_error(function: str, values: list[object]) -> float:
    """Return how far answers on the changed Panda are from MuJoCo's.

    Args:
        function: a key of `FRAMES`.
        values: one answer per configuration, whatever the student's function returned.

    Returns:
        The largest difference of any entry; infinity where an answer is no 4x4 matrix.
    """
    truth = verify.mujoco_poses(model(), configurations())[FRAMES[function]]
    worst = 0.0
    for value, T in zip(values, truth, strict=True):
        if not isinstance(value, np.ndarray) or value.shape != (4, 4):
            return float("inf")
        error = float(np.abs(value - T).max())
        worst = max(worst, error if np.isfinite(error) else float("inf"))
    return worst
