# task 5.6: passed
# einsum, each term through M.
import numpy as np


def computed_torque(M, bias, damping, qd, e, ed, qdd_ref, kp, kd):
    return (
        np.einsum("ij,kj->i", M, [qdd_ref, kp * e, kd * ed])
        + bias
        + np.diag(damping) @ qd
    )
