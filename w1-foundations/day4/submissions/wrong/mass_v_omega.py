# task 4.3: halves-swapped
# J as MuJoCo has it, G as the book.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(armature)
    for i in range(7):
        J_i = np.roll(J, 3, axis=0)
        J_i[:, i + 1 :] = 0.0
        M = M + J_i.T @ G[i] @ J_i
    return M
