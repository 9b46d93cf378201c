# tasks 4.1 4.2: passed
# diag(I, m 1) at the centre of mass, carried to the origin by adjoints.
import numpy as np

from robo47.screws import adjoint


def spatial_inertia(m, c, I):
    at_com = np.zeros((6, 6))
    at_com[:3, :3], at_com[3:, 3:] = I, m * np.eye(3)
    T = np.eye(4)
    T[:3, 3] = -c
    X = adjoint(T)  # twists about the origin to twists about the centre of mass
    return X.T @ at_com @ X


def link_inertias(T_links, masses, coms, inertias):
    out = np.empty((7, 6, 6))
    for i in range(7):
        X = adjoint(np.linalg.inv(T_links[i]))
        out[i] = X.T @ spatial_inertia(masses[i], coms[i], inertias[i]) @ X
    return out
