"""3.4 `pose_error(T, T_goal)`: its questions and its mistakes."""

from dataclasses import dataclass

import numpy as np

from labkit.judge import Row, Twist
from robo47 import se3
from robo47.jacobian import log_rotation, pose_error
from robo47.screws import exp_rotation, skew

from .log_rotation import roll_pitch_yaw


@dataclass(frozen=True)
class Gap(Twist):
    """A pose error: a rotation above, a translation below."""

    halves = ("the rotation", "the translation")


row = Row(Gap())


@row.inputs
def _(rng):
    higher = np.eye(4)
    higher[2, 3] = 0.1
    T = rng.poses(8)
    turn = exp_rotation(rng.units(8), rng.uniform(0.05, 3.0, 8))
    goal = se3.make_T(turn @ T[:, :3, :3], rng.numbers(-1, 1, 8, 3))
    return [(np.eye(4), higher), *zip(T, goal, strict=True)]


def screw_log(D):
    """Return the twist whose exponential is a pose."""
    w = log_rotation(D[:3, :3])
    p = D[:3, 3]
    angle = np.linalg.norm(w)
    if angle < 1e-6:
        return np.concatenate([w, p])
    K = skew(w / angle)
    G = np.eye(3) - angle / 2 * K + (1 - angle / 2 / np.tan(angle / 2)) * K @ K
    return np.concatenate([w, G @ p])


@row.wrongs
def _(T, T_goal):
    """in-the-hands-axes: both halves of your error are expressed in the hand frame.
      Express both halves in the world frame instead
    body-twist: your code returns the body twist log(T^-1 T_goal), which belongs to
      J_body. Return the error that belongs to J_site
    space-twist: your code returns the spatial twist log(T_goal T^-1), which belongs to
      J_space. Return the error that belongs to J_site
    """
    D = np.linalg.inv(T) @ T_goal
    return {
        "in-the-hands-axes": np.append(log_rotation(D[:3, :3]), D[:3, 3]),
        "body-twist": screw_log(D),
        "space-twist": screw_log(T_goal @ np.linalg.inv(T)),
    }


@row.wrongs
def _(T, T_goal):
    """rotation-in-the-hands-axes: your code uses the rotation vector log(R^T R_goal),
      which is expressed in the hand frame. Express the rotation vector in the world
      frame instead
    rotation-sign: your code uses the rotation from the goal to the hand. Use the
      rotation from the hand to the goal instead
    rotation-difference: your code returns `log(R_goal) - log(R)` as the rotation
      vector. Use the logarithm of the rotation from R to R_goal instead
    euler-difference: your code subtracts the roll, pitch and yaw angles of the two
      poses. Use the logarithm of the rotation from R to R_goal instead, because the
      differences between these angles do not form a rotation vector
    """
    R = T[:3, :3]
    goal = T_goal[:3, :3]
    way = T_goal[:3, 3] - T[:3, 3]
    rotations = {
        "rotation-in-the-hands-axes": log_rotation(R.T @ goal),
        "rotation-sign": log_rotation(R @ goal.T),
        "rotation-difference": log_rotation(goal) - log_rotation(R),
        "euler-difference": roll_pitch_yaw(goal) - roll_pitch_yaw(R),
    }
    return {slug: np.append(w, way) for slug, w in rotations.items()}


@row.wrongs
def _(T, T_goal):
    """translation-in-the-hands-axes: your translation is expressed in the hand frame,
      as in the last column of T^-1 T_goal. The translation should be expressed in the
      world frame
    goal-position-for-translation: your code uses the position of the goal as the
      translation. Use the vector from the hand to the goal instead
    translation-sign: your code uses the vector from the goal to the hand as the
      translation. Use the vector from the hand to the goal instead
    screw-for-translation: your code uses `p_goal - R p` as the translation, where R is
      the rotation matrix of T_goal T^-1. Use `p_goal - p` instead, which is the vector
      from the hand to the goal
    """
    goal = T_goal[:3, 3]
    turn = pose_error(T, T_goal)[:3]
    translations = {
        "translation-in-the-hands-axes": (np.linalg.inv(T) @ T_goal)[:3, 3],
        "goal-position-for-translation": goal,
        "translation-sign": T[:3, 3] - goal,
        "screw-for-translation": (T_goal @ np.linalg.inv(T))[:3, 3],
    }
    return {slug: np.append(turn, way) for slug, way in translations.items()}


row.reached_by(
    "log_rotation",
    "for the rotation error R, ",
    but=("textbook-formula", "nan-at-0", "arccosine-beyond-1", "fixed-column"),
    called={"your vector": "your rotation vector", "the vector": "the rotation vector"},
)


@row.wrong("halves-swapped")  # The translation above.
def _(T, T_goal):
    return np.roll(pose_error(T, T_goal), 3)
