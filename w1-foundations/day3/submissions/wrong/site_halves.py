# task 3.2: halves-read-as-v-omega
# The upper rows are read as v.
import numpy as np


def site_jacobian(J_space, p):
    v, omega = J_space[:3], J_space[3:]
    return np.vstack([v + np.cross(omega, p, axis=0), omega])
