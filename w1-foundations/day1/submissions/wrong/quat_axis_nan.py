# task 1.4: not-finite
# Axis and angle, but no turn has no axis: 0 / 0.
import numpy as np


def quat_to_R(quat):
    quat = quat / np.linalg.norm(quat)
    angle = 2 * np.arccos(quat[0])
    with np.errstate(invalid="ignore"):
        x, y, z = quat[1:] / np.linalg.norm(quat[1:])
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
