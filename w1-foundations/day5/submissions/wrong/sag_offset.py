# task 5.4: goal-forgotten
# Only the sag.
import numpy as np


def sag_step(q_goal, g_at_q, kp):
    return -g_at_q / kp
