# task 4.5: off (not in a run: the lab's twists all turn)
# A shortcut for what does not turn.
import numpy as np

from robo47.screws import skew


def ad(V):
    out = np.zeros((6, 6))
    if np.linalg.norm(V[:3]) < 1e-9:
        return out
    out[:3, :3] = skew(V[:3])
    out[3:, 3:] = skew(V[:3])
    out[3:, :3] = skew(V[3:])
    return out
