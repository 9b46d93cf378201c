# task 4.4: rounded-somewhere
# The slope of the potential energy, by central differences.
import numpy as np

from robo47.screws import exp_screw


def gravity_torque(J, masses, coms_world, g):
    h, tau = 3e-4, np.zeros(7)
    for i in range(7):
        up = exp_screw(J[:, i], h) if J[:3, i].any() else np.eye(4)
        down = exp_screw(J[:, i], -h) if J[:3, i].any() else np.eye(4)
        for m, c in list(zip(masses, coms_world))[i:]:
            climb = up[:3, :3] @ c + up[:3, 3] - down[:3, :3] @ c - down[:3, 3]
            tau[i] -= m * g @ climb / (2 * h)
    return tau
