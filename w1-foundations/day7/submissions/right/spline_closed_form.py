# task 7.5: passed
# The closed form from another book.
import numpy as np


def quintic_coefficients(start, end, T):
    (q0, v0, a0), (q1, v1, a1) = start, end
    h = q1 - q0
    return np.array(
        [
            q0,
            v0,
            a0 / 2,
            (20 * h - (8 * v1 + 12 * v0) * T - (3 * a0 - a1) * T**2) / (2 * T**3),
            (-30 * h + (14 * v1 + 16 * v0) * T + (3 * a0 - 2 * a1) * T**2) / (2 * T**4),
            (12 * h - 6 * (v1 + v0) * T + (a1 - a0) * T**2) / (2 * T**5),
        ]
    )
