# task 4.8: torque-clipped (not in a run: the lab's torques are within the limits)
# The limits of the motors, from the data sheet.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    most = np.array([87, 87, 87, 87, 12, 12, 12])
    return np.linalg.solve(M, np.clip(tau, -most, most) - bias - damping * qd)
