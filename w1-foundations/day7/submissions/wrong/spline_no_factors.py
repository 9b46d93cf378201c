# task 7.5: singular
# Powers without their factors.
import numpy as np


def quintic_coefficients(start, end, T):
    A = np.array(
        [
            [1, 0, 0, 0, 0, 0],
            [0, 1, 0, 0, 0, 0],
            [0, 0, 1, 0, 0, 0],
            [1, T, T**2, T**3, T**4, T**5],
            [0, 1, T, T**2, T**3, T**4],
            [0, 0, 1, T, T**2, T**3],
        ]
    )
    return np.linalg.solve(A, np.concatenate([start, end]))
