# task 1.7: summed-by-entries
# R * t, summed along the rows in the wrong direction.
import numpy as np


def predict_order(T_world_ee, T_extra):
    R, t = T_world_ee[:3, :3], T_world_ee[:3, 3]
    R_x, t_x = T_extra[:3, :3], T_extra[:3, 3]
    first = (R * t_x[:, None]).sum(axis=1) + t
    return first, (R_x * t[:, None]).sum(axis=1) + t_x
