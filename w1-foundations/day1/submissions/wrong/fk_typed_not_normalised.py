# task 1.6: not-normalised
# Typed off the file and used as they are: (1, -1, 0, 0) is not of length 1.
import numpy as np

STEPS = [
    ((0, 0, 0.333), (1, 0, 0, 0)),
    ((0, 0, 0), (1, -1, 0, 0)),
    ((0, -0.316, 0), (1, 1, 0, 0)),
    ((0.0825, 0, 0), (1, 1, 0, 0)),
    ((-0.0825, 0.384, 0), (1, -1, 0, 0)),
    ((0, 0, 0), (1, 1, 0, 0)),
    ((0.088, 0, 0), (1, 1, 0, 0)),
    ((0, 0, 0.107), (0.3826834, 0, 0, 0.9238795)),
]


def compose_fk(model, q):
    T = np.eye(4)
    for (pos, (w, x, y, z)), angle in zip(STEPS, [*q, 0.0], strict=True):
        step = np.eye(4)
        step[0, :3] = w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * x * z
        step[1, :3] = 2 * (x * y + w * z), w * w - x * x + y * y - z * z, -2 * w * x
        step[2, :3] = 2 * x * z, 2 * w * x, w * w - x * x - y * y + z * z
        step[:3, 3] = pos
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        T = T @ step @ turn
    return T
