# task 4.3: armature-forgotten
# Only the links; a wrong value on the diagonal alone.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.zeros((7, 7))
    for i in range(7):
        J_i = J.copy()
        J_i[:, i + 1 :] = 0.0
        M = M + J_i.T @ G[i] @ J_i
    return M
