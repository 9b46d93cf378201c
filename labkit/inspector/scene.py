"""Draws the arm: meshes where MuJoCo puts the bodies, triads where the library does.

The triads are there at once; the meshes come later, first the simple ones that MuJoCo
collides with, then those that one looks at. Metres.
"""

import asyncio
import contextlib
from collections.abc import Callable, Collection, Mapping, Sequence

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.inspector.arm import Arm
from labkit.inspector.draw import Anchor, Sketch, Triad, joined
from labkit.inspector.meshes import Skin
from labkit.inspector.shapes import COLLISION_GROUPS, LARGER, VISIBLE_GROUPS, Shape
from robo47.checks import Array

View = tuple[tuple[float, float, float], tuple[float, float, float]]
FOV = 0.72  # vertical, radians
# A page that is higher than wide: from so much further away, and so much of its height
# above the middle, since panel and verdict cover the rest.
BACK, ABOVE = 1.9, 0.33
BESIDE = 0.25  # of the height: how far the panel has moved the middle to the side
CONNECTED = 0.3  # seconds until viser's own first camera has been set
# Neighbours whose origins coincide (links 1 and 2, 5 and 6) have labels on two sides.
ANCHORS: tuple[Anchor, ...] = ("bottom-left", "center-left", "top-right", "bottom-left")
SEE_THROUGH = 0.5  # opacity
GREY = (0.48, 0.49, 0.53)  # what a see-through arm's colours are multiplied by
HIGHLIGHT = (255, 176, 0)
GHOST_COLOUR = (214, 40, 40)
AXIS = 0.3  # metres of a joint's axis, to both sides
SHORT, FAR = 1e-6, 1e6  # metres of a ray
# The stage, in the colours of the drawn pictures: its ground, and the floor's lines.
STAGE, CELL, SECTION = (27, 31, 36), (52, 58, 66), (72, 80, 90)


class ArmScene:
    """The arm on its floor with a triad per frame, and the student's as a ghost."""

    def __init__(self, server: viser.ViserServer, arm: Arm) -> None:
        """Draw everything but the meshes; `update` only moves it."""
        self.arm = arm
        self.server = server
        self.hidden = False
        self.view: View | None = None
        set_stage(server)

        @server.on_client_connect
        async def _(client: viser.ClientHandle) -> None:
            await asyncio.sleep(CONNECTED)
            self._welcome(client)

        self.triads = {
            name: Triad(server, f"/frames/{name}", name, ANCHORS[i % len(ANCHORS)])
            for i, name in enumerate(arm.names)
        }
        self.world = Triad(server, "/frames/world", "")
        self.skin = Skin(server, "/arm")
        self.ghost = Skin(server, "/yours", GHOST_COLOUR, 0.6, LARGER)
        self.yours = Triad(server, "/yours_end", "yours", letters=True)
        self.yours.show(visible=False, chosen=True)
        draw = Sketch(server, root="/lines")
        nowhere = np.zeros((1, 2, 3))
        self.way = draw.lines(nowhere, HIGHLIGHT)
        self.gap = draw.lines(nowhere, GHOST_COLOUR)
        self.way.visible = self.gap.visible = False
        self.yours_at: tuple[Mapping[str, Array], str] = ({}, "")
        self.worn: Sequence[Shape] = ()
        self.coarse: Sequence[Shape] = ()
        self.update()

    def dress(self, shapes: Sequence[Shape], ghosts: Sequence[Shape] = ()) -> None:
        """Put meshes on the arm, and others on the ghosts."""
        if self.worn is not shapes:
            self.worn = shapes
            self.skin.put_on(shapes)
        if ghosts:
            self.coarse = ghosts
            self.ghost.put_on(ghosts)
        self.update()

    def update(self) -> None:
        """Move everything to the arm's present configuration."""
        bodies = () if self.hidden else self.skin.bodies
        self.skin.pose({name: self.arm.by_mujoco[f"body:{name}"] for name in bodies})
        for name, triad in self.triads.items():
            triad.place(self.arm.by_library[name])

    def hide(self, hidden: bool = True) -> None:
        """Draw no arm, no ghost of it and no frames, or draw them again."""
        self.hidden = hidden
        self.show_ghost(*self.yours_at)
        self.world.show(not hidden, chosen=False)
        if hidden:
            self.light(None, ())
        self.update()

    def look_from(self, view: View) -> None:
        """Look from another place, in every browser, unless they do already."""
        if view != self.view:
            self.view = view
            camera = self.server.initial_camera
            (camera.position, camera.look_at), camera.fov = view, FOV
            for client in self.server.get_clients().values():
                self._welcome(client)

    def _welcome(self, client: viser.ClientHandle) -> None:
        """Give a browser its camera."""
        with contextlib.suppress(Exception):  # it has told nothing of its size yet
            assert self.view is not None
            view = narrow(self.view) if client.camera.aspect < 1.0 else self.view
            client.camera.position, client.camera.look_at = view

    def show_ghost(self, poses: Mapping[str, Array], end: str) -> None:
        """Draw the student's arm, {short name: (4, 4)}, and a line to its end."""
        self.yours_at = poses, end
        poses = {} if self.hidden else poses
        self.ghost.pose(self.arm.carried(poses))
        there = poses.get(end)
        self.yours.show(there is not None, chosen=True)
        self.gap.visible = there is not None
        if there is not None:
            self.yours.place(there)
        taken = self.yours.labels_at(there) if there is not None else np.zeros((0, 3))
        for name, triad in self.triads.items():
            triad.clear(taken, self.arm.by_library[name])
        self.world.clear(taken, np.eye(4))
        if there is not None:
            self.gap.points = joined([self.arm.pose(end)[:3, 3], there[:3, 3]])

    def light(self, chosen: str | None, shown: Collection[str] | None) -> None:
        """Make one frame stand out; see `Page.light`."""
        for name, triad in self.triads.items():
            triad.show(shown is None or name in shown, name == chosen)

    def trace(self, origins: Sequence[Array]) -> None:
        """Draw the way from the world through these origins, (3,) each; or none."""
        self.way.visible = len(origins) > 0
        if self.way.visible:
            self.way.points = joined([np.zeros(3), *origins])

    def look(self, solid: bool) -> None:
        """Make the arm solid, or see-through."""
        self.skin.look(*(() if solid else (SEE_THROUGH, GREY)))


class Pointed:
    """The link that was clicked: its name, and the axis that its joint turns about."""

    def __init__(
        self, server: viser.ViserServer, arm: Arm, look: Callable[[], None]
    ) -> None:
        """Show nothing yet; `look` is called at a click: an axis is inside of links."""
        self.arm = arm
        self.body = 0
        self.watch(arm.model)
        draw = Sketch(server, root="/pointed")
        self.line = draw.lines(np.zeros((1, 2, 3)), "purple", 3.0)
        self.line.visible = False
        self.label = server.scene.add_label(
            "/pointed/name", "", visible=False, font_screen_scale=0.9
        )

        @server.scene.on_click()  # type: ignore[arg-type]
        async def _(event: viser.SceneClickEvent) -> None:
            self.body = self.find(event.ray_origin, event.ray_direction)
            self.show()
            look()

    def watch(self, model: mujoco.MjModel) -> None:
        """Look for links from now on, in the arm's model with its shapes."""
        self.model = model
        self.data = mujoco.MjData(model)

    def show(self) -> None:
        """Name what was clicked, where it is now; or nothing."""
        joint = int(self.model.body_jntadr[self.body])
        self.label.visible = bool(self.body)
        self.line.visible = joint >= 0
        if not self.body:
            return
        self._pose()
        name = self.model.body(self.body).name
        self.label.position = self.data.xpos[self.body]
        if joint < 0:
            self.label.text = f"{name}: no joint of its own"
            return
        kind = mujoco.mjtJoint(self.model.jnt_type[joint])
        does = "slides along" if kind == mujoco.mjtJoint.mjJNT_SLIDE else "turns about"
        self.label.text = f"{name}: {self.model.joint(joint).name} {does} this axis"
        anchor, axis = self.data.xanchor[joint], self.data.xaxis[joint]
        self.line.points = joined([anchor - AXIS * axis, anchor + AXIS * axis])

    def find(self, origin: ArrayLike, direction: ArrayLike) -> int:
        """Return the id of the body that a ray meets first, (3,) each; 0 for none."""
        start, ray = np.array(origin, dtype=float), np.array(direction, dtype=float)
        near = np.abs([start, ray]).max() < FAR  # false for NaN as well
        if not near or np.linalg.norm(ray) < SHORT:
            return 0  # no browser says that: MuJoCo would stop over it
        self._pose()
        simple = np.isin(self.model.geom_group, COLLISION_GROUPS).any()
        groups = COLLISION_GROUPS if simple else VISIBLE_GROUPS
        wanted = np.array([g in groups for g in range(6)], dtype=np.uint8)
        geom = np.array([-1], dtype=np.int32)
        ray = ray / np.linalg.norm(ray)
        mujoco.mj_ray(self.model, self.data, start, ray, wanted, True, -1, geom)
        return int(self.model.geom_bodyid[geom[0]]) if geom[0] >= 0 else 0

    def _pose(self) -> None:
        self.data.qpos[:] = self.arm.q
        mujoco.mj_kinematics(self.model, self.data)


def narrow(view: View) -> View:
    """Return from where to look at the same in a page that is higher than wide."""
    position, middle = (np.array(point) for point in view)
    back = position - middle
    height = 2.0 * float(np.linalg.norm(back)) * np.tan(FOV / 2.0)
    right = np.cross(np.array([0.0, 0.0, 1.0]), back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right) / np.linalg.norm(back)
    middle = middle - BESIDE * height * right - ABOVE * BACK * height * up
    return tuple(middle + BACK * back), tuple(middle)


def set_stage(server: viser.ViserServer) -> None:
    """Set backdrop and floor, and the light."""
    # viser lights with a photograph of a sky and casts shadows: on a computer without a
    # GPU half a minute before the first picture, and a sixth of the frames.
    server.scene.configure_environment_map(None)
    server.scene.configure_default_lights(cast_shadow=False)
    server.scene.add_light_hemisphere("/sky", ground_color=(190, 195, 205), intensity=2)
    backdrop = np.full((2, 2, 3), STAGE, dtype=np.uint8)
    server.scene.set_background_image(backdrop, format="png")
    server.scene.add_grid(
        "/floor", 2.0, 2.0, cell_size=0.1, section_size=0.5, cell_thickness=0.5,
        cell_color=CELL, section_color=SECTION, section_thickness=0.8,
    )  # fmt: skip
