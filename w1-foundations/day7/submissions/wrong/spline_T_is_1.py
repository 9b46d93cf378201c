# task 7.5: T-is-1
# T left out.
import numpy as np


def quintic_coefficients(start, end, T):
    A = np.array(
        [
            [1, 0, 0, 0, 0, 0],
            [0, 1, 0, 0, 0, 0],
            [0, 0, 2, 0, 0, 0],
            [1, 1, 1, 1, 1, 1],
            [0, 1, 2, 3, 4, 5],
            [0, 0, 2, 6, 12, 20],
        ]
    )
    return np.linalg.solve(A, np.concatenate([start, end]))
