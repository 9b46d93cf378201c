"""What a passing chain is asked besides: at fresh angles, and on a longer arm.

The judge's questions are the same at every run, so a table of answers would pass them.
Fresh angles tell such a table from a computation; longer links tell numbers that are
read from the model from numbers that are typed in; a shorter path, such as task 1.8
hands over, tells whether `path` is looked at.
"""

import secrets
from functools import cache

import mujoco
import numpy as np

from robo47 import panda, verify
from robo47.checks import Array

STRETCH = 1.2  # every offset between two bodies, zeros and turns as they are
AGREES = 1e-6
FRAMES = {"compose_fk": "site:attachment_site", "link4_to_world": "body:link4"}
FRESH = 2  # configurations per model
TAKES_A_PATH = "compose_fk"
TO_LINK4 = (("link0", None), *((f"link{i}", f"joint{i}") for i in range(1, 5)))


@cache
def models() -> tuple[mujoco.MjModel, mujoco.MjModel]:
    """Return the Panda, and the Panda with longer links; do not change them."""
    longer = panda.load("panda_nohand")
    longer.body_pos[:] *= STRETCH
    return panda.load("panda_nohand"), longer


def fresh_configurations(seed: int | None = None) -> Array:
    """Return joint angles that nobody knows beforehand, (FRESH, 7).

    Args:
        seed: for a grade that can be repeated; it must not be known to the student.
    """
    if seed is None:
        seed = secrets.randbits(32)
    return verify.random_q(models()[0], FRESH, seed)


def worst_error(which: int, function: str, q: Array, values: list[object]) -> float:
    """Return how far answers are from MuJoCo's.

    Args:
        which: index in `models`.
        function: a key of `FRAMES`.
        q: configurations, (n, 7).
        values: one answer each, whatever the student's function returned.

    Returns:
        The largest difference of any entry; infinity where an answer is no 4x4 matrix.
    """
    truth = verify.mujoco_poses(models()[which], q)[FRAMES[function]]
    worst = 0.0
    for value, T in zip(values, truth, strict=True):
        if not isinstance(value, np.ndarray) or value.shape != (4, 4):
            return float("inf")
        error = float(np.abs(value - T).max())
        worst = max(worst, error if np.isfinite(error) else float("inf"))
    return worst
