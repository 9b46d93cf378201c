# task 1.1: move-then-turn
# "Turn, then move" written as a product the wrong way round.
import numpy as np


def make_T(R, t):
    turn, move = np.eye(4), np.eye(4)
    turn[:3, :3] = R
    move[:3, 3] = t
    return turn @ move
