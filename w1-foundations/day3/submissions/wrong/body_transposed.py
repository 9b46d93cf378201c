# task 3.9: transposed-adjoint
# The transpose for the inverse.
import numpy as np

from robo47.screws import adjoint


def body_jacobian(J_space, T):
    return adjoint(T).T @ J_space
