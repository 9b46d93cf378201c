# task 3.9: rotation-only
# The axes are turned, the point is not moved.
import numpy as np


def body_jacobian(J_space, T):
    return np.kron(np.eye(2), T[:3, :3].T) @ J_space
