"""Day 19's camera in MuJoCo: a vertical ray for each pixel."""

import mujoco
import numpy as np

UP = 1.0  # m, the height from which the rays start


def ray_heights(
    centres: np.ndarray, radii: np.ndarray, xs: np.ndarray, ys: np.ndarray
) -> np.ndarray:
    """Return the height at which each ray hits a sphere, (h, w), m; 0 for no hit.

    centres (k, 2) and radii (k,) describe spheres whose centres have the height 0; xs
    (w,) and ys (h,) are the coordinates of the pixels.
    """
    spheres = "".join(
        f'<geom type="sphere" pos="{x:.17g} {y:.17g} 0" size="{r:.17g}"/>'
        for (x, y), r in zip(centres, radii, strict=True)
    )
    xml = f"<mujoco><worldbody>{spheres}</worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)  # fills geom_xpos, which mj_ray reads
    heights = np.zeros((len(ys), len(xs)))
    down, hit = np.array([0.0, 0.0, -1.0]), np.zeros(1, np.int32)
    for (i, j), _ in np.ndenumerate(heights):
        start = np.array([xs[j], ys[i], UP])
        length = mujoco.mj_ray(model, data, start, down, None, 1, -1, hit)
        heights[i, j] = UP - length if length >= 0 else 0.0
    return heights
