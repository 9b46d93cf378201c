# task 3.1: product-reversed
# The next exponential is put on the left.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T = np.eye(4)
    columns = []
    for S, theta in zip(screws, q):
        columns.append(adjoint(T) @ S)
        T = exp_screw(S, theta) @ T
    return np.array(columns).T
