# task 4.3: not-summed-back
# Composite bodies that are never composed.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(armature)
    for i in range(7):
        for j in range(7):
            M[i, j] += J[:, i] @ G[max(i, j)] @ J[:, j]
    return M
