# task 3.2: v-dropped
# Only omega x p.
import numpy as np


def site_jacobian(J_space, p):
    omega = J_space[:3]
    return np.vstack([omega, np.cross(omega, p, axis=0)])
