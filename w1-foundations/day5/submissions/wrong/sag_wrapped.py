# task 5.4: answer-wrapped
# The answer within half a turn.
import numpy as np


def sag_step(q_goal, g_at_q, kp):
    q = q_goal - g_at_q / kp
    return (q + np.pi) % (2 * np.pi) - np.pi
