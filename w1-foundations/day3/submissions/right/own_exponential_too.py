# task 3.1: passed
# Each screw is moved by its own exponential as well: it does not change it.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T = np.eye(4)
    J = np.zeros((6, 7))
    for i in range(7):
        T = T @ exp_screw(screws[i], q[i])
        J[:, i] = adjoint(T) @ screws[i]
    return J
