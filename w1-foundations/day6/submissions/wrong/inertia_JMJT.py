# task 6.1: M-not-inverted
# M as it is, from a formula for another mass matrix.
import numpy as np


def task_inertia(J, M):
    return J @ M @ J.T
