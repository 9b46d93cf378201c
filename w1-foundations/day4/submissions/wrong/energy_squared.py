# task 4.9: speed-squared-too-early
# M qd^2.
import numpy as np


def energy(M, qd, masses, coms_world, g):
    kinetic = 0.5 * np.sum(M @ qd**2)
    potential = -sum(m * g @ c for m, c in zip(masses, coms_world))
    return np.array([kinetic, potential])
