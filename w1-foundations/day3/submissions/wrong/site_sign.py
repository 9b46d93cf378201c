# task 3.2: cross-sign
# p x omega.
import numpy as np

from robo47.screws import skew


def site_jacobian(J_space, p):
    omega, v = J_space[:3], J_space[3:]
    return np.vstack([omega, v + skew(p) @ omega])
