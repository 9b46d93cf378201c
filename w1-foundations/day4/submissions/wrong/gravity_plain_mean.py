# task 4.4: centre-not-weighted
# The mean of the places, whatever weighs there.
import numpy as np


def gravity_torque(J, masses, coms_world, g):
    tau = np.zeros(7)
    for i in range(7):
        c = coms_world[i:].mean(axis=0)
        tau[i] = -masses[i:].sum() * g @ (J[3:, i] + np.cross(J[:3, i], c))
    return tau
