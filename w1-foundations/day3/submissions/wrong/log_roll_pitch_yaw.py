# task 3.3: roll-pitch-yaw
# Roll, pitch and yaw.
import numpy as np


def log_rotation(R):
    return np.array(
        [
            np.arctan2(R[2, 1], R[2, 2]),
            -np.arcsin(np.clip(R[2, 0], -1, 1)),
            np.arctan2(R[1, 0], R[0, 0]),
        ]
    )
