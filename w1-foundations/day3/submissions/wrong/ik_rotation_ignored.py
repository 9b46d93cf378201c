# task 3.6: position-only
# Only the translation is steered.
import numpy as np

from robo47.screws import adjoint, exp_screw, fk_space, skew


def space_jacobian(screws: np.ndarray, q: np.ndarray) -> np.ndarray:
    before = [np.eye(4)]
    for motion in exp_screw(screws, q)[:-1]:
        before.append(before[-1] @ motion)
    return (adjoint(np.array(before)) @ screws[:, :, None])[:, :, 0].T


def site_jacobian(J_space: np.ndarray, p: np.ndarray) -> np.ndarray:
    omega, v = J_space[:3], J_space[3:]
    return np.vstack([omega, v - skew(p) @ omega])  # omega x p = -[p] omega


def log_rotation(R: np.ndarray) -> np.ndarray:
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    sine, cosine = np.linalg.norm(a), (np.trace(R) - 1) / 2
    angle = np.arctan2(sine, cosine)
    if cosine > -0.9:
        return a * (angle / sine if sine > 0 else 1.0)
    B = (R + R.T) / 2 - cosine * np.eye(3)  # (1 - cosine) axis axis^T
    column = B[:, np.argmax(np.diag(B))]
    axis = column / np.linalg.norm(column)
    return angle * axis * (-1.0 if a @ axis < 0 else 1.0)


def pose_error(T: np.ndarray, T_goal: np.ndarray) -> np.ndarray:
    R_error = T_goal[:3, :3] @ T[:3, :3].T
    return np.concatenate([log_rotation(R_error), T_goal[:3, 3] - T[:3, 3]])


def dls_step(J: np.ndarray, e: np.ndarray, damping: float) -> np.ndarray:
    return J.T @ np.linalg.solve(J @ J.T + damping**2 * np.eye(6), e)


def solve_ik(
    screws: np.ndarray,
    M: np.ndarray,
    T_goal: np.ndarray,
    q_start: np.ndarray,
    limits: np.ndarray,
) -> np.ndarray:
    q, best, least = q_start.copy(), q_start, np.inf
    for _ in range(61):
        T = fk_space(screws, M, q)
        e = pose_error(T, T_goal) * [0, 0, 0, 1, 1, 1]
        if e @ e < least:
            best, least = q, e @ e
        if least < 1e-8**2:
            break
        J = site_jacobian(space_jacobian(screws, q), T[:3, 3])
        q = np.clip(q + dls_step(J, e, np.sqrt(e @ e / 2 + 1e-6)), *limits.T)
    return best
