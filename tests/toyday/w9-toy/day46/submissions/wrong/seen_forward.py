# task 46.7: not-undone
# T p.
import numpy as np


def seen_from(T_world_hand, p_world):
    return (T_world_hand @ np.append(p_world, 1.0))[:3]
