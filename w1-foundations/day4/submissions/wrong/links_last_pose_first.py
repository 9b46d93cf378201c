# task 4.2: pose-of-the-link-before
# Off by one: T_links[-1] is the last one.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])


def link_inertias(T_links, masses, coms, inertias):
    G = []
    for i in range(7):
        R, p = T_links[i - 1][:3, :3], T_links[i - 1][:3, 3]
        G.append(spatial_inertia(masses[i], R @ coms[i] + p, R @ inertias[i] @ R.T))
    return np.array(G)
