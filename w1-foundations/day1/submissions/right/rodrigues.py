# tasks 1.2 1.4: passed
# Axis and angle; the angle by atan2, so that no turn is no special case.
import numpy as np


def about(axis, angle):
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def Rz(theta):
    return about((0, 0, 1), theta)


def quat_to_R(quat):
    length = np.linalg.norm(quat[1:])
    axis = quat[1:] / length if length > 0 else np.array([0, 0, 1])
    return about(axis, 2 * np.arctan2(length, quat[0]))
