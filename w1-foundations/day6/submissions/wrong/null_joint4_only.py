# task 6.4: entries-empty
# Only the elbow joint may turn.
import numpy as np


def nullspace_torque(J, M, Lambda, tau):
    out = np.zeros(7)
    out[3] = tau[3]
    return out
