"""The pose of the cube: a depth image, segmented and fitted with the cube's faces.

Metres; poses `T_world_x` are (4, 4).
"""

from typing import Any

import mujoco
import numpy as np

from robo47 import depth_camera, scenes, se3
from robo47.checks import Array
from robo47.delivery import scene
from robo47.errors import Robo47Error

ABOVE = 0.005  # m over the table: what is lower counts as table
BESIDE = 0.02  # m about the wall: what is nearer counts as wall
STARTS = (-np.pi / 6, 0.0, np.pi / 6)  # rad: the nearest faces may be the wrong ones
STEPS = 20  # iterations of the fit, from each start
SEEN = 30  # points that a cube must have, at least


def cube_seen(
    fns: Any,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    *,
    noise: float = 0.0,
    seed: int = 0,
) -> Array:
    """Return `T_world_cube` of the cube on the table, as the eye sees it.

    Args:
        fns: has `camera_matrix`, `back_project`, `icp_step` and `inverse`.
        model, data: of `scene.table_with_wall`; after mj_forward.
        noise: standard deviation of the depths, metres.
        seed: of that noise.

    Returns:
        (4, 4); its yaw is known up to quarter turns.

    Raises:
        Robo47Error: there is no cube in the picture.
    """
    cloud = _on_table(_cloud(fns, model, data, noise, seed))
    if len(cloud) < SEEN:
        raise Robo47Error(
            f"the eye sees {len(cloud)} points above the table; a cube has over {SEEN}."
            " Is back_project (task 10.3) right?"
        )
    faces = cube_faces()
    middle = np.append(
        cloud[:, :2].mean(axis=0), scenes.TABLE_HEIGHT + scenes.CUBE_HALF
    )
    best, least = np.eye(4), np.inf
    for yaw in STARTS:
        T = fns.inverse(fns.make_T(se3.Rz(yaw), middle))  # T_cube_world
        for _ in range(STEPS):
            T = fns.icp_step(T, cloud, faces)
        now = cloud @ T[:3, :3].T + T[:3, 3]
        off = np.linalg.norm(now[:, None] - faces, axis=2).min(axis=1)
        if np.sum(off**2) < least:
            best, least = T, float(np.sum(off**2))
    return fns.inverse(best)


def cube_faces(n: int = 7) -> Array:
    """Return points on the cube's top and four sides, in its own axes, (5 n n, 3)."""
    line = scenes.CUBE_HALF * ((2.0 * np.arange(n) + 1.0) / n - 1.0)
    u, v = (x.ravel() for x in np.meshgrid(line, line))
    out = np.full(u.size, scenes.CUBE_HALF)
    sides = [(u, v, out), (u, out, v), (u, -out, v), (out, u, v), (-out, u, v)]
    return np.vstack([np.column_stack(side) for side in sides])


def _cloud(
    fns: Any, model: mujoco.MjModel, data: mujoco.MjData, noise: float, seed: int
) -> Array:
    """Return the world's points of all pixels that meet something, (n, 3)."""
    far = depth_camera.depth(model, data, "eye").ravel()
    far = far + noise * np.random.default_rng(seed).normal(size=far.shape)
    hit = np.isfinite(far)
    K = fns.camera_matrix(np.deg2rad(scene.FOVY), *scene.PIXELS)
    _, T_world_cam = depth_camera.camera(model, data, "eye")
    return fns.back_project(
        K, T_world_cam, depth_camera.pixel_centres(*scene.PIXELS)[hit], far[hit]
    )


def _on_table(cloud: Array) -> Array:
    """Return the points that stand on the table and are no wall's, (m, 3)."""
    over = cloud[:, 2] - scenes.TABLE_HEIGHT
    low = (over > ABOVE) & (over < 2.0 * scenes.CUBE_HALF + ABOVE)
    inside = np.abs(cloud[:, :2] - scenes.TABLE_CENTRE) < scenes.TABLE_HALF
    beside = np.abs(cloud - scene.WALL_AT) > np.add(scene.WALL_HALF, BESIDE)
    return cloud[low & inside.all(axis=1) & beside.any(axis=1)]
