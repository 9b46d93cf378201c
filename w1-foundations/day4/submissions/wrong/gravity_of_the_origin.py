# task 4.4: velocity-of-the-origin
# The lower half of J_space is not a velocity of the link.
import numpy as np


def gravity_torque(J, masses, coms_world, g):
    tau = np.zeros(7)
    for i in range(7):
        J_com = J[3:]
        tau[: i + 1] -= masses[i] * J_com[:, : i + 1].T @ g
    return tau
