# task 4.4: signs-lost
# As if a torque were a size.
import numpy as np


def gravity_torque(J, masses, coms_world, g):
    tau = np.zeros(7)
    for i in range(7):
        for m, c in zip(masses[i:], coms_world[i:]):
            tau[i] -= m * g @ (J[3:, i] + np.cross(J[:3, i], c))
    return abs(tau)
