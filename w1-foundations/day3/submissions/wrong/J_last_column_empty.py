# task 3.1: columns-off
# The loop ends one joint early.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T = np.eye(4)
    columns = []
    for S, theta in zip(screws[:6], q[:6]):
        columns.append(adjoint(T) @ S)
        T = T @ exp_screw(S, theta)
    return np.array([*columns, np.zeros(6)]).T
