# task 3.1: adjoint-of-the-inverse
# The adjoint of the inverse pose.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T = np.eye(4)
    columns = []
    for S, theta in zip(screws, q):
        columns.append(adjoint(np.linalg.inv(T)) @ S)
        T = T @ exp_screw(S, theta)
    return np.array(columns).T
