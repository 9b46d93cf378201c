# task 1.2: one-array-for-all (not in a run: the lab copies what Rz returns at once)
# One array at the top of the file is filled anew.
import numpy as np

OUT = np.eye(3)


def Rz(theta):
    OUT[0, 0] = OUT[1, 1] = np.cos(theta)
    OUT[1, 0], OUT[0, 1] = np.sin(theta), -np.sin(theta)
    return OUT
