# task 4.3: not-mirrored
# Only half of the composite body algorithm.
import numpy as np


def mass_matrix(J, G, armature):
    M, carried = np.diag(armature), np.zeros((6, 6))
    for i in range(6, -1, -1):
        carried = carried + G[i]
        for j in range(i + 1):
            M[i, j] += J[:, i] @ carried @ J[:, j]
    return M
