# task 6.4: M-left-out
# The torque used as an acceleration.
import numpy as np


def null_torque(J, M, Lambda, tau):
    return tau - J.T @ Lambda @ J @ tau
