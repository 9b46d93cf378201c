# task 3.4: euler-difference
# Roll, pitch and yaw are subtracted.
import numpy as np


def log_rotation(R):
    s = 0.5 * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    c = 0.5 * (np.trace(R) - 1.0)
    n = np.linalg.norm(s)
    theta = np.arctan2(n, c)
    if c > 0:
        return s if n < 1e-12 else s * theta / n
    B = 0.5 * (R + R.T)
    A = (B - c * np.eye(3)) / (1 - c)
    i = np.argmax(np.diag(A))
    axis = A[:, i] / np.linalg.norm(A[:, i])
    if axis @ s < 0:
        axis = -axis
    elif n < 1e-15 and axis[np.argmax(np.abs(axis))] < 0:
        axis = -axis
    return theta * axis


def pose_error(T, T_goal):
    def rpy(R):
        return np.array(
            [
                np.arctan2(R[2, 1], R[2, 2]),
                -np.arcsin(np.clip(R[2, 0], -1, 1)),
                np.arctan2(R[1, 0], R[0, 0]),
            ]
        )

    return np.hstack([rpy(T_goal[:3, :3]) - rpy(T[:3, :3]), T_goal[:3, 3] - T[:3, 3]])
