# task 1.4: passed
# The columns of R are q e q*: three quaternion products, no formula for R.
import numpy as np


def multiply(a, b):
    w = a[0] * b[0] - a[1:] @ b[1:]
    return np.array([w, *(a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:]))])


def quat_to_R(quat):
    there = quat / np.linalg.norm(quat)
    back = there * [1, -1, -1, -1]
    axes = np.eye(4)[1:]
    columns = [multiply(multiply(there, axis), back)[1:] for axis in axes]
    return np.array(columns).T
