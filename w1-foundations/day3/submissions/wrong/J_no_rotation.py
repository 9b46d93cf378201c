# task 3.1: translation-only
# The screws are only translated.
import numpy as np

from robo47.screws import exp_screw, skew


def own_adjoint(T):
    R, p = T[:3, :3], T[:3, 3]
    return np.block([[np.eye(3), np.zeros((3, 3))], [skew(p), np.eye(3)]])


def space_jacobian(screws, q):
    T = np.eye(4)
    columns = []
    for S, theta in zip(screws, q):
        columns.append(own_adjoint(T) @ S)
        T = T @ exp_screw(S, theta)
    return np.array(columns).T
