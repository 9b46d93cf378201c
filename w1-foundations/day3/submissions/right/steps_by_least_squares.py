# tasks 3.5 3.8: passed
# lstsq, with the damping as seven more equations.
import numpy as np


def dls_step(J, e, damping):
    A = np.vstack([J, damping * np.eye(7)])
    return np.linalg.lstsq(A, np.append(e, np.zeros(7)), rcond=None)[0]


def null_step(J, dq):
    return dq - np.linalg.lstsq(J, J @ dq, rcond=None)[0]
