# task 1.4: not-orthonormal
# The cross terms are right, but the diagonal was "simplified".
import numpy as np


def quat_to_R(quat):
    w, x, y, z = quat / np.linalg.norm(quat)
    return np.array(
        [
            [w * w + x * x, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w + y * y, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w + z * z],
        ]
    )
