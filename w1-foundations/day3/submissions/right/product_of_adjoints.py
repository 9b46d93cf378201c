# task 3.1: passed
# The adjoint of a product is the product of the adjoints.
import numpy as np

from robo47.screws import adjoint, exp_screw


def space_jacobian(screws, q):
    A = np.eye(6)
    columns = []
    for S, theta in zip(screws, q):
        columns.append(A @ S)
        A = A @ adjoint(exp_screw(S, theta))
    return np.column_stack(columns)
