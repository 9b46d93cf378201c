# task 5.1: damper-through-both-gains
# One kp before all.
import numpy as np


def pd_torque(e, ed, kp, kd):
    return kp * (e + kd * ed)
