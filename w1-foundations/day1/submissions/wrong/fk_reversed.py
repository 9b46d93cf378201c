# task 1.6: chain-reversed
# Each new step is multiplied on from the left.
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


def compose_fk(model, q):
    T = np.eye(4)
    for i in range(1, 8):
        body = model.body(f"link{i}")
        T = link_T(body.pos, body.quat) @ joint_T(q[i - 1]) @ T
    flange = model.body("attachment")
    return link_T(flange.pos, flange.quat) @ T
