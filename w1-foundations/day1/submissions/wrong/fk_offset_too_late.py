# task 1.6: offset-turned-too-late
# R is brought up to date first, and then turns the offset that came before.
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
    R, t = np.eye(3), np.zeros(3)
    angles = dict(zip([f"link{i}" for i in range(1, 8)], q, strict=True))
    for name in [*angles, "attachment"]:
        body = model.body(name)
        R = R @ quat_to_R(body.quat) @ joint_T(angles.get(name, 0.0))[:3, :3]
        t = t + R @ body.pos
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, t
    return T
