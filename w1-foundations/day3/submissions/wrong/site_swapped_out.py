# task 3.2: rows-swapped
# Right, but (v; omega), as MuJoCo's jacp above its jacr.
import numpy as np


def site_jacobian(J_space, p):
    omega, v = J_space[:3], J_space[3:]
    return np.vstack([v + np.cross(omega, p, axis=0), omega])
