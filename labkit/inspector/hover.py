"""Names the link under the pointer and shows the axis that its joint turns about."""

from typing import NamedTuple

import mujoco
import numpy as np
import viser

from labkit.inspector.arm import Arm
from labkit.inspector.shapes import COLLISION_GROUPS, VISIBLE_GROUPS
from robo47.checks import Array, array

AXIS = 0.3  # metres, to both sides
COLOUR = (150, 70, 150)


class Pointer(NamedTuple):
    """Where the pointer is: shares of the window's width and height, and its aspect."""

    x: float
    y: float
    aspect: float


def pointer(text: str) -> Pointer | None:
    """Return what the page's script says of the pointer; None for "not over the arm".

    Args:
        text: "x,y,aspect" or "".
    """
    try:
        at = array([float(x) for x in text.split(",")], "pointer", (3,))
    except ValueError:
        return None
    return Pointer(*map(float, at))


class Hover:
    """What lies under the pointer, and its name and axis in the scene."""

    def __init__(self, server: viser.ViserServer, arm: Arm) -> None:
        """Make the axis and the name, hidden until the pointer is over a link."""
        self.server, self.arm = server, arm
        self.model: mujoco.MjModel | None = None
        self.line = server.scene.add_line_segments(
            "/hover/axis", np.zeros((1, 2, 3), np.float32), COLOUR,
            thickness=3, thickness_units="screen", visible=False,
        )  # fmt: skip
        self.label = server.scene.add_label(
            "/hover/name", "", visible=False, font_screen_scale=0.9
        )

    def watch(self, model: mujoco.MjModel) -> None:
        """Look for links from now on.

        Args:
            model: the arm's, with its shapes.
        """
        self.data = mujoco.MjData(model)
        self.model = model

    def show(self, at: Pointer | None) -> None:
        """Name what is under the pointer, or nothing."""
        body = self.find(at) if at else 0
        self.label.visible = self.line.visible = bool(body)
        if not body or self.model is None:
            return
        name = self.model.body(body).name
        self.label.position = self.data.xpos[body]
        joint = int(self.model.body_jntadr[body])
        self.line.visible = joint >= 0
        if joint < 0:
            self.label.text = f"{name}: no joint of its own"
            return
        kind = mujoco.mjtJoint(self.model.jnt_type[joint])
        does = "slides along" if kind == mujoco.mjtJoint.mjJNT_SLIDE else "turns about"
        self.label.text = f"{name}: {self.model.joint(joint).name} {does} this axis"
        anchor, axis = self.data.xanchor[joint], self.data.xaxis[joint]
        ends = [anchor - AXIS * axis, anchor + AXIS * axis]
        self.line.points = np.array([ends], dtype=np.float32)

    def find(self, at: Pointer) -> int:
        """Return the id of the body under the pointer; 0 for none."""
        clients = list(self.server.get_clients().values())
        if self.model is None or not clients:
            return 0
        # The pointer's message does not say which browser it is from: the one whose
        # camera moved last is the likeliest.
        camera = max(clients, key=lambda client: client.camera.update_timestamp).camera
        ray = ray_through(at, camera.fov, camera.wxyz)
        self.data.qpos[:] = self.arm.q
        mujoco.mj_kinematics(self.model, self.data)
        simple = np.isin(self.model.geom_group, COLLISION_GROUPS).any()
        groups = COLLISION_GROUPS if simple else VISIBLE_GROUPS
        wanted = np.array([g in groups for g in range(6)], dtype=np.uint8)
        geom = np.array([-1], dtype=np.int32)
        mujoco.mj_ray(
            self.model,
            self.data,
            np.array(camera.position),
            ray,
            wanted,
            True,
            -1,
            geom,
        )
        return int(self.model.geom_bodyid[geom[0]]) if geom[0] >= 0 else 0


def ray_through(at: Pointer, fov: float, wxyz: Array) -> Array:
    """Return the direction from a camera through a point of its picture, (3,).

    Args:
        at: the point.
        fov: vertical angle of view, radians.
        wxyz: the camera's orientation: x right, y down, z into the picture.
    """
    up = np.tan(fov / 2)
    p_cam = np.array([(2 * at.x - 1) * at.aspect * up, (2 * at.y - 1) * up, 1.0])
    R = np.zeros(9)
    mujoco.mju_quat2Mat(R, np.asarray(wxyz, dtype=np.float64))
    ray = R.reshape(3, 3) @ p_cam
    return ray / np.linalg.norm(ray)
