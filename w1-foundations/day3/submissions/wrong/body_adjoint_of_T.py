# task 3.9: adjoint-of-T
# Ad(T).
import numpy as np

from robo47.screws import adjoint


def body_jacobian(J_space, T):
    return adjoint(T) @ J_space
