# task 1.4: raises
# A quaternion is unpacked into three.
import numpy as np


def quat_to_R(quat):
    x, y, z = quat
    return np.diag([x, y, z])
