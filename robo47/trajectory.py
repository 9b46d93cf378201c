"""Trajectories: paths in joint space and between poses, and their time scalings.

Conventions: the path parameter s runs from 0 to 1; sd and sdd are its derivatives with
respect to time in 1/s and 1/s2. Radians, metres, seconds. `n` is the number of joints;
leading dimensions broadcast. A time scaling is at rest before 0 and after its duration.

Sources: Lynch and Park, Modern Robotics (2017), chapter 9 (sections 9.2 and 9.3).
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, screws, se3
from robo47.checks import Array
from robo47.lifting import combine_bodies as combine_bodies  # labs type these here
from robo47.lifting import grasp_pose as grasp_pose
from robo47.lifting import max_cube_mass as max_cube_mass
from robo47.rotation_log import log_rotation

# The quintic's maximum velocity times the duration, and acceleration times its square.
PEAK_SPEED = 15.0 / 8.0
PEAK_ACCELERATION = 10.0 / np.sqrt(3.0)


def quintic_scaling(t: ArrayLike, duration: ArrayLike) -> Array:
    """Return s, sd and sdd of the quintic time scaling from rest to rest.

    s = 10 x^3 - 15 x^4 + 6 x^5 with x = t / duration clamped to 0 to 1. Velocity and
    acceleration are 0 at both ends (Modern Robotics, section 9.2.2).

    Args:
        t: time in seconds, (...).
        duration: of the whole motion in seconds, above 0, (...).

    Returns:
        s, sd in 1/s and sdd in 1/s2, (..., 3).

    Raises:
        ValueError: wrong shape, a non-finite number, or a duration not above 0.
    """
    t = checks.array(t, "t", ())
    duration = checks.positive(duration, "duration")
    x = np.clip(t / duration, 0.0, 1.0)
    s = x**3 * (10.0 - 15.0 * x + 6.0 * x**2)
    sd = 30.0 * x**2 * (1.0 - x) ** 2 / duration
    sdd = 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x) / duration**2
    return np.stack([s, sd, sdd], axis=-1)


def quintic_duration(delta_q: ArrayLike, v_max: ArrayLike, a_max: ArrayLike) -> Array:
    """Return the shortest duration of a quintic motion within all joint limits.

    A quintic over delta_q in the duration T has the maximum velocity 15/8 delta_q / T
    and the maximum acceleration 10/sqrt(3) delta_q / T^2. The slowest joint determines
    the result (Modern Robotics, section 9.2.2).

    Args:
        delta_q: displacement of each joint in radians, of either sign, (..., n).
        v_max: velocity limits in rad/s, above 0, infinity for none, one or (..., n).
        a_max: acceleration limits in rad/s2, likewise.

    Returns:
        Duration in seconds, (...); 0 if no joint moves.

    Raises:
        ValueError: wrong shape, NaN, an infinite delta_q, or a limit not above 0.
    """
    delta_q = np.abs(checks.array(delta_q, "delta_q", ("n",)))
    by_speed = PEAK_SPEED * delta_q / _limit(v_max, "v_max", delta_q)
    by_acceleration = np.sqrt(
        PEAK_ACCELERATION * delta_q / _limit(a_max, "a_max", delta_q)
    )
    return np.maximum(by_speed, by_acceleration).max(axis=-1)


def joint_trajectory(
    q0: ArrayLike, q1: ArrayLike, t: ArrayLike, duration: ArrayLike
) -> Array:
    """Return q, qd and qdd on a straight line in joint space, with a quintic scaling.

    q is q0 + (q1 - q0) s, and qd and qdd are its derivatives (Modern Robotics, section
    9.2.1).

    Args:
        q0, q1: first and last configuration in radians, (..., n).
        t: time in seconds, (...).
        duration: of the whole motion in seconds, above 0, (...).

    Returns:
        q, qd in rad/s and qdd in rad/s2, stacked, (..., 3, n).

    Raises:
        ValueError: wrong shape, a non-finite number, or a duration not above 0.
    """
    q0, q1 = checks.same_size(q0=q0, q1=q1)
    move = quintic_scaling(t, duration)[..., None] * (q1 - q0)[..., None, :]
    start = np.zeros_like(move)
    start[..., 0, :] = q0
    return start + move


def trapezoidal_profile(
    t: ArrayLike, L: ArrayLike, v: ArrayLike, a: ArrayLike
) -> Array:
    """Return position, velocity and acceleration of the trapezoidal velocity profile.

    If L is too short to reach v, the profile is a triangle with the highest velocity
    sqrt(L a) (Modern Robotics, section 9.2.2). With the highest velocity `top` the
    duration is L / top + top / a.

    Args:
        t: time in seconds, (...).
        L: distance, at least 0, (...).
        v: velocity limit, above 0, (...).
        a: acceleration limit, above 0, (...).

    Returns:
        Position, velocity and acceleration in units of L, per s and per s2, (..., 3).

    Raises:
        ValueError: wrong shape, a non-finite number, L below 0, or v or a not above 0.
    """
    t = checks.array(t, "t", ())
    L = checks.not_negative(L, "L")
    v = checks.positive(v, "v")
    a = checks.positive(a, "a")
    top = np.minimum(v, np.sqrt(L * a))
    ramp = top / a
    # top is 0 where there is no way to go
    duration = L / np.where(top > 0.0, top, 1.0) + ramp
    up = np.clip(t, 0.0, ramp)
    left = np.clip(duration - t, 0.0, ramp)
    cruise = np.clip(t - ramp, 0.0, duration - 2.0 * ramp)
    ended = t >= duration
    done = a * up**2 / 2.0 + top * cruise + a * (ramp**2 - left**2) / 2.0
    speed = a * np.minimum(up, left)
    acc = np.where(t < ramp, a, np.where(t > duration - ramp, -a, 0.0))
    acc = np.where((t < 0.0) | ended, 0.0, acc)
    return np.stack(np.broadcast_arrays(np.where(ended, L, done), speed, acc), axis=-1)


def quintic_coefficients(
    start: ArrayLike, end: ArrayLike, duration: ArrayLike
) -> Array:
    """Return the coefficients of the quintic between two states.

    Position, velocity and acceleration at both ends give six linear equations for six
    coefficients (Modern Robotics, section 9.3).

    Args:
        start: position, velocity, acceleration at t = 0, (..., 3).
        end: the same at t = duration, (..., 3).
        duration: of the whole motion in seconds, above 0, (...).

    Returns:
        Coefficients of 1, t, ..., t^5, (..., 6).

    Raises:
        ValueError: wrong shape, a non-finite number, or a duration not above 0.
    """
    start = checks.array(start, "start", (3,))
    end = checks.array(end, "end", (3,))
    duration = checks.positive(duration, "duration")
    powers = np.arange(6)
    first = powers * duration[..., None] ** np.maximum(powers - 1, 0)
    second = powers * (powers - 1) * duration[..., None] ** np.maximum(powers - 2, 0)
    A = np.zeros((*duration.shape, 6, 6))
    A[..., 0, 0] = A[..., 1, 1] = 1.0
    A[..., 2, 2] = 2.0
    A[..., 3, :] = duration[..., None] ** powers
    A[..., 4, :] = first
    A[..., 5, :] = second
    wanted = np.concatenate(np.broadcast_arrays(start, end), axis=-1)
    return np.linalg.solve(A, wanted[..., None])[..., 0]


def interpolate_pose(T0: ArrayLike, T1: ArrayLike, s: ArrayLike) -> Array:
    """Return the pose at the fraction s of a straight line, with slerp for rotation.

    p = p0 + s (p1 - p0) and R = R0 exp(s log(R0^T R1)): position and orientation are
    decoupled, so the origin moves on a straight line (Modern Robotics, section 9.2.1,
    eq. 9.8).

    Args:
        T0, T1: first and last pose, (..., 4, 4).
        s: fraction of the path, (...).

    Returns:
        Pose, (..., 4, 4).

    Raises:
        ValueError: wrong shape, a non-finite number, or not poses.
    """
    T0 = checks.pose(T0, "T0")
    T1 = checks.pose(T1, "T1")
    s = checks.array(s, "s", ())
    R0 = T0[..., :3, :3]
    p0 = T0[..., :3, 3]
    turn = log_rotation(np.swapaxes(R0, -1, -2) @ T1[..., :3, :3])
    angle = np.linalg.norm(turn, axis=-1)
    axis = np.where(angle[..., None] > 0.0, turn, [0.0, 0.0, 1.0])
    R = R0 @ screws.axis_angle(axis, s * angle)
    return se3.make_T(R, p0 + s[..., None] * (T1[..., :3, 3] - p0))


def _limit(value: ArrayLike, name: str, dq: Array) -> Array:
    """Return limits above 0, where infinity is allowed and means none."""
    value = np.asarray(value, dtype=np.float64)
    none = np.isposinf(value)
    finite = checks.per_joint(np.where(none, 1.0, value), name, dq)
    return np.where(none, np.inf, checks.positive(finite, name))
