# task 7.5: one-condition-not-kept
# 12 T for 12 T^2 in the last row.
import numpy as np


def quintic_coefficients(start, end, T):
    A = np.array([
        [1, 0, 0, 0, 0, 0],
        [0, 1, 0, 0, 0, 0],
        [0, 0, 2, 0, 0, 0],
        [1, T, T**2, T**3, T**4, T**5],
        [0, 1, 2 * T, 3 * T**2, 4 * T**3, 5 * T**4],
        [0, 0, 2, 6 * T, 12 * T, 20 * T**3],
    ])  # fmt: skip
    return np.linalg.solve(A, np.concatenate([start, end]))
