# task 3.1: moved-by-all
# Every screw is carried by the whole arm.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T = np.eye(4)
    for S, theta in zip(screws, q):
        T = T @ exp_screw(S, theta)
    return adjoint(T) @ screws.T
