# tasks 3.1 3.9: passed
# All by hand, with plain loops: nothing of Day 2 is imported.
import numpy as np


def cross_matrix(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def move(S, theta):
    K = cross_matrix(S[:3])
    s, c = np.sin(theta), np.cos(theta)
    T = np.eye(4)
    T[:3, :3] = np.eye(3) + s * K + (1 - c) * K @ K
    T[:3, 3] = (theta * np.eye(3) + (1 - c) * K + (theta - s) * K @ K) @ S[3:]
    return T


def space_jacobian(screws, q):
    J = np.zeros((6, 7))
    T = np.eye(4)
    for i in range(7):
        w = T[:3, :3] @ screws[i, :3]
        v = T[:3, :3] @ screws[i, 3:]
        J[:3, i] = w
        J[3:, i] = v + np.cross(T[:3, 3], w)
        T = T @ move(screws[i], q[i])
    return J


def body_jacobian(J_space, T):
    R, p = T[:3, :3], T[:3, 3]
    J = np.zeros((6, 7))
    for i in range(7):
        J[:3, i] = R.T @ J_space[:3, i]
        J[3:, i] = R.T @ (J_space[3:, i] - np.cross(p, J_space[:3, i]))
    return J
