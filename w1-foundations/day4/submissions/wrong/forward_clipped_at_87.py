# task 4.8: torque-clipped (not in a run: the lab's torques are within the limits)
# One limit for all motors.
import numpy as np


def forward_dynamics(M, bias, damping, qd, tau):
    return np.linalg.solve(M, np.clip(tau, -87, 87) - bias - damping * qd)
