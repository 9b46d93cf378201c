# tasks 4.5 4.6 4.7: passed
# One function that calls itself for the rest of the arm.
import numpy as np

from robo47.screws import skew


def ad(V):
    out = np.zeros((6, 6))
    out[:3, :3] = skew(V[:3])
    out[3:, 3:] = skew(V[:3])
    out[3:, :3] = skew(V[3:])
    return out


def inverse_dynamics(J, G, qd, qdd, g):
    tau = np.zeros(7)

    def rest(i, V, A):
        """Return the wrench on link i and all beyond it."""
        if i == 7:
            return np.zeros(6)
        S = J[:, i]
        V = V + S * qd[i]
        X = ad(V)
        A = A + S * qdd[i] + X @ S * qd[i]
        F = G[i] @ A - X.T @ (G[i] @ V) + rest(i + 1, V, A)
        tau[i] = S @ F
        return F

    rest(0, np.zeros(6), np.hstack([np.zeros(3), -g]))
    return tau


def bias_torque(J, G, qd, g):
    return inverse_dynamics(J, G, qd, qd - qd, g)
