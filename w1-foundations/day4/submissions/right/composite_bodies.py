# task 4.3: passed
# Featherstone's composite bodies: from the tip, each entry once.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(np.asarray(armature, dtype=float))
    carried = np.zeros((6, 6))
    for i in reversed(range(len(G))):
        carried = carried + G[i]
        momentum = carried @ J[:, i]
        for j in range(i + 1):
            M[i, j] += momentum @ J[:, j]
            M[j, i] = M[i, j]
    return M
