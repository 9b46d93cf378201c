# tasks 1.6 1.8: passed
# Asks each body for its parent until the world is reached.
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


def pose(model, q, body):
    if body == 0:
        return np.eye(4)
    T = pose(model, q, model.body_parentid[body])
    T = T @ link_T(model.body_pos[body], model.body_quat[body])
    joint = model.body_jntadr[body]
    return T if joint < 0 else T @ joint_T(q[model.jnt_qposadr[joint]])


def compose_fk(model, q):
    return pose(model, q, model.site("attachment_site").bodyid[0])


def link4_to_world(model, q):
    return pose(model, q, model.body("link4").id)
