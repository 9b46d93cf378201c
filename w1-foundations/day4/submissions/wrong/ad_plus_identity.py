# task 4.5: identity-added
# The adjoint of a small motion, not its rate.
import numpy as np

from robo47.screws import skew


def ad(V):
    out = np.eye(6)
    out[:3, :3] += skew(V[:3])
    out[3:, 3:] += skew(V[:3])
    out[3:, :3] = skew(V[3:])
    return out
