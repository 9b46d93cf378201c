# task 4.3: next-joint-too
# Off by one, the other way.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(armature)
    for i in range(7):
        J_i = J.copy()
        J_i[:, i + 2 :] = 0.0
        M = M + J_i.T @ G[i] @ J_i
    return M
