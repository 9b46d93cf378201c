"""Operational-space and impedance control of the hand.

Conventions: twists, errors and accelerations of the hand are (angular; linear) and
wrenches (moment; force), both in the world frame at the site. `J_site` qd = (omega;
velocity of the site point); formulas abbreviate it as J. Only `bias_acceleration` takes
`J_space`. M is the mass matrix with armature. Metres, radians, newtons, kilograms. `n`
joints, `m` rows of J_site (6 for the whole hand); leading dimensions broadcast.

Sources: Khatib, "A unified approach for motion and force control of robot
manipulators", IEEE J. Robotics and Automation 3(1), 1987; Lynch and Park, Modern
Robotics (2017), sections 8.6 and 11.4 to 11.7.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.fast.vectors import cross_of, times


def task_inertia(J_site: ArrayLike, M: ArrayLike) -> Array:
    """Return the task-space inertia at the hand, Lambda = (J M^-1 J^T)^-1.

    It relates a force at the hand to the hand's acceleration (Khatib 1987; Modern
    Robotics, section 8.6).

    Args:
        J_site: site Jacobian, (..., m, n), of full row rank (no singularity).
        M: mass matrix with armature in kg m2, (..., n, n).

    Returns:
        Lambda, symmetric, (..., m, m): kg m2 in the angular block, kg in the linear.

    Raises:
        ValueError: wrong shape, a non-finite number, a hand at a singularity, or a
            singular M.
    """
    J, M = _model(J_site, M)
    try:
        Lambda = np.linalg.inv(J @ np.linalg.solve(M, _T(J)))
    except np.linalg.LinAlgError:
        raise ValueError("the hand is at a singularity, or M is singular") from None
    return (Lambda + _T(Lambda)) / 2.0


def bias_acceleration(J_space: ArrayLike, qd: ArrayLike, p: ArrayLike) -> Array:
    """Return the acceleration Jdot qd of the hand for constant joint velocities.

    A joint's screw S_i moves with the twist V_i of its link, so (omega'; v') is the sum
    of ad(V_i) S_i qd_i. The acceleration of the site point is then v' + omega' x p +
    omega x (velocity of p) (Featherstone, Rigid Body Dynamics Algorithms, 2008, section
    2.11).

    Args:
        J_space: space Jacobian, one screw (omega; v) per column, (..., 6, n).
        qd: joint velocities in rad/s, (..., n).
        p: the site point in the world frame, metres, (..., 3).

    Returns:
        (angular; linear) acceleration in rad/s2 and m/s2, (..., 6).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J_space = checks.array(J_space, "J_space", (6, "n"))
    qd = checks.array(qd, "qd", J_space.shape[-1:])
    p = checks.array(p, "p", (3,))
    Sqd = _T(J_space) * qd[..., None]  # (..., n, 6)
    V = np.cumsum(Sqd, axis=-2)  # its own part adds nothing: ad(S) S = 0
    w = V[..., :3]
    v = V[..., 3:]
    sw = Sqd[..., :3]
    sv = Sqd[..., 3:]
    alpha = cross_of(w, sw).sum(axis=-2)
    a = (cross_of(v, sw) + cross_of(w, sv)).sum(axis=-2)
    omega = w[..., -1, :]
    velocity = v[..., -1, :] + cross_of(omega, p)
    linear = a + cross_of(alpha, p) + cross_of(omega, velocity)
    return np.concatenate(np.broadcast_arrays(alpha, linear), axis=-1)


def osc_torque(
    J_site: ArrayLike,
    Lambda: ArrayLike,
    bias: ArrayLike,
    bias_acc: ArrayLike,
    acc: ArrayLike,
) -> Array:
    """Return the operational-space torque for a wanted acceleration of the hand.

    tau = J^T Lambda (acc - Jdot qd) + bias (Khatib 1987). It does not contain the joint
    damping: add damping qd, as `impedance_torque` does.

    Args:
        J_site: site Jacobian, (..., m, n).
        Lambda: task-space inertia, (..., m, m).
        bias: Coriolis, centrifugal and gravity torque in N m, (..., n).
        bias_acc: Jdot qd, as `bias_acceleration` returns it, (..., m).
        acc: wanted (angular; linear) acceleration in rad/s2 and m/s2, (..., m).

    Returns:
        Joint torques in N m, (..., n).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = checks.array(J_site, "J_site", ("m", "n"))
    m, n = J.shape[-2:]
    Lambda = checks.array(Lambda, "Lambda", (m, m))
    left = checks.array(acc, "acc", (m,)) - checks.array(bias_acc, "bias_acc", (m,))
    return times(_T(J), times(Lambda, left)) + checks.array(bias, "bias", (n,))


def nullspace_torque(
    J_site: ArrayLike, M: ArrayLike, Lambda: ArrayLike, tau: ArrayLike
) -> Array:
    """Return the part of tau in the dynamic null space of the hand.

    It is (I - J^T Lambda J M^-1) tau and does not accelerate the hand: J M^-1 times the
    result is 0 (Khatib 1987).

    Args:
        J_site: site Jacobian, (..., m, n).
        M: mass matrix with armature in kg m2, (..., n, n).
        Lambda: task-space inertia, (..., m, m).
        tau: wanted torques, of a posture for example, in N m, (..., n).

    Returns:
        Joint torques in N m, (..., n).

    Raises:
        ValueError: wrong shape, a non-finite number, or a singular M.
    """
    J, M = _model(J_site, M)
    m, n = J.shape[-2:]
    tau = checks.array(tau, "tau", (n,))
    Lambda = checks.array(Lambda, "Lambda", (m, m))
    hand_acc = J @ np.linalg.solve(M, tau[..., None])
    return tau - (_T(J) @ Lambda @ hand_acc)[..., 0]


def impedance_wrench(
    e: ArrayLike, V_err: ArrayLike, K: ArrayLike, D: ArrayLike
) -> Array:
    """Return the wrench K e + D V_err of a spring and a damper at the hand.

    Args:
        e: (rotation vector; displacement) from the hand to its target, (..., m).
        V_err: the target's twist minus the hand's, (..., m).
        K: stiffness in N m/rad and N/m, (..., m, m).
        D: damping in N m s/rad and N s/m, (..., m, m).

    Returns:
        Wrench (moment; force) in N m and N, (..., m) (Modern Robotics, section 11.7).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    e, V_err = checks.same_size(e=e, V_err=V_err)
    square = (e.shape[-1], e.shape[-1])
    K = checks.array(K, "K", square)
    D = checks.array(D, "D", square)
    return times(K, e) + times(D, V_err)


def critical_damping(K: ArrayLike, Lambda: ArrayLike) -> Array:
    """Return the damping matrix for a critically damped hand.

    D = sqrt(Lambda) sqrt(K) + sqrt(K) sqrt(Lambda); for a single mass it is
    2 sqrt(K Lambda) (Albu-Schaeffer, Ott, Frese and Hirzinger, "Cartesian impedance
    control of redundant robots", ICRA 2003, "factorization design").

    Args:
        K: stiffness along each axis in N m/rad and N/m, at least 0, (..., m).
        Lambda: task-space inertia, positive definite, (..., m, m).

    Returns:
        D, symmetric, (..., m, m), in N m s/rad and N s/m.

    Raises:
        ValueError: wrong shape, a non-finite number, K below 0, or Lambda not positive
            definite.
    """
    K = checks.not_negative(checks.array(K, "K", ("m",)), "K")
    Lambda = checks.array(Lambda, "Lambda", (K.shape[-1], K.shape[-1]))
    values, vectors = np.linalg.eigh(Lambda)
    if np.any(values <= 0.0):
        raise ValueError("Lambda is not positive definite; pass a task inertia")
    root = (vectors * np.sqrt(values)[..., None, :]) @ _T(vectors)
    k = np.sqrt(K)
    return root * k[..., None, :] + k[..., :, None] * root


def impedance_torque(
    J_site: ArrayLike,
    wrench: ArrayLike,
    bias: ArrayLike,
    damping: ArrayLike,
    qd: ArrayLike,
    tau_null: ArrayLike,
) -> Array:
    """Return the joint torque with which the hand exerts a wrench, with compensation.

    They are J^T wrench + bias + damping qd + tau_null (Modern Robotics, sections 5.2
    and 11.7).

    Args:
        J_site: site Jacobian, (..., m, n).
        wrench: (moment; force) in N m and N, (..., m).
        bias: Coriolis, centrifugal and gravity torque in N m, (..., n).
        damping: of the joints in N m s/rad, one number or (..., n).
        qd: measured velocity in rad/s, (..., n).
        tau_null: torque that does not accelerate the hand, from `nullspace_torque`,
            (..., n).

    Returns:
        Joint torques in N m, (..., n).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = checks.array(J_site, "J_site", ("m", "n"))
    m, n = J.shape[-2:]
    wrench = checks.array(wrench, "wrench", (m,))
    bias = checks.array(bias, "bias", (n,))
    qd = checks.array(qd, "qd", (n,))
    tau_null = checks.array(tau_null, "tau_null", (n,))
    friction = checks.per_joint(damping, "damping", qd) * qd
    return times(_T(J), wrench) + bias + friction + tau_null


def set_point_for_force(force: ArrayLike, k: ArrayLike, surface: ArrayLike) -> Array:
    """Return the set point below a surface with which a compliant hand exerts a force.

    Args:
        force, k: wanted force in N and stiffness in N/m, above 0, (...).
        surface: height of the surface in metres, (...).

    Returns:
        Commanded height in metres, surface - force / k, (...).

    Raises:
        ValueError: wrong shape, a non-finite number, or k not above 0.
    """
    surface = checks.array(surface, "surface", ())
    return surface - checks.array(force, "force", ()) / checks.positive(k, "k")


def hybrid_wrench(
    e: ArrayLike, V_err: ArrayLike, K: ArrayLike, D: ArrayLike, force: ArrayLike
) -> Array:
    """Return the wrench of hybrid control: force along z, impedance in all other axes.

    It is `impedance_wrench`, except that its z force is -force plus the damper's part
    (Modern Robotics, section 11.6, for a level surface).

    Args:
        e, V_err, K, D: as in `impedance_wrench`, with m = 6.
        force: wanted force along -z in newtons, (...).

    Returns:
        Wrench (moment; force) in N m and N, (..., 6).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    V_err = checks.array(V_err, "V_err", (6,))
    D = checks.array(D, "D", (6, 6))
    wrench = impedance_wrench(checks.array(e, "e", (6,)), V_err, K, D)
    down = times(D, V_err)[..., 5] - checks.array(force, "force", ())
    sideways = np.broadcast_to(wrench[..., :5], (*down.shape, 5))
    return np.concatenate([sideways, down[..., None]], axis=-1)


def _model(J: ArrayLike, M: ArrayLike) -> tuple[Array, Array]:
    J = checks.array(J, "J", ("m", "n"))
    return J, checks.array(M, "M", (J.shape[-1], J.shape[-1]))


def _T(A: Array) -> Array:
    return np.swapaxes(A, -1, -2)
