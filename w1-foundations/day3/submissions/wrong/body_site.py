# task 3.9: site-for-body
# J_site.
import numpy as np

from robo47.screws import skew


def site_jacobian(J_space: np.ndarray, p: np.ndarray) -> np.ndarray:
    omega, v = J_space[:3], J_space[3:]
    return np.vstack([omega, v - skew(p) @ omega])  # omega x p = -[p] omega


def body_jacobian(J_space, T):
    return site_jacobian(J_space, T[:3, 3])
