# tasks 4.5 4.6: passed
# Each link's force is the rate of G V, gravity a force at its centre of mass.
import numpy as np

from robo47.screws import skew


def ad(V):
    out = np.zeros((6, 6))
    out[:3, :3] = skew(V[:3])
    out[3:, 3:] = skew(V[:3])
    out[3:, :3] = skew(V[3:])
    return out


def inverse_dynamics(J, G, qd, qdd, g):
    down = np.concatenate([np.zeros(3), g])
    V, A, F = np.zeros(6), np.zeros(6), np.zeros((7, 6))
    for i in range(7):
        V = V + J[:, i] * qd[i]
        X = ad(V)
        A = A + J[:, i] * qdd[i] + X @ J[:, i] * qd[i]
        G_rate = -X.T @ G[i] - G[i] @ X
        F[i] = G[i] @ A + G_rate @ V - G[i] @ down
    return np.array([J[:, i] @ F[i:].sum(axis=0) for i in range(7)])
