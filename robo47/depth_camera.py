"""A camera of a MuJoCo model and its depth image, computed without OpenGL.

A ray is cast through the centre of every pixel, so this works on any machine. Camera
axes, pixels and depth are defined as in `robo47.camera`. Metres.
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
    """Return the intrinsic matrix and the pose of a model's camera.

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
    """Return the centre of every pixel, row by row from the top, (width height, 2)."""
    u, v = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    return np.column_stack([u.ravel(), v.ravel()])


def depth(model: mujoco.MjModel, data: mujoco.MjData, name: str) -> Array:
    """Return a camera's depth image: the nearest surface's distance along the z axis.

    `mj_multiRay` returns the distance in multiples of the ray's norm. The rays have the
    length 1 along z, so the result is the depth; with unit vectors it would be the
    distance along the ray.

    Args:
        model: has a camera of that name with a resolution. Rays meet the visible geoms
            of the groups 0 to 2, which include the robot's visual meshes if it has any.
        data: after `mj_forward`.
        name: of the camera.

    Returns:
        Metres, (height, width); infinity where no surface is.

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
    """Return the pose, (4, 4), of a camera that points at a target, image upright.

    Args:
        at, to: position of the camera and the target, metres, (3,); the direction must
            not be vertical.
    """
    z = checks.unit(np.subtract(to, at), "to - at")
    x = checks.unit(np.cross(z, (0.0, 0.0, 1.0)), "the way to the right")
    return se3.make_T(np.column_stack([x, np.cross(z, x), z]), at)  # y down


def add(body, name: str, at: Array, to: Array, fovy: float, size: tuple[int, int]):
    """Add a camera with an upright image to a body of a MjSpec.

    Args:
        body: of a spec, as `spec.worldbody`.
        name: of the camera.
        at, to: position of the camera and its target in the body frame, metres, (3,);
            the direction must not be vertical.
        fovy: vertical field of view, degrees, as in MuJoCo.
        size: width and height of the image, pixels.

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
