# tasks 1.2 1.4 1.6: float32
# All in float32: right to seven digits, which is what it can hold.
import numpy as np

NUMBER = np.float32


def Rz(theta):
    c, s = NUMBER(np.cos(theta)), NUMBER(np.sin(theta))
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]], dtype=NUMBER)


def quat_to_R(quat):
    quat = np.asarray(quat, dtype=NUMBER)
    w, x, y, z = quat / np.linalg.norm(quat)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]], dtype=NUMBER)
    return np.eye(3, dtype=NUMBER) + NUMBER(2) * (w * cross + cross @ cross)


def step(pos, R):
    T = np.eye(4, dtype=NUMBER)
    T[:3, :3], T[:3, 3] = R, pos
    return T


def compose_fk(model, q):
    base = model.body("link0")
    T = step(base.pos, quat_to_R(base.quat))
    for i in range(1, 8):
        body = model.body(f"link{i}")
        T = T @ step(body.pos, quat_to_R(body.quat)) @ step(0, Rz(q[i - 1]))
    flange = model.body("attachment")
    return T @ step(flange.pos, quat_to_R(flange.quat))
