# task 4.9: masses-forgotten
# 1 kg each.
import numpy as np


def energy(M, qd, masses, coms_world, g):
    kinetic = 0.5 * qd @ M @ qd
    potential = -sum(g @ c for m, c in zip(masses, coms_world))
    return np.array([kinetic, potential])
