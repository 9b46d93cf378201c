# task 7.5: passed
# Three coefficients at once, three by a 3x3.
import numpy as np


def quintic_coefficients(start, end, T):
    low = np.array([start[0], start[1], start[2] / 2])
    there = np.array([low @ [1, T, T * T], low[1] + 2 * low[2] * T, 2 * low[2]])
    A = [
        [T**3, T**4, T**5],
        [3 * T**2, 4 * T**3, 5 * T**4],
        [6 * T, 12 * T**2, 20 * T**3],
    ]
    return np.append(low, np.linalg.solve(np.array(A), end - there))
