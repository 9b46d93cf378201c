"""Joint control: PD, gravity compensation, computed torque, PID and their responses.

Conventions: e = q_ref - q and ed = qd_ref - qd, so a positive error causes a positive
torque. Radians, rad/s, rad/s2, N m, seconds. `n` is the number of joints; leading
dimensions broadcast. A gain is one number for all joints, or (n,).

Sources: Lynch and Park, Modern Robotics (2017), chapter 11: section 11.2 for error
dynamics, 11.4 for torque control.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array


def pd_torque(e: ArrayLike, ed: ArrayLike, kp: ArrayLike, kd: ArrayLike) -> Array:
    """Return the torque of a PD controller, kp e + kd ed.

    It acts like a spring and a damper at every joint (Modern Robotics, section 11.4.1).

    Args:
        e, ed: errors in radians and rad/s, (..., n).
        kp, kd: gains in N m/rad and N m s/rad, one number or (..., n).

    Returns:
        Joint torques in N m, (..., n).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    e, ed = checks.same_size(e=e, ed=ed)
    return checks.per_joint(kp, "kp", e) * e + checks.per_joint(kd, "kd", e) * ed


def pd_gains(omega: ArrayLike, zeta: ArrayLike) -> Array:
    """Return PD gains per unit of inertia for a natural frequency and a damping ratio.

    The error dynamics edd + kd ed + kp e = 0 have the natural frequency omega and the
    damping ratio zeta for kp = omega^2 and kd = 2 zeta omega (Modern Robotics, section
    11.2.2).

    Args:
        omega: natural frequency, rad/s, (...).
        zeta: damping ratio, 1 for critical damping, (...).

    Returns:
        kp in 1/s2 and kd in 1/s, (..., 2).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    omega = checks.array(omega, "omega", ())
    zeta = checks.array(zeta, "zeta", ())
    omega, zeta = np.broadcast_arrays(omega, zeta)
    return np.stack([omega**2, 2.0 * zeta * omega], axis=-1)


def error_response(t: ArrayLike, omega: ArrayLike, zeta: ArrayLike) -> Array:
    """Return the error response from 1 at rest, for edd + kd ed + kp e = 0.

    With r = zeta omega and w^2 = omega^2 - r^2, the error is
    e^(-r t) (cos(w t) + r sin(w t) / w). At critical damping its limit is
    (1 + omega t) e^(-omega t); for larger zeta the cosine and sine become cosh and sinh
    (Modern Robotics, section 11.2.2). The implementation neither overflows nor divides
    by w, so zeta may be 1.

    Args:
        t: time, s, at least 0, (...).
        omega: natural frequency, rad/s, above 0, (...).
        zeta: damping ratio, at least 0, (...).

    Returns:
        The error as a fraction of the initial error, (...).

    Raises:
        ValueError: wrong shape, a non-finite number, omega not above 0, or t or zeta
            below 0.
    """
    t = checks.not_negative(t, "t")
    omega = checks.positive(omega, "omega")
    zeta = checks.not_negative(zeta, "zeta")
    rate = zeta * omega
    swing = omega * np.sqrt(np.maximum(1.0 - zeta**2, 0.0))
    under = np.exp(-rate * t) * (
        np.cos(swing * t) + rate * t * np.sinc(swing * t / np.pi)
    )
    spread = omega * np.sqrt(np.maximum(zeta**2 - 1.0, 0.0))
    # rate - spread, written without the cancellation; any number where it is not used
    slow = omega**2 / np.where(zeta < 1.0, omega, rate + spread)
    gap = 2.0 * spread * t
    ratio = np.where(gap == 0.0, 1.0, -np.expm1(-gap) / np.where(gap == 0, 1.0, gap))
    over = np.exp(-slow * t) * ((1.0 + np.exp(-gap)) / 2.0 + rate * t * ratio)
    return np.where(zeta < 1.0, under, over)


def pd_equilibrium_step(q_goal: ArrayLike, g_at_q: ArrayLike, kp: ArrayLike) -> Array:
    """Return the next iterate of the equilibrium of PD without gravity compensation.

    At the equilibrium kp (q_goal - q) = g(q), so q = q_goal - g(q) / kp. Repeated with
    g at the last result until nothing changes, it gives the configuration to which the
    arm sags.

    Args:
        q_goal: commanded configuration, rad, (..., n).
        g_at_q: gravity torque at the present q, N m, (..., n).
        kp: stiffness, N m/rad, above 0, one number or (..., n).

    Returns:
        The next q, rad, (..., n).

    Raises:
        ValueError: wrong shape, a non-finite number, or kp not above 0.
    """
    q_goal, g_at_q = checks.same_size(q_goal=q_goal, g_at_q=g_at_q)
    kp = checks.positive(checks.per_joint(kp, "kp", q_goal), "kp")
    return q_goal - g_at_q / kp


def gravity_pd(
    e: ArrayLike, ed: ArrayLike, kp: ArrayLike, kd: ArrayLike, g_at_q: ArrayLike
) -> Array:
    """Return the torque of a PD controller with gravity compensation.

    tau = kp e + kd ed + g(q) (Modern Robotics, section 11.4.2).

    Args:
        e, ed, kp, kd: as in `pd_torque`.
        g_at_q: gravity torque at the measured q, N m, (..., n).

    Returns:
        Joint torques, N m, (..., n).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    e, g_at_q = checks.same_size(e=e, g_at_q=g_at_q)
    return pd_torque(e, ed, kp, kd) + g_at_q


def computed_torque(
    M: ArrayLike,
    bias: ArrayLike,
    damping: ArrayLike,
    qd: ArrayLike,
    e: ArrayLike,
    ed: ArrayLike,
    qdd_ref: ArrayLike,
    kp: ArrayLike,
    kd: ArrayLike,
) -> Array:
    """Return the computed torque, which linearises the error dynamics of every joint.

    tau = M (qdd_ref + kd ed + kp e) + bias + damping qd, so that the error satisfies
    edd + kd ed + kp e = 0. The gains are inside the product with M; otherwise the error
    does not decay as designed (Modern Robotics, section 11.4.2, "computed torque
    control").

    Args:
        M: mass matrix with armature in kg m2, (..., n, n).
        bias: Coriolis, centrifugal and gravity torque in N m, (..., n).
        damping: of the joints in N m s/rad, one number or (..., n).
        qd: measured velocity in rad/s, (..., n).
        e, ed: errors in radians and rad/s, (..., n).
        qdd_ref: reference acceleration in rad/s2, (..., n).
        kp, kd: gains in 1/s2 and 1/s, one number or (..., n).

    Returns:
        Joint torques in N m, (..., n).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    bias, qd, qdd_ref, e, ed = checks.same_size(
        bias=bias, qd=qd, qdd_ref=qdd_ref, e=e, ed=ed
    )
    M = checks.array(M, "M", (bias.shape[-1], bias.shape[-1]))
    acc = qdd_ref + pd_torque(e, ed, kp, kd)
    friction = checks.per_joint(damping, "damping", qd) * qd
    return (M @ acc[..., None])[..., 0] + bias + friction


def pid_step(
    e: ArrayLike,
    ed: ArrayLike,
    integral: ArrayLike,
    kp: ArrayLike,
    kd: ArrayLike,
    ki: ArrayLike,
    dt: float,
    clamp: ArrayLike,
) -> tuple[Array, Array]:
    """Return the acceleration of a PID controller and its integral with anti-windup.

    The integral grows by e dt and is clamped to +-clamp before it is used (Modern
    Robotics, section 11.4.1).

    Args:
        e, ed: errors in radians and rad/s, (..., n).
        integral: of the step before, or zeros, in rad s, (..., n).
        kp, kd, ki: gains in 1/s2, 1/s and 1/s3, one number or (..., n).
        dt: time since the last step in seconds.
        clamp: largest magnitude of the integral in rad s, one number or (..., n).

    Returns:
        Acceleration in rad/s2, (..., n), and the new integral in rad s, (..., n).

    Raises:
        ValueError: wrong shape, a non-finite number, or a clamp below 0.
    """
    e, integral = checks.same_size(e=e, integral=integral)
    clamp = checks.not_negative(checks.per_joint(clamp, "clamp", e), "clamp")
    integral = np.clip(integral + e * checks.array(dt, "dt", ()), -clamp, clamp)
    acc = pd_torque(e, ed, kp, kd) + checks.per_joint(ki, "ki", e) * integral
    return acc, integral


def saturate(tau: ArrayLike, limits: ArrayLike) -> Array:
    """Return the torque within the limits of the motors, clamped joint by joint.

    Args:
        tau: wanted torques in N m, (..., n).
        limits: largest torques in N m, at least 0, one number or (..., n).

    Returns:
        Torques within +-limits in N m, (..., n).

    Raises:
        ValueError: wrong shape, a non-finite number, or a limit below 0.
    """
    tau = checks.array(tau, "tau", ("n",))
    limits = checks.not_negative(checks.per_joint(limits, "limits", tau), "limits")
    return np.clip(tau, -limits, limits)


def max_stable_omega(h: ArrayLike, steps: ArrayLike = 1) -> Array:
    """Return the largest stable omega of critical damping with a torque that is held.

    edd = -omega^2 e - 2 omega ed is computed once and held for n semi-implicit steps
    of h seconds, T = n h: ed changes by T edd, e by T ed + (1 + 1/n) T^2 edd / 2. This
    map of (e, ed) has the eigenvalue -1 where 4 - 4 omega T - (omega T)^2 / n = 0, so
    at omega h = 2 (sqrt(1 + 1/n) - 1). omega T is 0.828 for one step per period and
    approaches 1 for many (our derivation).

    Args:
        h: time step in seconds, above 0, (...).
        steps: number n of steps for which a torque is held, above 0, (...).

    Returns:
        Natural frequency, rad/s, (...).

    Raises:
        ValueError: wrong shape, a non-finite number, or one not above 0.
    """
    h = checks.positive(h, "h")
    steps = checks.positive(steps, "steps")
    return 2.0 * (np.sqrt(1.0 + 1.0 / steps) - 1.0) / h


def servo_ctrl(
    tau: ArrayLike, q: ArrayLike, qd: ArrayLike, kp: ArrayLike, kd: ArrayLike
) -> Array:
    """Return the command with which a position servo exerts a wanted torque.

    The servo exerts kp (ctrl - q) - kd qd, so ctrl = q + (tau + kd qd) / kp.

    Args:
        tau: wanted torques in N m, (..., n).
        q, qd: measured, in radians and rad/s, (..., n).
        kp, kd: the servo's gains in N m/rad (above 0) and N m s/rad, one number or
            (..., n).

    Returns:
        Commanded configuration, rad, (..., n).

    Raises:
        ValueError: wrong shape, a non-finite number, or kp not above 0.
    """
    tau, q, qd = checks.same_size(tau=tau, q=q, qd=qd)
    kp = checks.positive(checks.per_joint(kp, "kp", q), "kp")
    return q + (tau + checks.per_joint(kd, "kd", q) * qd) / kp
