# tasks 7.1 7.3: passed
# NumPy's polynomials differentiate; joint_move by an outer product.
import numpy as np


def quintic_scaling(t, T):
    p = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6])
    x = min(max(t / T, 0.0), 1.0)
    return [p(x), p.deriv()(x) / T, p.deriv(2)(x) / T**2]


def joint_move(q0, q1, t, T):
    rows = np.outer(quintic_scaling(t, T), q1 - q0)
    rows[0] = rows[0] + q0
    return rows
