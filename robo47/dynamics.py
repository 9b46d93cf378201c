"""Rigid-body dynamics of a chain of links: mass matrix, torques, accelerations.

All quantities are expressed in the world frame about the world's origin, so the
quantities of different links can be added. The columns of the space Jacobian are the
present screws of the joints; the algorithms need no other kinematics. Conventions:

- Twists are (omega; v), wrenches (moment; force), as in *Modern Robotics*; `J_space`
  is (..., 6, n), and its column i moves link i and all links distal to it. `J_site` has
  the same shape, but it gives an M that is wrong by several kg m^2.
- Gravity is the vector g = (0, 0, -9.81), never the number 9.81.
- Radians, metres, kilograms, newtons, seconds; torques in N m.
- M contains the armature, the inertia of the motors' rotors reflected to the joints
  (Modern Robotics, section 8.9).
- Leading dimensions broadcast: one configuration, or many at once.

Sources: Lynch and Park, *Modern Robotics* (2017), chapter 8; Featherstone, *Rigid Body
Dynamics Algorithms* (2008), chapters 2, 5 and 6.
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks
from robo47.checks import Array
from robo47.fast.vectors import times
from robo47.screws import skew


def spatial_inertia(m: ArrayLike, c: ArrayLike, inertia: ArrayLike) -> Array:
    """Return the spatial inertia of a body about the world's origin.

    It is [[I + m [c] [c]^T, m [c]], [m [c]^T, m 1]] (Featherstone, eq. 2.63). For a
    body with the twist V, G @ V is its momentum and V @ G @ V / 2 its kinetic energy.

    Args:
        m: mass, kg, (...).
        c: centre of mass in the world frame, metres, (..., 3).
        inertia: I about the centre of mass, in the world frame, kg m^2, (..., 3, 3).

    Returns:
        G, (..., 6, 6): maps a twist (omega; v) to the momentum (angular; linear).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    m = checks.array(m, "m", ())[..., None, None]
    C = skew(c)
    own = checks.array(inertia, "inertia", (3, 3))
    corner = m * C
    around = own + corner @ np.swapaxes(C, -1, -2)
    G = np.empty((*around.shape[:-2], 6, 6))
    G[..., :3, :3] = around
    G[..., :3, 3:] = corner
    G[..., 3:, :3] = np.swapaxes(corner, -1, -2)
    G[..., 3:, 3:] = m * np.eye(3)
    return G


def link_inertias(
    T_links: ArrayLike, masses: ArrayLike, coms: ArrayLike, inertias: ArrayLike
) -> Array:
    """Return the spatial inertia of every link at its current pose.

    A centre of mass moves with its link, R c + p, and an inertia rotates with it,
    R I R^T.

    Args:
        T_links: `T_world_link` of each link, (..., n, 4, 4).
        masses: kg, (n,).
        coms: centres of mass in the link frames, metres, (n, 3).
        inertias: about the centres of mass, in the link frames, kg m^2, (n, 3, 3).

    Returns:
        G of each link, (..., n, 6, 6).

    Raises:
        ValueError: wrong shape, a non-finite number, or not poses.
    """
    T = checks.pose(T_links, "T_links")
    coms = checks.array(coms, "coms", (3,))
    inertias = checks.array(inertias, "inertias", (3, 3))
    R = T[..., :3, :3]
    p = T[..., :3, 3]
    rotated = R @ inertias @ np.swapaxes(R, -1, -2)
    return spatial_inertia(masses, times(R, coms) + p, rotated)


def mass_matrix(J_space: ArrayLike, G: ArrayLike, armature: ArrayLike) -> Array:
    """Return the mass matrix M, for which qd @ M @ qd / 2 is the kinetic energy.

    M is the sum over the links of J_i^T G_i J_i, where J_i is J_space with zeros in the
    columns after i, plus the armature on the diagonal (Modern Robotics, section 8.4).

    Args:
        J_space: space Jacobian, (..., 6, n).
        G: spatial inertias of the links about the world's origin, (..., n, 6, 6).
        armature: kg m^2, a number or (n,).

    Returns:
        M, kg m^2, (..., n, n): symmetric and positive definite.

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = checks.array(J_space, "J_space", (6, "n"))
    n = J.shape[-1]
    G = checks.array(G, "G", (n, 6, 6))
    armature = np.broadcast_to(checks.array(armature, "armature", ()), n)
    # Joint i carries link i and all later links (Featherstone's composite bodies).
    carried = np.cumsum(G[..., ::-1, :, :], axis=-3)[..., ::-1, :, :]
    momenta = times(carried, np.swapaxes(J, -1, -2))
    lower = np.tril(momenta @ J)  # entries (i, j) with j <= i
    return lower + np.swapaxes(np.tril(lower, -1), -1, -2) + np.diag(armature)


def gravity_torque(
    J_space: ArrayLike, masses: ArrayLike, coms_world: ArrayLike, g: ArrayLike
) -> Array:
    """Return the joint torque that holds the arm against gravity.

    It is minus the sum of m J_v(c)^T g over the links that the joint carries. Column i
    of J_v(c) is v + omega x c, the velocity of the centre of mass c for a unit velocity
    of joint i (Modern Robotics, section 8.4).

    Args:
        J_space: space Jacobian, (..., 6, n).
        masses: kg, (n,).
        coms_world: centres of mass in the world frame, metres, (..., n, 3).
        g: gravity, m/s^2, (3,).

    Returns:
        Torques, N m, (..., n).

    Raises:
        ValueError: wrong shape, a non-finite number, or g is one number.
    """
    J = checks.array(J_space, "J_space", (6, "n"))
    n = J.shape[-1]
    coms = checks.array(coms_world, "coms_world", (n, 3))
    weights = checks.array(masses, "masses", (n,))[..., None] * _gravity(g)
    moments = times(skew(coms), weights)
    forces = np.broadcast_to(weights, moments.shape)
    return -_along_joints(J, np.concatenate([moments, forces], axis=-1))


def ad(V: ArrayLike) -> Array:
    """Return ad(V): the rate of change of a twist that moves with V is ad(V) times it.

    A twist W that moves with a body of twist V changes at the rate ad(V) @ W. The
    matrix is [[[omega], 0], [[v], [omega]]], and ad(V) @ V = 0 (Modern Robotics,
    section 8.2.2).

    Args:
        V: twist (omega; v), rad/s and m/s, (..., 6).

    Returns:
        Matrix for twists (omega; v), (..., 6, 6).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    V = checks.array(V, "V", (6,))
    out = np.zeros((*V.shape, 6))
    out[..., :3, :3] = out[..., 3:, 3:] = skew(V[..., :3])
    out[..., 3:, :3] = skew(V[..., 3:])
    return out


def inverse_dynamics(
    J_space: ArrayLike, G: ArrayLike, qd: ArrayLike, qdd: ArrayLike, g: ArrayLike
) -> Array:
    """Return the torque for an acceleration by the recursive Newton-Euler algorithm.

    Velocities and accelerations are propagated outwards, wrenches inwards:

        V_i = V_(i-1) + S_i qd_i                        V_0 = 0
        A_i = A_(i-1) + S_i qdd_i + ad(V_i) S_i qd_i    A_0 = (0; -g)
        F_i = G_i A_i - ad(V_i)^T G_i V_i               tau_i = S_i . (F_i + ... + F_n)

    with S_i the columns of J_space (Modern Robotics, section 8.3; Featherstone, section
    5.3). The acceleration A_0 of the base has the same effect as gravity.

    Args:
        J_space: space Jacobian, (..., 6, n).
        G: spatial inertias of the links about the world's origin, (..., n, 6, 6).
        qd: joint velocities, rad/s, (..., n).
        qdd: joint accelerations, rad/s^2, (..., n).
        g: acceleration of gravity, m/s^2, (3,).

    Returns:
        Torque of the links, N m, (..., n), without armature and damping.

    Raises:
        ValueError: wrong shape, a non-finite number, or g is one number.
    """
    J = checks.array(J_space, "J_space", (6, "n"))
    n = J.shape[-1]
    G = checks.array(G, "G", (n, 6, 6))
    qd = checks.array(qd, "qd", (n,))[..., None]
    qdd = checks.array(qdd, "qdd", (n,))[..., None]
    S = np.swapaxes(J, -1, -2)
    V = np.cumsum(S * qd, axis=-2)
    ad_V = ad(V)
    A = np.cumsum(S * qdd + times(ad_V, S * qd), axis=-2)
    A = A + np.concatenate([np.zeros(3), -_gravity(g)])
    F = times(G, A) - times(np.swapaxes(ad_V, -1, -2), times(G, V))
    return _along_joints(J, F)


def bias_torque(J_space: ArrayLike, G: ArrayLike, qd: ArrayLike, g: ArrayLike) -> Array:
    """Return the bias torque: the Coriolis, centrifugal and gravity torques together.

    This is the inverse dynamics with qdd = 0. MuJoCo calls it qfrc_bias.

    Args:
        J_space, G, qd, g: as in `inverse_dynamics`.

    Returns:
        Torques, N m, (..., n).

    Raises:
        ValueError: as `inverse_dynamics`.
    """
    return inverse_dynamics(J_space, G, qd, np.zeros(np.shape(J_space)[-1:]), g)


def coriolis_matrix(J_space: ArrayLike, G: ArrayLike, qd: ArrayLike) -> Array:
    """Return the Coriolis matrix C(q, qd); C qd is the Coriolis and centrifugal torque.

    Several matrices have this product. This one consists of Christoffel symbols, C_ij =
    sum of (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i) qd_k / 2, so dM/dt = C + C^T, and
    dM/dt - 2 C is skew-symmetric (Modern Robotics, section 8.1.2 and proposition 8.1).
    It is the sum over the links of J_i^T (G_i Jdot_i + B_i J_i), where B_i depends on
    the link's twist and inertia (Echeandia and Wensing, "Numerical methods to compute
    the Coriolis matrix and Christoffel symbols for rigid-body systems", J.
    Computational and Nonlinear Dynamics 16(9), 2021).

    Args:
        J_space, G, qd: as in `inverse_dynamics`.

    Returns:
        C, N m s/rad, (..., n, n).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = checks.array(J_space, "J_space", (6, "n"))
    n = J.shape[-1]
    G = checks.array(G, "G", (n, 6, 6))
    qd = checks.array(qd, "qd", (n,))[..., None]
    S = np.swapaxes(J, -1, -2)
    V = np.cumsum(S * qd, axis=-2)
    ad_V = ad(V)
    S_rate = times(ad_V, S)  # a screw moves with its own link
    B = _velocity_product(G, V, ad_V)
    # Joint i carries link i and all later links, as in `mass_matrix`.
    carried_G = np.cumsum(G[..., ::-1, :, :], axis=-3)[..., ::-1, :, :]
    carried_B = np.cumsum(B[..., ::-1, :, :], axis=-3)[..., ::-1, :, :]
    # The links that both joints move begin with the later one of the two.
    later = times(carried_G, S_rate) + times(carried_B, S)
    upper = np.triu(S @ np.swapaxes(later, -1, -2))
    momenta = times(carried_G, S)
    back = times(np.swapaxes(carried_B, -1, -2), S)
    lower = momenta @ np.swapaxes(S_rate, -1, -2) + back @ J
    return upper + np.tril(lower, -1)


def forward_dynamics(
    M: ArrayLike, bias: ArrayLike, damping: ArrayLike, qd: ArrayLike, tau: ArrayLike
) -> Array:
    """Return the joint accelerations for given torques.

    They solve M qdd = tau - bias - damping qd (Modern Robotics, section 8.5).

    Args:
        M: mass matrix with armature, kg m^2, (..., n, n).
        bias: Coriolis, centrifugal and gravity torque, N m, (..., n).
        damping: of the joints, N m s/rad, a number or (n,).
        qd: joint velocities, rad/s, (..., n).
        tau: torques of the motors, N m, (..., n).

    Returns:
        qdd, rad/s^2, (..., n).

    Raises:
        ValueError: wrong shape, a non-finite number, or a singular M.
    """
    bias, qd, tau = checks.same_size(bias=bias, qd=qd, tau=tau)
    M = checks.array(M, "M", (qd.shape[-1], qd.shape[-1]))
    net = tau - bias - checks.array(damping, "damping", ()) * qd
    return np.linalg.solve(M, net[..., None])[..., 0].astype(np.float64, copy=False)


def energy(
    M: ArrayLike, qd: ArrayLike, masses: ArrayLike, coms_world: ArrayLike, g: ArrayLike
) -> Array:
    """Return the kinetic and the potential energy of the moving links.

    They are qd . M qd / 2 and minus the sum of m g . c (Modern Robotics, section
    8.1.1). Their sum is constant if no motor and no friction acts.

    Args:
        M: mass matrix, kg m^2, (..., n, n).
        qd: joint velocities, rad/s, (..., n).
        masses, coms_world, g: as in `gravity_torque`.

    Returns:
        (kinetic, potential) in joules, (..., 2). The potential energy of a mass at the
        world's origin is 0.

    Raises:
        ValueError: wrong shape, a non-finite number, or g is one number.
    """
    qd, masses = checks.same_size(qd=qd, masses=masses)
    n = qd.shape[-1]
    M = checks.array(M, "M", (n, n))
    coms = checks.array(coms_world, "coms_world", (n, 3))
    kinetic = 0.5 * (qd * times(M, qd)).sum(axis=-1)
    potential = -(masses * (coms @ _gravity(g))).sum(axis=-1)
    return np.stack(np.broadcast_arrays(kinetic, potential), axis=-1)


def _velocity_product(G: Array, V: Array, ad_V: Array) -> Array:
    """Return B, half of -ad(V)^T G - G ad(V) + [G V]*: B V = -ad(V)^T G V."""
    momentum = times(G, V)
    moment = skew(momentum[..., :3])
    force = skew(momentum[..., 3:])
    crossed = np.zeros_like(ad_V)  # maps a twist m to -ad(m)^T G V
    crossed[..., :3, :3] = -moment
    crossed[..., :3, 3:] = -force
    crossed[..., 3:, :3] = -force
    return 0.5 * (crossed - np.swapaxes(ad_V, -1, -2) @ G - G @ ad_V)


def _along_joints(J: Array, wrenches: Array) -> Array:
    """Return the torques of the wrenches on each link and on all links distal to it."""
    carried = np.cumsum(wrenches[..., ::-1, :], axis=-2)[..., ::-1, :]
    return (np.swapaxes(J, -1, -2) * carried).sum(axis=-1)


def _gravity(g: ArrayLike) -> Array:
    if np.ndim(g) == 0:
        raise ValueError(f"g is the number {g!r}; expected a vector: (0, 0, -9.81)")
    return checks.array(g, "g", (3,))
