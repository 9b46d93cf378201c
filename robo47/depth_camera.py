"""A camera of a MuJoCo model and the depth image that it takes, without OpenGL.

A ray is cast through every pixel's middle, so it works on any machine. Camera axes,
pixels and depth are as in `robo47.camera`. Metres.
"""

import mujoco
import numpy as np

from robo47 import checks, se3
from robo47.camera import camera_matrix
from robo47.checks import Array
from robo47.errors import Robo47Error

# MuJoCo's camera has y up and looks along -z (MuJoCo documentation, XML reference,
# "camera"): half a turn about x takes our axes to its.
FLIP = np.diag([1.0, -1.0, -1.0])
# After 3.3 mj_multiRay took one argument more, for the normals; None leaves them out.
_NORMALS = (None,) if "normal:" in str(mujoco.mj_multiRay.__doc__) else ()


def camera(
    model: mujoco.MjModel, data: mujoco.MjData, name: str
) -> tuple[Array, Array]:
    """Return what a camera's pixels mean and where it is.

    Args:
        model: has a camera of that name with a resolution.
        data: after `mj_forward`, which fills cam_xpos and cam_xmat.
        name: of the camera.

    Returns:
        K, pixels, (3, 3), and `T_world_cam`, (4, 4).

    Raises:
        Robo47Error: the model has no such camera.
    """
    i = _number(model, name)
    width, height = model.cam_resolution[i]
    K = camera_matrix(np.deg2rad(model.cam_fovy[i]), width, height)
    R = data.cam_xmat[i].reshape(3, 3) @ FLIP
    return K, se3.make_T(R, data.cam_xpos[i])


def pixel_centres(width: int, height: int) -> Array:
    """Return the middle of every pixel, row by row from the top, (width height, 2)."""
    u, v = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    return np.column_stack([u.ravel(), v.ravel()])


def depth(model: mujoco.MjModel, data: mujoco.MjData, name: str) -> Array:
    """Return a camera's depth image: how far along its view the nearest thing is.

    `mj_multiRay` returns how often the ray's own length fits, so rays that are 1 long
    along z return depth, where unit vectors would return the way along the ray.

    Args:
        model: has a camera of that name with a resolution. Rays meet what is drawn
            of geom groups 0 to 2: the robot's looks among them, where it has any.
        data: after `mj_forward`.
        name: of the camera.

    Returns:
        Metres, (height, width); infinity where there is nothing.

    Raises:
        Robo47Error: the model has no such camera.
    """
    K, T_world_cam = camera(model, data, name)
    width, height = map(int, model.cam_resolution[_number(model, name)])
    n = width * height
    through = np.column_stack([pixel_centres(width, height), np.ones(n)])
    rays = np.linalg.solve(K, through.T).T @ T_world_cam[:3, :3].T
    hit = np.empty(n, np.int32)
    far = np.empty(n)
    groups = np.array([1, 1, 1, 0, 0, 0], np.uint8)
    mujoco.mj_multiRay(
        model, data, T_world_cam[:3, 3], rays.ravel(), groups, 1, -1, hit, far,
        *_NORMALS, n, mujoco.mjMAXVAL,
    )  # fmt: skip
    return np.where(hit < 0, np.inf, far).reshape(height, width)


def look_at(at: Array, to: Array) -> Array:
    """Return the pose of a camera whose picture's top is up, (4, 4).

    Args:
        at, to: where it hangs and what it looks at, metres, (3,); not straight up or
            down.
    """
    z = checks.unit(np.subtract(to, at), "to - at")
    x = checks.unit(np.cross(z, (0.0, 0.0, 1.0)), "the way to the right")
    return se3.make_T(np.column_stack([x, np.cross(z, x), z]), at)  # y down


def add(body, name: str, at: Array, to: Array, fovy: float, size: tuple[int, int]):
    """Add a camera to a body of a MjSpec; its picture's top is up.

    Args:
        body: of a spec, as `spec.worldbody`.
        name: of the camera.
        at, to: where it hangs and what it looks at, in the body's axes, metres, (3,);
            not straight up or down.
        fovy: angle of view from top to bottom, degrees, as MuJoCo has it.
        size: width and height of its picture, pixels.

    Returns:
        The spec's camera.
    """
    quat = se3.R_to_quat(look_at(at, to)[:3, :3] @ FLIP)
    return body.add_camera(name=name, pos=at, quat=quat, fovy=fovy, resolution=size)


def _number(model: mujoco.MjModel, name: str) -> int:
    i = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_CAMERA, name)
    if i < 0:
        known = [model.camera(k).name for k in range(model.ncam)]
        raise Robo47Error(f"the model has no camera {name!r}; it has {known}")
    return i
