# task 6.2: last-joint-left-out
# One short.
import numpy as np


def site_bias(J_space, qd, p):
    V, A = np.zeros(6), np.zeros(6)
    for i in range(6):
        S = J_space[:, i] * qd[i]
        V = V + S
        w, v = V[:3], V[3:]
        A += np.append(np.cross(w, S[:3]), np.cross(v, S[:3]) + np.cross(w, S[3:]))
    w, v, alpha = V[:3], V[3:], A[:3]
    linear = A[3:] + np.cross(alpha, p) + np.cross(w, v + np.cross(w, p))
    return np.append(alpha, linear)
