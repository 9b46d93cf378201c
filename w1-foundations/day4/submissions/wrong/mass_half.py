# task 4.3: half
# The 1/2 of the kinetic energy.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(armature)
    for i in range(7):
        J_i = J.copy()
        J_i[:, i + 1 :] = 0.0
        M = M + 0.5 * J_i.T @ G[i] @ J_i
    return M
