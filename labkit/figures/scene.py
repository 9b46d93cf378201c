"""The scene of a picture: the robot's configuration, ghosts of it, and the camera.

Plain data, so that it can be sent to the process that draws.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from robo47 import se3
from robo47.checks import Array

FOVY = np.radians(30.0)  # vertical angle of view; narrow, so that lines stay parallel
FARTHEST = 6.0  # metres
NOBODY = "nobody"
MARGIN = 0.05  # share of the picture left free at its sides


@dataclass(frozen=True)
class Camera:
    """A camera that looks at a point, as MuJoCo's free camera does."""

    # The point in the middle of the picture, metres.
    lookat: tuple[float, float, float] = (0.15, 0.0, 0.40)
    distance: float = 1.85  # the distance of the camera from that point, metres
    # Direction of view about the world's z, radians; 0 looks along x.
    azimuth: float = np.radians(118.0)
    # Direction of view above the horizon, radians; negative looks down.
    elevation: float = np.radians(-14.0)

    @property
    def T_world_cam(self) -> Array:
        """The camera's pose: x to the right of the picture, y up, z out of it."""
        R_world_cam = se3.Rz(self.azimuth - np.pi / 2) @ se3.Rx(
            np.pi / 2 + self.elevation
        )
        back = R_world_cam @ [0.0, 0.0, self.distance]
        return se3.make_T(R_world_cam, back + self.lookat)

    def project(self, p_world: ArrayLike, size: tuple[int, int]) -> Array:
        """Return pixels right of and below the upper left corner, and the depth, m.

        Args:
            p_world: points, (..., 3), metres; in front of the camera.
            size: width and height of the picture, pixels.

        Returns:
            (..., 3).
        """
        T_cam_world = se3.inverse(self.T_world_cam)
        p_cam = np.asarray(p_world) @ T_cam_world[:3, :3].T + T_cam_world[:3, 3]
        depth = -p_cam[..., 2]
        pixels_per_unit = size[1] / 2 / np.tan(FOVY / 2)
        right = size[0] / 2 + pixels_per_unit * p_cam[..., 0] / depth
        below = size[1] / 2 - pixels_per_unit * p_cam[..., 1] / depth
        return np.stack([right, below, depth], axis=-1)

    def stepped_back(self, p_world: Array, size: tuple[int, int]) -> "Camera":
        """Return this camera, or one further away that has points (n, 3) in view."""
        camera = self
        while camera.distance < FARTHEST:
            seen = camera.project(p_world, size)
            off = np.abs(seen[:, :2] / size - 0.5)
            if (off < 0.5 - MARGIN).all() and (seen[:, 2] > 0).all():
                break
            camera = replace(camera, distance=1.1 * camera.distance)
        return camera


@dataclass(frozen=True)
class Ghost:
    """A translucent copy of a body and of all that it carries, moved elsewhere."""

    body: str  # its name
    T_world_moved: Array  # takes every point of it to where the copy is, (4, 4)
    alone: bool = False  # leave out what the body carries
    wrong: bool = False  # red, not blue


@dataclass(frozen=True)
class Box:
    """A box beside the robot, such as a table, or another solid."""

    T_world_box: Array  # the pose of its centre, (4, 4)
    half: tuple[float, float, float]  # half its edges, metres
    colour: tuple[float, float, float, float]  # red, green, blue, opacity, 0 to 1
    kind: str = "box"  # or "sphere", "cylinder", "capsule", with MuJoCo's sizes


@dataclass(frozen=True)
class Scene:
    """One picture to draw."""

    # The configuration of the Panda with its hand, (9,), radians and metres; or that of
    # `robot`, (nq,).
    qpos: Array
    size: tuple[int, int]  # width and height, pixels
    camera: Camera = Camera()  # the camera of the picture
    ghosts: tuple[Ghost, ...] = ()  # translucent copies
    fast: bool = False  # leave out multisampling, shadows and reflections
    boxes: tuple[Box, ...] = ()  # boxes beside the robot
    # The path of an MJCF file, instead of the Panda; NOBODY is the room alone.
    robot: str = ""
