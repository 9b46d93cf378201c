# task 6.4: projector-transposed
# N^T for N.
import numpy as np


def null_torque(J, M, Lambda, tau):
    N = np.eye(7) - J.T @ Lambda @ J @ np.linalg.inv(M)
    return N.T @ tau
