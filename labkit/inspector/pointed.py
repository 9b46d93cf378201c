"""Names the link that was clicked and shows the axis that its joint turns about."""

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.inspector.arm import Arm
from labkit.inspector.draw import joined, lines
from labkit.inspector.shapes import COLLISION_GROUPS, VISIBLE_GROUPS

AXIS = 0.3  # metres, to both sides
SHORT, FAR = 1e-6, 1e6  # metres of a ray


class Pointed:
    """What was clicked, its name and its axis in the scene."""

    def __init__(self, server: viser.ViserServer, arm: Arm) -> None:
        """Make the axis and the name, hidden until a link is clicked."""
        self.server, self.arm = server, arm
        self.model: mujoco.MjModel | None = None
        self.body = 0
        nowhere = np.zeros((1, 2, 3))
        self.line = lines(server, "/pointed/axis", nowhere, "purple", 3.0)
        self.line.visible = False
        self.label = server.scene.add_label(
            "/pointed/name", "", visible=False, font_screen_scale=0.9
        )

        @server.scene.on_click()  # type: ignore[arg-type]
        async def _(event: viser.SceneClickEvent) -> None:
            self.body = self.find(event.ray_origin, event.ray_direction)
            self.show()

    def watch(self, model: mujoco.MjModel) -> None:
        """Look for links from now on, in the arm's model with its shapes."""
        self.model, self.data = model, mujoco.MjData(model)

    def show(self) -> None:
        """Name what was clicked, where it is now; or nothing."""
        self.label.visible = self.line.visible = bool(self.body)
        if not self.body or self.model is None:
            return
        self._pose()
        name = self.model.body(self.body).name
        self.label.position = self.data.xpos[self.body]
        joint = int(self.model.body_jntadr[self.body])
        self.line.visible = joint >= 0
        if joint < 0:
            self.label.text = f"{name}: no joint of its own"
            return
        kind = mujoco.mjtJoint(self.model.jnt_type[joint])
        does = "slides along" if kind == mujoco.mjtJoint.mjJNT_SLIDE else "turns about"
        self.label.text = f"{name}: {self.model.joint(joint).name} {does} this axis"
        anchor, axis = self.data.xanchor[joint], self.data.xaxis[joint]
        self.line.points = joined([anchor - AXIS * axis, anchor + AXIS * axis])

    def find(self, origin: ArrayLike, direction: ArrayLike) -> int:
        """Return the id of the body that a ray meets first; 0 for none.

        Args:
            origin: metres, (3,); it may be anything.
            direction: (3,).
        """
        start, ray = np.array(origin, dtype=float), np.array(direction, dtype=float)
        near = np.abs([start, ray]).max() < FAR  # not NaN either
        if self.model is None or not near or np.linalg.norm(ray) < SHORT:
            return 0  # no browser says that: MuJoCo would stop over it
        self._pose()
        simple = np.isin(self.model.geom_group, COLLISION_GROUPS).any()
        groups = COLLISION_GROUPS if simple else VISIBLE_GROUPS
        wanted = np.array([g in groups for g in range(6)], dtype=np.uint8)
        geom, ray = np.array([-1], dtype=np.int32), ray / np.linalg.norm(ray)
        mujoco.mj_ray(self.model, self.data, start, ray, wanted, True, -1, geom)
        return int(self.model.geom_bodyid[geom[0]]) if geom[0] >= 0 else 0

    def _pose(self) -> None:
        assert self.model is not None
        self.data.qpos[:] = self.arm.q
        mujoco.mj_kinematics(self.model, self.data)
