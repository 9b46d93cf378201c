# task 1.8: passed
# Only the upper three rows on the way; the last one is added at the end.
import numpy as np


def link4_to_world(model, q):
    x, y, z = np.eye(3)
    p = model.body("link0").pos
    for i in range(1, 5):
        body = model.body(f"link{i}")
        p = p + np.column_stack([x, y, z]) @ body.pos
        # The Panda's links are turned about x only, and its joints about z.
        half = np.arctan2(body.quat[1], body.quat[0])
        c, s = np.cos(2 * half), np.sin(2 * half)
        y, z = c * y + s * z, c * z - s * y
        c, s = np.cos(q[i - 1]), np.sin(q[i - 1])
        x, y = c * x + s * y, c * y - s * x
    return np.vstack([np.column_stack([x, y, z, p]), [0, 0, 0, 1]])
