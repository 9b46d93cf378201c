# task 1.7: by-4x4-products
# The docstring asks for R and t alone; both as one 2x3 array.
import numpy as np


def predict_order(T_world_ee, T_extra):
    both = np.stack([T_world_ee @ T_extra, T_extra @ T_world_ee])
    return both[:, :3, 3]
