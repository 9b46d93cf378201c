# task 1.2: passed
# A turn of the plane is a product with exp(i theta).
import numpy as np


def Rz(theta):
    turn = np.exp(1j * theta)
    x, y = turn, turn * 1j
    return np.array([[x.real, y.real, 0.0], [x.imag, y.imag, 0.0], [0.0, 0.0, 1.0]])
