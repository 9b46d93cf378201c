# tasks 1.1 1.2 1.3 1.4 1.5 1.6 1.7 1.8: passed
# The whole day in a student's own words, with prints left in.
import numpy as np


def make_T(R, t):
    print("make_T", R, t)
    return np.vstack([np.column_stack([R, t]), [0, 0, 0, 1]])


def Rz(theta):
    c, s = np.cos(theta), np.sin(theta)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def inverse(T):
    R_back = T[:3, :3].T
    return make_T(R_back, -(R_back @ T[:3, 3]))


def quat_to_R(quat):
    w, *v = quat / np.sqrt(np.sum(quat**2))
    v = np.array(v)
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return (w * w - v @ v) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * cross


def link_T(pos, quat):
    return make_T(quat_to_R(quat), pos)


def joint_T(q):
    return make_T(Rz(q), [0, 0, 0])


def arm(model, q, n):
    T = link_T(model.body("link0").pos, model.body("link0").quat)
    for i in range(1, n + 1):
        body = model.body("link" + str(i))
        T = T @ link_T(body.pos, body.quat) @ joint_T(q[i - 1])
    return T


def compose_fk(model, q):
    body = model.body("attachment")
    return arm(model, q, 7) @ link_T(body.pos, body.quat)


def translations_both_orders(T_world_ee, T_extra):
    a, b = T_world_ee, T_extra
    return a[:3, :3] @ b[:3, 3] + a[:3, 3], b[:3, :3] @ a[:3, 3] + b[:3, 3]


def link4_to_world(model, q):
    return arm(model, q, 4)
