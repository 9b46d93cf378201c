# task 5.4: stiffness-squared
# Divides twice.
import numpy as np


def sag_step(q_goal, g_at_q, kp):
    return q_goal - g_at_q / kp**2
