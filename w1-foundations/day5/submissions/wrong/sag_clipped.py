# task 5.4: off (not in a run: nothing there sags as far)
# No sag of more than 0.5 rad.
import numpy as np


def pd_equilibrium_step(q_goal, g_at_q, kp):
    return q_goal - np.clip(g_at_q / kp, -0.5, 0.5)
