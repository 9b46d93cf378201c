# task 1.6: qposadr-is-an-array
# qposadr without [0].
import mujoco
import numpy as np


def moved(pos, quat):
    T, R = np.eye(4), np.zeros(9)
    mujoco.mju_quat2Mat(R, quat)
    T[:3, :3], T[:3, 3] = R.reshape(3, 3), pos
    return T


def compose_fk(model, q):
    T = np.eye(4)
    for i in range(1, 8):
        body, joint = model.body(f"link{i}"), model.joint(f"joint{i}")
        half = q[joint.qposadr] / 2
        turn = moved(np.zeros(3), np.array([np.cos(half), 0, 0, np.sin(half)]))
        T = T @ moved(body.pos, body.quat) @ turn
    flange = model.body("attachment")
    return T @ moved(flange.pos, flange.quat)
