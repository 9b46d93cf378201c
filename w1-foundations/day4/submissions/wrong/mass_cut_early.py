# task 4.3: own-joint-left-out
# Off by one.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(armature)
    for i in range(7):
        J_i = J.copy()
        J_i[:, i:] = 0.0
        M = M + J_i.T @ G[i] @ J_i
    return M
