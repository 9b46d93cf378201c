# task 46.5: arctan-of-the-ratio (not in a run: the lab's point is in the first quadrant)
# arctan for arctan2.
import numpy as np


def polar(x, y):
    return np.array(np.hypot(x, y)), np.array(np.arctan(y / x))
