# task 6.4: not-projected
# All of it.
import numpy as np


def null_torque(J, M, Lambda, tau):
    return tau.copy()
