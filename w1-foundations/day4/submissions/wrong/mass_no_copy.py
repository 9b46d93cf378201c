# task 4.3: J-overwritten
# Without the copy the first link erases all other columns.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(armature)
    for i in range(7):
        J_i = J
        J_i[:, i + 1 :] = 0.0
        M = M + J_i.T @ G[i] @ J_i
    return M
