# task 6.4: Lambda-inverted
# Lambda the wrong way up.
import numpy as np


def null_torque(J, M, Lambda, tau):
    return tau - J.T @ np.linalg.solve(Lambda, J @ np.linalg.solve(M, tau))
