# tasks 46.2 46.7: passed
# By the library of day 1.
import numpy as np

from robo47.se3 import inverse


def cross(a, b):
    return np.cross(a, b)


def seen_from(T_world_hand, p_world):
    back = inverse(T_world_hand)
    return back[:3, :3] @ p_world + back[:3, 3]
