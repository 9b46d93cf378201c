# task 4.3: columns-not-cut
# Every joint moves every link.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(armature)
    for i in range(7):
        J_i = J.copy()
        M = M + J_i.T @ G[i] @ J_i
    return M
