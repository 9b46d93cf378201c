# task 4.6: speed-squared
# Coriolis is quadratic, but V has one of the two.
import numpy as np

from robo47.screws import skew


def ad(V):
    out = np.zeros((6, 6))
    out[:3, :3] = skew(V[:3])
    out[3:, 3:] = skew(V[:3])
    out[3:, :3] = skew(V[3:])
    return out


def inverse_dynamics(J, G, qd, qdd, g):
    V = np.zeros(6)
    A = np.array([0.0, 0.0, 0.0, -g[0], -g[1], -g[2]])
    F = []
    for i in range(7):
        S = J[:, i]
        V = V + S * qd[i]
        A = A + S * qdd[i] + ad(V) @ S * qd[i] ** 2
        F.append(G[i] @ A - ad(V).T @ G[i] @ V)
    tau, total = np.zeros(7), np.zeros(6)
    for i in range(6, -1, -1):
        total = total + F[i]
        tau[i] = J[:, i] @ total
    return tau
