# task 4.2: pose-inverted
# Ad(T) where the adjoint of its inverse belongs.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])


def link_inertias(T_links, masses, coms, inertias):
    G = []
    for T, m, c, I in zip(T_links, masses, coms, inertias):
        R, p = T[:3, :3], T[:3, 3]
        Ad = np.zeros((6, 6))
        Ad[:3, :3] = Ad[3:, 3:] = R
        Ad[3:, :3] = skew(p) @ R
        G.append(Ad.T @ spatial_inertia(m, c, I) @ Ad)
    return np.array(G)
