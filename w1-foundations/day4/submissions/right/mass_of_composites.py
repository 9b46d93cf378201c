# task 4.3: passed
# Two screws and all the links behind the later one.
import numpy as np


def mass_matrix(J, G, armature):
    behind, n = np.cumsum(G[::-1], axis=0)[::-1], range(7)
    M = [[J[:, i] @ behind[max(i, j)] @ J[:, j] for i in n] for j in n]
    return M + np.diag(armature)
