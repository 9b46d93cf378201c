# task 4.4: all-mass-at-the-last-centre
# One centre for all.
import numpy as np


def gravity_torque(J, masses, coms_world, g):
    tau = np.zeros(7)
    for i in range(7):
        v = J[3:, i] + np.cross(J[:3, i], coms_world[-1])
        tau[i] = -masses[i:].sum() * g @ v
    return tau
