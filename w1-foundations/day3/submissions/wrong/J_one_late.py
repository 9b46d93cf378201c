# task 3.1: one-joint-late
# The product is updated one joint late.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T, late = np.eye(4), np.eye(4)
    columns = []
    for S, theta in zip(screws, q):
        columns.append(adjoint(late) @ S)
        late = T
        T = T @ exp_screw(S, theta)
    return np.array(columns).T
