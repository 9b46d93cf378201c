"""Lifting a cube: where the tool stands, what the hand weighs then, what slips.

Conventions: poses are `T_world_x`. Metres, kilograms, newtons; an inertia is about its
body's centre of mass. Leading dimensions broadcast.

Source: Lynch and Park, Modern Robotics (2017), section 8.2 for inertias; Coulomb
friction, section 12.2.1, for what two fingers hold.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.checks import Array
from robo47.gravity import GRAVITY

_TOOL_DOWN = np.diag([1.0, -1.0, -1.0])  # z down, x as the world's


def grasp_pose(T_world_cube: ArrayLike, above: ArrayLike) -> Array:
    """Return the tool's pose over a cube: pointing down, fingers along a near side.

    A cube looks the same after a quarter turn, so its yaw is folded into +-45 degrees:
    from READY_Q the tool is never far to turn.

    Args:
        T_world_cube: pose of a cube that stands on one of its faces, its z axis up
            or down, (..., 4, 4).
        above: height of the tool over the cube's centre in metres, (...).

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
    """Return the one body that two bodies are when the first holds the second.

    Masses add up; the inertias are moved to the common centre of mass by the
    parallel-axis theorem, I + m (d.d 1 - d d^T), and added (Modern Robotics,
    section 8.2.1).

    Args:
        m1, m2: masses in kg, at least 0 and not both 0, (...).
        c1, c2: centres of mass in metres, in one frame for both, (..., 3).
        I1, I2: inertias about the own centre of mass, in the axes of that frame,
            kg m2, (..., 3, 3).

    Returns:
        Mass, centre of mass (3) and inertia about it as MuJoCo's fullinertia orders
        it (xx, yy, zz, xy, xz, yz), (..., 10).

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
    """Return the mass that two fingers lift: 2 mu grip = m (g + acceleration).

    Args:
        grip: force of one finger in newtons, at least 0, (...).
        mu: coefficient of friction, at least 0, (...).
        acceleration: upwards, in m/s2, above -9.81, (...).

    Returns:
        Mass in kg, (...).

    Raises:
        ValueError: wrong shape, a non-finite number, grip or mu below 0, or a fall as
            fast as gravity's or faster.
    """
    grip = checks.not_negative(grip, "grip")
    mu = checks.not_negative(mu, "mu")
    lift = checks.array(acceleration, "acceleration", ()) - GRAVITY[2]
    return 2.0 * mu * grip / checks.positive(lift, "9.81 + acceleration")


def _parallel_axis(m: Array, d: Array) -> Array:
    square = (d * d).sum(axis=-1)[..., None, None] * np.eye(3)
    return m[..., None, None] * (square - d[..., :, None] * d[..., None, :])
