"""Lifting a cube: grasp poses, combined inertias and friction grips.

Conventions: poses are `T_world_x`. Metres, kilograms, newtons; an inertia is about the
centre of mass of its body. Leading dimensions broadcast.

Source: Lynch and Park, Modern Robotics (2017), section 8.2 for inertias and section
12.2.1 for Coulomb friction.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.checks import Array
from robo47.gravity import GRAVITY

_TOOL_DOWN = np.diag([1.0, -1.0, -1.0])  # z down, x parallel to the world's


def grasp_pose(T_world_cube: ArrayLike, above: ArrayLike) -> Array:
    """Return the grasp pose of a tool over a cube: z down, x parallel to a side.

    A rotation by 90 degrees does not change a cube, so the yaw is wrapped to +-45
    degrees. From READY_Q the last joint then stays within its limits.

    Args:
        T_world_cube: pose of a cube that stands on one of its faces, with its z axis up
            or down, (..., 4, 4).
        above: height of the tool over the centre of the cube, metres, (...).

    Returns:
        T_world_tcp, (..., 4, 4); its z axis points down.

    Raises:
        ValueError: wrong shape, a non-finite number, or not a pose.
    """
    T_world_cube = checks.pose(T_world_cube, "T_world_cube")
    above = checks.array(above, "above", ())
    yaw = np.arctan2(T_world_cube[..., 1, 0], T_world_cube[..., 0, 0])
    quarter = np.pi / 2.0
    R = se3.Rz(yaw - np.round(yaw / quarter) * quarter) @ _TOOL_DOWN
    up = np.stack([np.zeros_like(above), np.zeros_like(above), above], axis=-1)
    return se3.make_T(R, T_world_cube[..., :3, 3] + up)


def combine_bodies(
    m1: ArrayLike, c1: ArrayLike, I1: ArrayLike,
    m2: ArrayLike, c2: ArrayLike, I2: ArrayLike,
) -> Array:  # fmt: skip
    """Return mass, centre of mass and inertia of two bodies that are fixed together.

    The masses add up. The parallel-axis theorem, I + m (d.d 1 - d d^T), moves both
    inertias to the common centre of mass, where they are added (Modern Robotics,
    section 8.2.1).

    Args:
        m1, m2: masses in kg, at least 0 and not both 0, (...).
        c1, c2: centres of mass, expressed in one frame, metres, (..., 3).
        I1, I2: inertias, each about the body's own centre of mass, expressed in that
            frame, kg m2, (..., 3, 3).

    Returns:
        Mass (1), centre of mass (3) and inertia about it (6) in the order of MuJoCo's
        fullinertia, xx, yy, zz, xy, xz, yz, (..., 10).

    Raises:
        ValueError: wrong shape, a non-finite number, a mass below 0, or no mass at all.
    """
    m1 = checks.not_negative(m1, "m1")
    m2 = checks.not_negative(m2, "m2")
    c1 = checks.array(c1, "c1", (3,))
    c2 = checks.array(c2, "c2", (3,))
    I1 = checks.array(I1, "I1", (3, 3))
    I2 = checks.array(I2, "I2", (3, 3))
    m = checks.positive(m1 + m2, "m1 + m2")
    c = (m1[..., None] * c1 + m2[..., None] * c2) / m[..., None]
    inertia = I1 + _parallel_axis(m1, c1 - c) + I2 + _parallel_axis(m2, c2 - c)
    six = inertia[..., [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    out = np.empty((*np.broadcast_shapes(m.shape, c.shape[:-1], six.shape[:-1]), 10))
    out[..., 0] = m
    out[..., 1:4] = c
    out[..., 4:] = six
    return out


def max_cube_mass(grip: ArrayLike, mu: ArrayLike, acceleration: ArrayLike) -> Array:
    """Return the largest mass that two fingers can lift by friction.

    Each of two faces carries at most mu grip, so 2 mu grip = m (9.81 + acceleration).

    Args:
        grip: normal force of each finger in newtons, at least 0, (...).
        mu: coefficient of friction, at least 0, (...).
        acceleration: upward acceleration of the cube in m/s2, above -9.81, (...).

    Returns:
        Mass in kg, (...).

    Raises:
        ValueError: wrong shape, a non-finite number, grip or mu below 0, or a downward
            acceleration of 9.81 or more.
    """
    grip = checks.not_negative(grip, "grip")
    mu = checks.not_negative(mu, "mu")
    lift = checks.array(acceleration, "acceleration", ()) - GRAVITY[2]
    return 2.0 * mu * grip / checks.positive(lift, "9.81 + acceleration")


def _parallel_axis(m: Array, d: Array) -> Array:
    square = (d * d).sum(axis=-1)[..., None, None] * np.eye(3)
    return m[..., None, None] * (square - d[..., :, None] * d[..., None, :])
