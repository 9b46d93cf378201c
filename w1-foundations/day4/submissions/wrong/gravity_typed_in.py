# task 4.4: gravity-typed-in (not in a run: the lab's robot stands upright)
# g is not used.
import numpy as np

from robo47.screws import skew


def gravity_torque(J, masses, coms_world, g):
    tau = np.zeros(7)
    for i in range(7):
        J_com = J[3:] - skew(coms_world[i]) @ J[:3]
        tau[: i + 1] -= masses[i] * J_com[:, : i + 1].T @ np.array([0, 0, -9.81])
    return tau
