# task 6.4: acceleration
# Joint accelerations come back.
import numpy as np


def null_torque(J, M, Lambda, tau):
    qdd = np.linalg.solve(M, tau)
    return qdd - np.linalg.solve(M, J.T @ Lambda @ J @ qdd)
