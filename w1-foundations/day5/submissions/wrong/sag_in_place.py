# task 5.4: shares-its-argument
# Writes into what it is given.
import numpy as np


def sag_step(q_goal, g_at_q, kp):
    q_goal -= g_at_q / kp
    return q_goal
