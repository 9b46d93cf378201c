# task 6.4: another-projector
# Another projector: still no push at the hand.
import numpy as np


def null_torque(J, M, Lambda, tau):
    n = np.linalg.svd(J)[2][-1]
    return M @ n * (n @ np.linalg.solve(M, tau))
