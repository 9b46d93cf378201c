# task 3.3: textbook-formula
# The formula of most books, with nothing around it.
import numpy as np


def log_rotation(R):
    theta = np.arccos((np.trace(R) - 1) / 2)
    return (
        theta
        / (2 * np.sin(theta))
        * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    )
