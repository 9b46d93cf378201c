"""The right answers: from MuJoCo and `robo47.se3`, never from the student's file."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from robo47 import se3
from robo47.checks import Array
from robo47.diagnose import cases
from robo47.diagnose.mistakes import factors, order

# Frames whose pose MuJoCo computes itself; nothing of ours has a part in it.
_MUJOCO_FRAME = {
    "compose_fk": "site:attachment_site",
    "link4_to_world": "body:link4",
}
_BY_HAND: dict[str, Callable[..., Array]] = {
    "make_T": se3.make_T,
    "Rz": se3.Rz,
    "inverse": se3.inverse,
    "quat_to_R": se3.quat_to_R,
    "link_T": factors.link,
    "joint_T": factors.turn,
    "predict_order": order.both(order.right),
}


def stacked_arguments(function: str) -> tuple[Array, ...]:
    """Return all calls' arguments, one array (n, ...) per argument, without the model.

    Args:
        function: as in `TASK_FUNCTIONS`.
    """
    columns: list[tuple[Any, ...]] = list(zip(*cases.arguments(function), strict=True))
    return tuple(np.array(c) for c in columns if not isinstance(c[0], str))


@cache
def right_answers(function: str) -> Array:
    """Return what a right function answers to each of its calls, (n, ...).

    Args:
        function: as in `TASK_FUNCTIONS`.
    """
    arguments = stacked_arguments(function)
    if function in _MUJOCO_FRAME:
        from robo47 import verify
        from robo47.diagnose import arm

        poses = verify.mujoco_poses(arm.model(), arguments[0])
        answers = poses[_MUJOCO_FRAME[function]]
    else:
        answers = _BY_HAND[function](*arguments)
    answers.flags.writeable = False
    return answers
