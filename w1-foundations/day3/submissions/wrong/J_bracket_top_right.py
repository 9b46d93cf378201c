# task 3.1: bracket-top-right
# An adjoint for (v; omega).
import numpy as np

from robo47.screws import exp_screw, skew


def own_adjoint(T):
    R, p = T[:3, :3], T[:3, 3]
    return np.block([[R, skew(p) @ R], [np.zeros((3, 3)), R]])


def space_jacobian(screws, q):
    T = np.eye(4)
    columns = []
    for S, theta in zip(screws, q):
        columns.append(own_adjoint(T) @ S)
        T = T @ exp_screw(S, theta)
    return np.array(columns).T
