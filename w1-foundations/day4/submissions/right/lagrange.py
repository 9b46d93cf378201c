# tasks 4.5 4.6 4.7: passed
# Christoffel symbols from dJ_i/dq_j = ad(J_j) J_i, and no recursion at all.
import numpy as np

from robo47.screws import skew


def ad(V):
    out = np.zeros((6, 6))
    out[:3, :3] = skew(V[:3])
    out[3:, 3:] = skew(V[:3])
    out[3:, :3] = skew(V[3:])
    return out


def moved(J, G, j):
    """Return what J and G change by when joint j moves."""
    dJ, dG = np.zeros_like(J), np.zeros_like(G)
    a = ad(J[:, j])
    for i in range(j + 1, 7):
        dJ[:, i] = a @ J[:, i]
    for i in range(j, 7):
        dG[i] = -a.T @ G[i] - G[i] @ a
    return dJ, dG


def mass_of_links(J, G):
    M = np.zeros((7, 7))
    for i in range(7):
        J_i = J[:, : i + 1]
        M[: i + 1, : i + 1] += J_i.T @ G[i] @ J_i
    return M


def mass_rate(J, G, j):
    dJ, dG = moved(J, G, j)
    dM = np.zeros((7, 7))
    for i in range(7):
        J_i, dJ_i = J[:, : i + 1], dJ[:, : i + 1]
        mixed = dJ_i.T @ G[i] @ J_i
        dM[: i + 1, : i + 1] += mixed + mixed.T + J_i.T @ dG[i] @ J_i
    return dM


def inverse_dynamics(J, G, qd, qdd, g):
    rates = np.array([mass_rate(J, G, k) for k in range(7)])  # [k, i, j]
    gamma = 0.5 * (
        rates.transpose(1, 2, 0) + rates.transpose(1, 0, 2) - rates
    )  # [i, j, k]: dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i
    tau = mass_of_links(J, G) @ qdd + np.einsum("ijk,j,k->i", gamma, qd, qd)
    lift = np.concatenate([np.zeros(3), -g])
    for i in range(7):
        tau[: i + 1] += J[:, : i + 1].T @ G[i] @ lift
    return tau


def bias_torque(J, G, qd, g):
    return inverse_dynamics(J, G, qd, 0 * qd, g)
