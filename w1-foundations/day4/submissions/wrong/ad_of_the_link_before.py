# task 4.6: off
# ad is made before the joint's own speed is added, and its wrench is added.
import numpy as np

from robo47.screws import skew


def carried(V):
    W = skew(V[:3])
    return np.block([[W, np.zeros((3, 3))], [skew(V[3:]), W]])


def inverse_dynamics(J, G, qd, qdd, g):
    V, A, F = np.zeros(6), np.append(np.zeros(3), -g), []
    for S, G_i, speed, acc in zip(J.T, G, qd, qdd):
        before, V = carried(V), V + S * speed
        A = A + S * acc + before @ S * speed
        F.append(G_i @ A + before.T @ G_i @ V)
    return np.array([J[:, i] @ np.sum(F[i:], axis=0) for i in range(7)])
