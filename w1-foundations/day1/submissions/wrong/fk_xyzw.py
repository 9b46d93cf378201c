# task 1.6: wxyz-read-as-xyzw
# quat_to_R reads w last, so every link is wrong; this shows in 1.4 as well.
import numpy as np


def compose_fk(model, q):
    T = np.eye(4)
    for name in [f"link{i}" for i in range(1, 8)] + ["attachment"]:
        body = model.body(name)
        x, y, z, w = body.quat
        step = np.eye(4)
        step[0, :3] = 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)
        step[1, :3] = 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)
        step[2, :3] = 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)
        step[:3, 3] = body.pos
        T = T @ step
        if name != "attachment":
            c, s = np.cos(q[int(name[4]) - 1]), np.sin(q[int(name[4]) - 1])
            T = T @ np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    return T
