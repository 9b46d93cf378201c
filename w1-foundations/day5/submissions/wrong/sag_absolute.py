# task 5.4: always-below
# Sags down, whatever g's sign.
import numpy as np


def sag_step(q_goal, g_at_q, kp):
    return q_goal - np.abs(g_at_q) / kp
