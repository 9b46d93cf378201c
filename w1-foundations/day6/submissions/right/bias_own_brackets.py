# task 6.2: passed
# Cross products written out, no library.
import numpy as np


def site_bias(J_space, qd, p):
    w, v, alpha, a = np.zeros((4, 3))
    for S, speed in zip(J_space.T, qd):
        sw, sv = S[:3] * speed, S[3:] * speed
        alpha = alpha + np.cross(w, sw)
        a = a + np.cross(v, sw) + np.cross(w, sv)
        w, v = w + sw, v + sv
    return np.append(alpha, a + np.cross(alpha, p) + np.cross(w, v + np.cross(w, p)))
