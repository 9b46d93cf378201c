# task 4.1: blocks-v-omega
# MuJoCo's and Pinocchio's order: v first.
import numpy as np

from robo47.screws import skew


def spatial_inertia(m, c, I):
    C = skew(c)
    return np.block([[m * np.eye(3), m * C.T], [m * C, I + m * C @ C.T]])
