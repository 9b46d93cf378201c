# task 6.2: rounded-somewhere
# By a difference quotient of the moving screws.
import numpy as np

from robo47.screws import adjoint, exp_screw


def site_bias(J_space, qd, p):
    h = 1e-7
    T = np.eye(4)
    moved = []
    for S, speed in zip(J_space.T, qd):
        moved.append(adjoint(T) @ S)
        T = T @ exp_screw(S, speed * h)
    rate = (np.array(moved).T - J_space) @ qd / h
    V = J_space @ qd
    v = V[3:] + np.cross(V[:3], p)
    return np.append(rate[:3], rate[3:] + np.cross(rate[:3], p) + np.cross(V[:3], v))
