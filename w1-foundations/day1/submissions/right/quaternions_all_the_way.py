# tasks 1.6 1.8: passed
# The chain in quaternions and vectors; a matrix only at the very end.
import numpy as np


def multiply(a, b):
    w = a[0] * b[0] - a[1:] @ b[1:]
    return np.array([w, *(a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:]))])


def turn(quat, v):
    return v + 2 * np.cross(quat[1:], np.cross(quat[1:], v) + quat[0] * v)


def walk(model, q, names):
    quat, place = np.array([1.0, 0, 0, 0]), np.zeros(3)
    for i, name in enumerate(names):
        place = place + turn(quat, model.body(name).pos)
        quat = multiply(quat, model.body(name).quat)
        if 0 < i < 8:
            half = q[i - 1] / 2
            quat = multiply(quat, np.array([np.cos(half), 0, 0, np.sin(half)]))
    T = np.eye(4)
    T[:3, :3] = np.array([turn(quat, axis) for axis in np.eye(3)]).T
    T[:3, 3] = place
    return T


def compose_fk(model, q):
    return walk(model, q, [f"link{i}" for i in range(8)] + ["attachment"])


def link4_to_world(model, q):
    return walk(model, q, [f"link{i}" for i in range(5)])
