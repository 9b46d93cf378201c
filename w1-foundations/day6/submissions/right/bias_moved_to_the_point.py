# task 6.2: passed
# Screws first moved to the point, then summed.
import numpy as np

from robo47.screws import ad


def site_bias(J_space, qd, p):
    move = np.eye(6)
    x, y, z = p
    move[3:, :3] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    S = (move @ J_space * qd).T
    V = np.cumsum(S, axis=0)
    A = sum(ad(Vi) @ Si for Vi, Si in zip(V, S))
    A[3:] += np.cross(V[-1, :3], V[-1, 3:])
    return A
