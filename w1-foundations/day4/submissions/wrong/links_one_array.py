# task 4.2: last-link-for-all
# One array, seven times in the list.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])


def link_inertias(T_links, masses, coms, inertias):
    G, one = [], np.zeros((6, 6))
    for T, m, c, I in zip(T_links, masses, coms, inertias):
        R, p = T[:3, :3], T[:3, 3]
        one[:] = spatial_inertia(m, R @ c + p, R @ I @ R.T)
        G.append(one)
    return np.array(G)
