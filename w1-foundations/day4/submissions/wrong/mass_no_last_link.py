# task 4.3: last-link-left-out
# range ends one too early.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(armature)
    for i in range(6):
        J_i = J.copy()
        J_i[:, i + 1 :] = 0.0
        M = M + J_i.T @ G[i] @ J_i
    return M
