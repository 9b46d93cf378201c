# task 4.5: product-for-v
# [p] R of the adjoint, with other letters.
import numpy as np

from robo47.screws import skew


def ad(V):
    out = np.zeros((6, 6))
    out[:3, :3] = skew(V[:3])
    out[3:, 3:] = skew(V[:3])
    out[3:, :3] = skew(V[3:]) @ skew(V[:3])
    return out
