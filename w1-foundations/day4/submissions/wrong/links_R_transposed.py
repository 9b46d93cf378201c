# task 4.2: R-transposed
# Row vectors times R.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])


def link_inertias(T_links, masses, coms, inertias):
    G = []
    for T, m, c, I in zip(T_links, masses, coms, inertias):
        R, p = T[:3, :3], T[:3, 3]
        G.append(spatial_inertia(m, c @ R + p, R.T @ I @ R))
    return np.array(G)
