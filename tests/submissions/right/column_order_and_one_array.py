# tasks 1.1 1.7: passed
# Fortran order in memory; both predictions as one 2x3 array, by 4x4 products.
import numpy as np


def make_T(R, t):
    T = np.zeros((4, 4), order="F")
    T.T[:3, :3], T.T[3, :3], T.T[3, 3] = np.transpose(R), t, 1
    return T


def predict_order(T_world_ee, T_extra):
    both = np.stack([T_world_ee @ T_extra, T_extra @ T_world_ee])
    return both[:, :3, 3]
