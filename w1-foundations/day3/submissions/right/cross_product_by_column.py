# tasks 3.2 3.9: passed
# np.cross, column by column, in place.
import numpy as np


def site_jacobian(J_space, p):
    J = J_space.copy()
    for i in range(7):
        J[3:, i] += np.cross(J[:3, i], p)
    return J


def body_jacobian(J_space, T):
    J = site_jacobian(J_space, T[:3, 3])
    R = T[:3, :3]
    return np.vstack([R.T @ J[:3], R.T @ J[3:]])
