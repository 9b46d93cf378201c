# task 3.1: all-backwards
# The joints turn by -q.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T = np.eye(4)
    columns = []
    for S, theta in zip(screws, -q):
        columns.append(adjoint(T) @ S)
        T = T @ exp_screw(S, theta)
    return np.array(columns).T
