# task 4.2: poses-multiplied
# As if each pose were seen from the link before.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[I + m * C @ C.T, m * C], [m * C.T, m * np.eye(3)]])


def link_inertias(T_links, masses, coms, inertias):
    G, so_far = [], np.eye(4)
    for T, m, c, I in zip(T_links, masses, coms, inertias):
        so_far = so_far @ T
        R, p = so_far[:3, :3], so_far[:3, 3]
        G.append(spatial_inertia(m, R @ c + p, R @ I @ R.T))
    return np.array(G)
