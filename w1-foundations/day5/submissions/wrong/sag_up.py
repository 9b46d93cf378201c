# task 5.4: sags-upwards
# Plus.
import numpy as np


def sag_step(q_goal, g_at_q, kp):
    return q_goal + g_at_q / kp
