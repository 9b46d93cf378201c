# task 6.4: pinv-for-transpose
# pinv(J) back to the joints.
import numpy as np


def null_torque(J, M, Lambda, tau):
    return tau - np.linalg.pinv(J) @ Lambda @ J @ np.linalg.solve(M, tau)
