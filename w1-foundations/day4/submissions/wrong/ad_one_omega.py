# task 4.5: second-omega-forgotten
# Only the angular half is turned.
import numpy as np

from robo47.screws import skew


def ad(V):
    out = np.zeros((6, 6))
    out[:3, :3] = skew(V[:3])
    out[3:, :3] = skew(V[3:])
    return out
