# task 46.4: slip-function (not in a run: the lab looks at its translation only)
# A 1 in the corner, as in a pose.
import numpy as np


def bracket(V):
    x, y, z = V[:3]
    out = np.eye(4)
    out[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    out[:3, 3] = V[3:]
    return out
