"""1.4 `quat_to_R(quat)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Rotation, Row, rounded
from labkit.judge.answer_mistakes import OF_A_ROTATION
from robo47 import se3

from .panda_chain import FLANGE_QUAT, NEAR

row = Row(Rotation(), near=NEAR)


def quaternions(rng):
    """Return some as in model files, unit ones, short ones; some with w < 0, (n, 4)."""
    written = [[1, 0, 0, 0], [1, 1, 0, 0], [1, -1, 0, 0], FLANGE_QUAT]
    q = rng.normal(size=(6, 4))
    q[:3] /= np.linalg.norm(q[:3], axis=1, keepdims=True)
    q[[1, 4], 0] = -np.abs(q[[1, 4], 0])
    short = [0.0001, 0.0002, 0.0, -0.0002], [0.2, -0.1, 0.1, 0.2]
    return np.vstack([np.array([*written, *short]), rounded(q)])


@row.inputs
def _(rng):
    return [(quat,) for quat in quaternions(rng)]


def by_ones(quat):
    """Return 1 - 2 (yy + zz) and so on, without normalising first."""
    w, x, y, z = quat
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip


def normalised(quat):
    """Return the right one."""
    return by_ones(quat / np.linalg.norm(quat))


def by_squares(quat):
    """Return ww + xx - yy - zz and so on, without normalising first."""
    return np.linalg.norm(quat) ** 2 * se3.quat_to_R(quat)


UNNORMALISED = (by_ones, by_squares)  # the usual formulas: the same of a unit one
NOT_NORMALISED = (
    "your code does not normalise the quaternion. Only a unit quaternion represents a "
    "rotation, but (1, 1, 0, 0), for example, has norm 1.41"
)
XYZW_AND_NOT_NORMALISED = (
    "your code reads the quaternion as (x, y, z, w) and does not normalise it. "
    "Use MuJoCo's order (w, x, y, z), and normalise the quaternion"
)


@row.wrongs(hidden={"short-ones-kept": "no quaternion there is short"})
def _(quat):
    """wxyz-read-as-xyzw: your code reads the quaternion as (x, y, z, w). Use MuJoCo's
      order instead, which is (w, x, y, z)
    xyzw-rolled-wrongly: your code reads the quaternion as (y, z, w, x). Use MuJoCo's
      order instead, which is (w, x, y, z)
    half-angle: your code rotates by half the correct angle. The component w is the
      cosine of half the rotation angle, not of the rotation angle itself
    short-ones-kept: your code normalises the quaternion only if its norm is above 1.
      Also normalise quaternions whose norm is below 1
    factor-two-missing: your code omits the factor 2 in front of the products of
      quaternion components
    """
    unturned = np.array([1.0, 0.0, 0.0, 0.0])
    read = {
        "wxyz-read-as-xyzw": quat[[3, 0, 1, 2]],
        "xyzw-rolled-wrongly": quat[[2, 3, 0, 1]],
        "half-angle": quat / np.linalg.norm(quat) + unturned,
    }
    return {
        **{slug: partial(normalised, other) for slug, other in read.items()},
        "short-ones-kept": lambda: by_ones(quat / max(np.linalg.norm(quat), 1.0)),
        "factor-two-missing": lambda: (normalised(quat) + np.eye(3)) / 2,
    }


for formula in UNNORMALISED:
    row.wrong("not-normalised", NOT_NORMALISED)(formula)
    row.wrong("xyzw-and-not-normalised", XYZW_AND_NOT_NORMALISED, both=True)(
        lambda quat, formula=formula: formula(np.roll(quat, 1))
    )


row.of_answer(OF_A_ROTATION)


@row.right  # The outer product of the vector part, in place on a copy.
def _(quat):
    quat = quat.copy()
    quat /= np.linalg.norm(quat)
    w, x, y, z = quat
    R = 2 * np.outer(quat[1:], quat[1:])
    R += (2 * w * w - 1) * np.eye(3)
    R += 2 * w * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return R


@row.wrong("slip-sign")  # One sign slipped in one entry.
def _(quat):
    w, x, y, z = quat / np.linalg.norm(quat)
    R = by_ones([w, x, y, z])
    R[1, 2] = 2 * (y * z + w * x)
    return R


@row.wrong("not-orthonormal")  # The diagonal was "simplified".
def _(quat):
    w, x, y, z = quat / np.linalg.norm(quat)
    R = by_ones([w, x, y, z])
    R[[0, 1, 2], [0, 1, 2]] = w * w + x * x, w * w + y * y, w * w + z * z
    return R


@row.wrong("not-finite")  # Axis and angle, but no turn has no axis: 0 / 0.
def _(quat):
    quat = quat / np.linalg.norm(quat)
    angle = 2 * np.arccos(quat[0])
    with np.errstate(invalid="ignore"):
        x, y, z = quat[1:] / np.linalg.norm(quat[1:])
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
