# task 2.7: passed
# [Ad(T) V] = T [V] T^-1, column by column.
import numpy as np


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def adjoint(T):
    columns = []
    for V in np.eye(6):
        A = np.zeros((4, 4))
        A[:3, :3], A[:3, 3] = skew(V[:3]), V[3:]
        B = T @ A @ np.linalg.inv(T)
        columns.append([B[2, 1], B[0, 2], B[1, 0], *B[:3, 3]])
    return np.array(columns).T


def body_screws(screws, M):
    return np.linalg.solve(adjoint(M), screws.T).T
