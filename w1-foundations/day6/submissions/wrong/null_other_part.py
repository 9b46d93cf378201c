# task 6.4: the-other-part
# What the hand does feel.
import numpy as np


def null_torque(J, M, Lambda, tau):
    return J.T @ Lambda @ J @ np.linalg.solve(M, tau)
