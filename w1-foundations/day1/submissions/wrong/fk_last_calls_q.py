# task 1.6: kept-between-calls
# It uses the q of the call before.
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


def make_T(R, t):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, t
    return T


def link_T(pos, quat):
    return make_T(quat_to_R(quat), pos)


def joint_T(q):
    c, s = np.cos(q), np.sin(q)
    return make_T(np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), np.zeros(3))


PATH = [("link0", None)] + [(f"link{i}", f"joint{i}") for i in range(1, 8)]
PATH += [("attachment", None)]


LAST = [np.zeros(7)]


def compose_fk(model, q, path=PATH):
    T, used = np.eye(4), LAST[0]
    LAST[0] = q.copy()
    for name, joint in path:
        body = model.body(name)
        T = T @ link_T(body.pos, body.quat)
        if joint:
            T = T @ joint_T(used[model.joint(joint).qposadr[0]])
    return T
