# task 46.3: second-half-empty
# The second block is forgotten.
import numpy as np


def spin(omega):
    x, y, z = omega
    out = np.zeros((6, 6))
    out[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    return out
