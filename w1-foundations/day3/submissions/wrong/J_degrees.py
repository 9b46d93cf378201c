# task 3.1: degrees
# q converted to degrees first.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    T = np.eye(4)
    columns = []
    for S, theta in zip(screws, np.rad2deg(q)):
        columns.append(adjoint(T) @ S)
        T = T @ exp_screw(S, theta)
    return np.array(columns).T
