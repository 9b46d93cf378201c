# task 5.4: passed
# On one fraction bar.
import numpy as np


def sag_step(q_goal, g_at_q, kp):
    return (kp * q_goal - g_at_q) / kp
