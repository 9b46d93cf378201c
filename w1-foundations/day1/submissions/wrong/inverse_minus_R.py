# task 1.3: minus-R
# -R for R transposed.
import numpy as np


def inverse(T):
    back = np.eye(4)
    back[:3, :3], back[:3, 3] = -T[:3, :3], -T[:3, 3]
    return back
