# task 1.2: nothing-returned
# The body is `pass`.
import numpy as np


def Rz(theta):
    """Return the turn by theta radians about z."""
    pass
