# task 4.3: angular-half-only
# Only the inertia block of G.
import numpy as np


def mass_matrix(J, G, armature):
    M = np.diag(armature)
    for i in range(7):
        J_i = J.copy()
        J_i[:, i + 1 :] = 0.0
        M = M + J_i[:3].T @ G[i][:3, :3] @ J_i[:3]
    return M
