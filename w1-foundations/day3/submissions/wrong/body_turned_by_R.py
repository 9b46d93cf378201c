# task 3.9: turned-by-R
# J_site turned by R in place of R^T.
import numpy as np

from robo47.screws import skew


def body_jacobian(J_space, T):
    R, p = T[:3, :3], T[:3, 3]
    v = J_space[3:] - skew(p) @ J_space[:3]
    return np.vstack([R @ J_space[:3], R @ v])
