# task 2.2: passed
# By a quaternion and Day 1's library.
import numpy as np

from robo47.se3 import quat_to_R


def exp_rotation(axis, theta):
    return quat_to_R(np.hstack([np.cos(theta / 2), np.sin(theta / 2) * axis]))
