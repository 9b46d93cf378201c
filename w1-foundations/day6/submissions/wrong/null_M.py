# task 6.4: M-not-inverted
# M tau for M^-1 tau.
import numpy as np


def null_torque(J, M, Lambda, tau):
    return tau - J.T @ Lambda @ J @ M @ tau
