# task 3.1: rows-swapped
# MuJoCo's and Pinocchio's order: v above omega.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T = np.eye(4)
    columns = []
    for S, theta in zip(screws, q):
        columns.append(adjoint(T) @ S)
        T = T @ exp_screw(S, theta)
    return np.roll(np.array(columns).T, 3, axis=0)
