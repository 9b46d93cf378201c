# task 6.2: coriolis-twice
# 2 omega x v, from another formula.
import numpy as np


def site_bias(J_space, qd, p):
    V, A = np.zeros(6), np.zeros(6)
    for i in range(7):
        S = J_space[:, i] * qd[i]
        V = V + S
        w, v = V[:3], V[3:]
        A += np.append(np.cross(w, S[:3]), np.cross(v, S[:3]) + np.cross(w, S[3:]))
    w, v, alpha = V[:3], V[3:], A[:3]
    linear = A[3:] + np.cross(alpha, p) + 2 * np.cross(w, v)
    return np.append(alpha, linear + np.cross(w, np.cross(w, p)))
