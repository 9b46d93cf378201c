# task 3.2: space-for-site
# J_space comes back.
import numpy as np


def site_jacobian(J_space, p):
    return J_space.copy()
