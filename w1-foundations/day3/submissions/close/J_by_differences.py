# task 3.1: rounded-somewhere
# The Jacobian by central differences of the pose.
import numpy as np

from robo47.screws import fk_space


def space_jacobian(screws, q):
    J = np.zeros((6, 7))
    for i in range(7):
        d = np.zeros(7)
        d[i] = 1e-3
        one = fk_space(screws, np.eye(4), q + d)
        two = fk_space(screws, np.eye(4), q - d)
        V = (one - two) / 2e-3 @ np.linalg.inv(fk_space(screws, np.eye(4), q))
        J[:, i] = V[2, 1], V[0, 2], V[1, 0], *V[:3, 3]
    return J
