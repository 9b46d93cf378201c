# task 3.8: felt-part
# J^+ J dq.
import numpy as np


def null_step(J, dq):
    return np.linalg.pinv(J) @ (J @ dq)
