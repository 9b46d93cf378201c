# task 6.4: all-zeros
# Nothing moves the hand, nothing holds the elbow.
import numpy as np


def null_torque(J, M, Lambda, tau):
    return 0 * tau
