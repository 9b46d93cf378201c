# task 3.1: passed
# Each screw is moved by its own joint as well, which leaves it as it is.
import numpy as np

from robo47.screws import exp_screw


def space_jacobian(screws, q):
    T, J = np.eye(4), np.zeros((6, 7))
    for i, (S, theta) in enumerate(zip(screws, q)):
        T = T @ exp_screw(S, theta)
        omega = T[:3, :3] @ S[:3]
        J[:, i] = [*omega, *(T[:3, :3] @ S[3:] + np.cross(T[:3, 3], omega))]
    return J
