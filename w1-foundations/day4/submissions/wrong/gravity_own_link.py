# task 4.4: own-link-only
# Every joint holds its own link.
import numpy as np

from robo47.screws import skew


def gravity_torque(J, masses, coms_world, g):
    tau = np.zeros(7)
    for i in range(7):
        J_com = J[3:] - skew(coms_world[i]) @ J[:3]
        tau[i] -= masses[i] * J_com[:, i] @ g
    return tau
