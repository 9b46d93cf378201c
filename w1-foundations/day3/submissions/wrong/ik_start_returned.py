# task 3.6: start-returned
# The start comes back.
import numpy as np


def solve_ik(screws, M, T_goal, q_start, limits):
    return q_start.copy()
