# task 4.9: order-swapped
# Potential first.
import numpy as np


def energy(M, qd, masses, coms_world, g):
    kinetic = 0.5 * qd @ M @ qd
    potential = -sum(m * g @ c for m, c in zip(masses, coms_world))
    return np.array([potential, kinetic])
