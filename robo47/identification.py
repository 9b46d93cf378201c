"""Dynamic parameter identification: regressors, least-squares fits and their accuracy.

The torque of a motion is linear in ten inertial parameters per link, tau = Y(q, qd,
qdd) phi, where Y is called the regressor. A model can therefore be fitted to measured
torques, and the singular values of Y show which combinations of parameters a motion
identifies. Conventions:

- phi of a body is (m, m c, Ixx, Iyy, Izz, Ixy, Ixz, Iyz), (10,): its mass, its first
  moment of mass, and the entries of its inertia about the *origin* of the body frame
  (not about the centre of mass). kg, kg m, kg m^2.
- Twists are (omega; v), wrenches (moment; force); `J_space` is the space Jacobian.
- Gravity is the vector g = (0, 0, -9.81), as in `robo47.dynamics`.
- Bodies and motions broadcast; a fit takes one matrix.

Sources: Lynch and Park, *Modern Robotics* (2017), sections 8.2.2 and 8.3; Siciliano and
others, *Robotics* (2009), section 7.2.2; Golub and Van Loan, *Matrix Computations*,
section 5.5; Wensing, Kim and Slotine, "Linear matrix inequalities for physically
consistent inertial parameter identification" (2018).
"""

import numpy as np
from numpy.typing import ArrayLike

from robo47 import checks, se3
from robo47.checks import Array
from robo47.dynamics import ad
from robo47.fast.vectors import times
from robo47.screws import adjoint, skew

_UPPER = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # indices of Ixx ... Iyz


def spatial_inertia_from_params(phi: ArrayLike) -> Array:
    """Return the spatial inertia of a body, [[I, [h]], [[h]^T, m 1]], linear in phi.

    Here h = m c is the first moment of mass and I the inertia about the origin, so no
    entry contains a product of two parameters.

    Args:
        phi: inertial parameters, (..., 10); a unit vector, whose mass may be 0, too.

    Returns:
        G, (..., 6, 6): maps a twist (omega; v) to the momentum (angular; linear).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    phi = checks.array(phi, "phi", (10,))
    G = np.zeros((*phi.shape[:-1], 6, 6))
    for k, (i, j) in enumerate(_UPPER):
        G[..., i, j] = G[..., j, i] = phi[..., 4 + k]
    H = skew(phi[..., 1:4])
    G[..., :3, 3:] = H
    G[..., 3:, :3] = np.swapaxes(H, -1, -2)
    G[..., 3:, 3:] = phi[..., 0, None, None] * np.eye(3)
    return G


def inertial_parameters(
    masses: ArrayLike, coms: ArrayLike, inertias: ArrayLike
) -> Array:
    """Return the inertial parameters phi of bodies with known centres of mass.

    The parallel-axis theorem moves the inertia from the centre of mass to the origin.

    Args:
        masses: kg, (...).
        coms: centres of mass in the body frame, metres, (..., 3).
        inertias: about the centres of mass, kg m^2, (..., 3, 3).

    Returns:
        phi, (..., 10).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    m = checks.array(masses, "masses", ())[..., None]
    c = checks.array(coms, "coms", (3,))
    C = skew(c)
    about = checks.array(inertias, "inertias", (3, 3))
    about = about + m[..., None] * C @ np.swapaxes(C, -1, -2)
    i, j = np.transpose(_UPPER)
    return np.concatenate([m, m * c, about[..., i, j]], axis=-1)


def link_regressor(V: ArrayLike, Vd: ArrayLike) -> Array:
    """Return the regressor of one body: its wrench is the regressor times phi.

    The wrench is G Vd - ad(V)^T G V (Modern Robotics, section 8.2.2). Column k is this
    wrench for the k-th unit vector phi.

    Args:
        V: twist of the body, expressed in the body frame, (..., 6).
        Vd: acceleration of the body, expressed in the body frame, which includes
            gravity as an acceleration -g of the base, (..., 6).

    Returns:
        The regressor, (..., 6, 10), of the wrench (moment; force) that moves the body.

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    V, Vd = checks.array(V, "V", (6,)), checks.array(Vd, "Vd", (6,))
    G = spatial_inertia_from_params(np.eye(10))
    V, Vd, turned = (
        V[..., None, :, None],
        Vd[..., None, :, None],
        ad(V)[..., None, :, :],
    )
    columns = G @ Vd - np.swapaxes(turned, -1, -2) @ (G @ V)
    return np.swapaxes(columns[..., 0], -1, -2)


def arm_regressor(
    J_space: ArrayLike, T_links: ArrayLike, qd: ArrayLike, qdd: ArrayLike, g: ArrayLike
) -> Array:
    """Return the regressor Y of an arm: the torque of its links is Y phi.

    Velocities and accelerations are propagated outwards, as in
    `dynamics.inverse_dynamics`. X = Ad(T^-1) maps them to each link frame, and X^T maps
    the wrench back to the world frame (Siciliano and others, section 7.2.2).

    Args:
        J_space: space Jacobian, (..., 6, n).
        T_links: `T_world_link`, (..., n, 4, 4).
        qd, qdd: joint velocities, rad/s, and accelerations, rad/s^2, (..., n).
        g: gravity, m/s^2, (3,).

    Returns:
        Y, (..., n, 10 n): ten columns per link, without rotors and friction. The
        columns of a link are 0 in the rows of the joints that are distal to it.

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = checks.array(J_space, "J_space", (6, "n"))
    n = J.shape[-1]
    qd, qdd = checks.array(qd, "qd", (n,)), checks.array(qdd, "qdd", (n,))
    S = np.swapaxes(J, -1, -2)
    own = S * qd[..., None]
    V = np.cumsum(own, axis=-2)
    A = np.cumsum(S * qdd[..., None] + times(ad(V), own), axis=-2)
    A = A - np.append(np.zeros(3), checks.array(g, "g", (3,)))
    X = adjoint(se3.inverse(checks.array(T_links, "T_links", (n, 4, 4))))
    wrenches = link_regressor(times(X, V), times(X, A))  # (..., n, 6, 10)
    seen = np.swapaxes(X @ J[..., None, :, :], -1, -2)  # the joints from each link
    felt = np.swapaxes(seen @ wrenches, -3, -2)  # (..., joint, link, 10)
    felt = np.tri(n).T[..., None] * felt  # a joint carries its own link and those after
    return felt.reshape(*felt.shape[:-2], 10 * n)


def actuator_regressor(qd: ArrayLike, qdd: ArrayLike) -> Array:
    """Return the regressor of the motors: rotors, viscous friction and dry friction.

    Each of them acts at its own joint only: the columns contain qdd, qd and sign(qd).

    Args:
        qd, qdd: joint velocities, rad/s, and accelerations, rad/s^2, (..., n).

    Returns:
        The regressor, (..., n, 3 n): its parameters are armature, damping and dry
        friction.

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    qd, qdd = checks.same_size(qd=qd, qdd=qdd)
    blocks = [each[..., None] * np.eye(qd.shape[-1]) for each in (qdd, qd, np.sign(qd))]
    return np.concatenate(np.broadcast_arrays(*blocks), axis=-1)


def rank_and_condition(Y: ArrayLike, rtol: float) -> tuple[int, float]:
    """Return the numerical rank of a regressor and its condition number.

    Args:
        Y: regressor of all samples, stacked, (n, p).
        rtol: a singular value counts if it is larger than rtol times the largest.

    Returns:
        (rank, condition): the number of singular values that count, and the largest of
        them over the smallest of them.

    Raises:
        ValueError: wrong shape, a non-finite number, Y of zeros, or rtol of 1 or more.
    """
    _, s, _ = _kept(Y, rtol)
    return len(s), float(s[0] / s[-1])


def truncated_svd_fit(Y: ArrayLike, tau: ArrayLike, rtol: float) -> Array:
    """Return the minimum-norm least-squares parameters by truncated SVD.

    This is V S^-1 U^T tau over the singular values that count (Golub and Van Loan,
    section 5.5).

    Args:
        Y: regressor, (n, p).
        tau: measured torques, N m, (n,).
        rtol: as in `rank_and_condition`.

    Returns:
        The parameters, (p,).

    Raises:
        ValueError: as `rank_and_condition`.
    """
    U, s, Vt = _kept(Y, rtol)
    return Vt.T @ (U.T @ checks.array(tau, "tau", U.shape[:1]) / s)


def predict_with_sigma(
    Y: ArrayLike, tau: ArrayLike, Y_new: ArrayLike, rtol: float
) -> tuple[Array, Array]:
    """Return predicted torques of new motions and the standard deviation of each.

    The variance of the noise is estimated from the residual r as r . r / (n - rank).
    The fit transfers the noise to the prediction: sigma is noise |V^T y / s| for a row
    y of Y_new.

    Args:
        Y, tau, rtol: as in `truncated_svd_fit`, with n above the rank of Y.
        Y_new: regressor of the new motions, (m, p).

    Returns:
        (torque, sigma), N m, (m,) each. Sigma includes neither the noise of a new
        measurement nor the bias of the combinations that were truncated.

    Raises:
        ValueError: as `rank_and_condition`; or no more rows than the rank.
    """
    _, s, Vt = _kept(Y, rtol)
    Y_new = checks.array(Y_new, "Y_new", Vt.shape[1:])
    phi = truncated_svd_fit(Y, tau, rtol)
    residual = np.asarray(tau) - np.asarray(Y) @ phi
    if len(residual) <= len(s):
        raise ValueError(f"{len(residual)} rows leave no residual at rank {len(s)}")
    noise = np.linalg.norm(residual) / np.sqrt(len(residual) - len(s))
    return Y_new @ phi, noise * np.linalg.norm(Y_new @ Vt.T / s, axis=-1)


def load_regressor(J_site: ArrayLike, R_site: ArrayLike, g: ArrayLike) -> Array:
    """Return the regressor of a payload: -J^T (R h x g; m g) is linear in (m, h = m c).

    The weight m g acts at R c and has the moment R h x g = -[g] R h about the site.

    Args:
        J_site: site Jacobian, (..., 6, n).
        R_site: `R_world_site`, (..., 3, 3).
        g: gravity, m/s^2, (3,).

    Returns:
        The regressor, (..., n, 4), of the torque that holds the payload, N m.

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    J = checks.array(J_site, "J_site", (6, "n"))
    R = checks.array(R_site, "R_site", (3, 3))
    g = checks.array(g, "g", (3,))
    W = np.zeros((*R.shape[:-2], 6, 4))
    W[..., 3:, 0] = g
    W[..., :3, 1:] = -skew(g) @ R
    return -np.swapaxes(J, -1, -2) @ W


def identify_payload(
    J_site: ArrayLike, R_site: ArrayLike, extra: ArrayLike, g: ArrayLike
) -> Array:
    """Return the mass and the first moment of mass of a payload, from static torques.

    This is the least-squares solution for all poses together.

    Args:
        J_site, R_site, g: as in `load_regressor`, of k poses.
        extra: torques with the payload minus those without, N m, (k, n).

    Returns:
        (m, m c), kg and kg m, expressed in the site frame, (4,). Poses whose
        orientations differ only by rotations about g do not determine the component of
        c along g; the result then has the smallest norm.

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    rows = load_regressor(J_site, R_site, g)
    extra = checks.array(extra, "extra", rows.shape[-2:-1])
    found, *_ = np.linalg.lstsq(rows.reshape(-1, 4), extra.reshape(-1), rcond=1e-9)
    return np.asarray(found, dtype=np.float64)


def min_pseudo_inertia_eig(phi: ArrayLike) -> Array:
    """Return the smallest eigenvalue of a body's pseudo-inertia matrix.

    The pseudo-inertia is [[Sigma, h], [h^T, m]] with h = m c and Sigma = (tr(I) / 2) E
    - I, where I is the inertia about the origin and E the identity matrix. Sigma is the
    sum of m r r^T over the points of the body (Wensing and others, 2018). For a body
    that can exist, the eigenvalue is not negative.

    Args:
        phi: inertial parameters, (..., 10).

    Returns:
        The smallest eigenvalue, (...).

    Raises:
        ValueError: wrong shape or a non-finite number.
    """
    about = spatial_inertia_from_params(phi)[..., :3, :3]
    phi = np.asarray(phi, dtype=np.float64)
    half = np.trace(about, axis1=-2, axis2=-1)[..., None, None] / 2.0
    P = np.empty((*phi.shape[:-1], 4, 4))
    P[..., :3, :3] = half * np.eye(3) - about
    P[..., 3, 3] = phi[..., 0]
    P[..., 3, :3] = P[..., :3, 3] = phi[..., 1:4]
    return np.linalg.eigvalsh(P)[..., 0]


def _kept(Y: ArrayLike, rtol: float) -> tuple[Array, Array, Array]:
    """Return U, s and V^T of the singular values that count."""
    Y = checks.array(Y, "Y", ("n", "p"))
    if Y.ndim != 2:
        raise ValueError(f"Y has shape {Y.shape}; stack its samples: (n, p)")
    U, s, Vt = np.linalg.svd(Y, full_matrices=False)
    rank = int(np.sum(s > rtol * s[0]))
    if not rank:
        raise ValueError("Y is zero, or rtol is 1 or more: nothing counts")
    return U[:, :rank], s[:rank], Vt[:rank]
