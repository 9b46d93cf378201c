# task 4.2: pose-of-the-link-before
# The base is counted as the first link.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])


def link_inertias(T_links, masses, coms, inertias):
    G = []
    before = [np.eye(4), *T_links[:-1]]
    for T, m, c, I in zip(before, masses, coms, inertias):
        R, p = T[:3, :3], T[:3, 3]
        G.append(spatial_inertia(m, R @ c + p, R @ I @ R.T))
    return np.array(G)
