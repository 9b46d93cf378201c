# task 4.9: half-forgotten
# m v^2.
import numpy as np


def energy(M, qd, masses, coms_world, g):
    kinetic = qd @ M @ qd
    potential = -sum(m * g @ c for m, c in zip(masses, coms_world))
    return np.array([kinetic, potential])
