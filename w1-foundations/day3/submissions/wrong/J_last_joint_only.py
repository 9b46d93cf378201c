# task 3.1: last-joint-only
# The product is forgotten: T is one exponential.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T = np.eye(4)
    columns = []
    for S, theta in zip(screws, q):
        columns.append(adjoint(T) @ S)
        T = exp_screw(S, theta)
    return np.array(columns).T
