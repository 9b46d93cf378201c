# task 1.6: all-zeros
# Read from MuJoCo's data before anything was computed.
import mujoco
import numpy as np


def compose_fk(model, q):
    data = mujoco.MjData(model)
    data.qpos[:] = q
    T = np.zeros((4, 4))
    T[:3, :3] = data.site("attachment_site").xmat.reshape(3, 3)
    T[:3, 3] = data.site("attachment_site").xpos
    return T
