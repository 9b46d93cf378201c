# task 1.5: pos-divided
# pos is divided by 1000.
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


def link_T(pos, quat):  # noqa: F811 (the mistake)
    return make_T(quat_to_R(quat), pos / 1000)
