# task 1.6: chain-reversed
# Each new step is multiplied on from the left.
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
        body, half = model.body(f"link{i}"), q[i - 1] / 2
        turn = moved(np.zeros(3), [np.cos(half), 0, 0, np.sin(half)])
        T = moved(body.pos, body.quat) @ turn @ T
    flange = model.body("attachment")
    return moved(flange.pos, flange.quat) @ T
