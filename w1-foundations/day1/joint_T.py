"""1.5 `joint_T(q)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Pose, Row
from labkit.judge.answer_mistakes import of_a_pose
from labkit.judge.matrices import pose
from robo47 import se3

from .panda_chain import BACKWARDS, NEAR
from .Rz import angles

row = Row(
    Pose(),
    truth=lambda q: pose(se3.Rz(q), np.zeros(3)),
    near=NEAR,
    alike=[BACKWARDS],
)
row.inputs(angles)


@row.wrong
def slides_along_z(q):
    """your code translates the link by `q` along the z axis. The Panda's joints are
    revolute, so rotate the link by `q` about the z axis instead"""
    return pose(np.eye(3), np.array([0.0, 0.0, q]))


row.reached_by(
    "Rz",
    called={"`theta` = 0": "an angle of 0", "`theta`": "the angle"},
)
# A joint does not move its body, so what is done to t changes nothing.
row.of_answer(
    of_a_pose("maps parent coordinates to body coordinates"),
    but=("t-in-last-row", "t-lost", "t-negated", "millimetres"),
)


@row.wrong("shape")  # The turn alone is no factor of a product of poses.
def _(q):
    return se3.Rz(q)
