"""Draws the arm: meshes where MuJoCo puts the bodies, triads where we put the frames.

Red, green and blue are a frame's x, y and z axes. Metres.
"""

from collections.abc import Collection

import numpy as np
import viser

from robo47 import se3
from robo47.checks import Array
from robo47.inspector.arm import Arm
from robo47.inspector.shapes import shapes

# Seen from its right and front; aimed beside the arm, since the panel covers the
# right third of the page.
CAMERA, LOOK_AT, FOV = (1.75, -1.45, 0.95), (0.42, 0.24, 0.4), 0.72
BACKDROP = (214, 220, 228)  # a white arm needs something darker behind it
PLAIN = {"axes_length": 0.11, "axes_radius": 0.0035, "origin_radius": 0.008}
CHOSEN = {"axes_length": 0.16, "axes_radius": 0.006, "origin_radius": 0.014}
ORIGIN_PLAIN, ORIGIN_CHOSEN = (120, 124, 130), (255, 176, 0)
# Neighbours whose origins coincide (links 1 and 2, 5 and 6) have labels on two sides.
ANCHORS = ("bottom-left", "center-left", "center-right", "center-left")
SEE_THROUGH = 0.45  # opacity that lets the triads inside the links be seen


class Triad:
    """A frame drawn as three arrows with its name beside it."""

    def __init__(
        self, server: viser.ViserServer, path: str, text: str, anchor: str
    ) -> None:
        """Draw it at the world's origin.

        Args:
            server: where to draw.
            path: its name in the scene tree.
            text: the label.
            anchor: which side of the label touches the frame.
        """
        self.frame = server.scene.add_frame(path)
        self.label = server.scene.add_label(
            f"{path}/name",
            text,
            anchor=anchor,  # type: ignore[arg-type]
            font_screen_scale=0.8,
        )
        self.show(visible=True, chosen=False)

    def place(self, T: Array) -> None:
        """Move it to a pose, (4, 4)."""
        place(self.frame, T)

    def show(self, visible: bool, chosen: bool) -> None:
        """Show or hide it; the chosen one is larger."""
        self.frame.visible = visible
        for name, value in (CHOSEN if chosen else PLAIN).items():
            setattr(self.frame, name, value)
        self.frame.origin_color = ORIGIN_CHOSEN if chosen else ORIGIN_PLAIN


class ArmScene:
    """The arm on its floor, with a triad per frame."""

    def __init__(self, server: viser.ViserServer, arm: Arm) -> None:
        """Draw everything once; `update` only moves it.

        Args:
            server: where to draw.
            arm: what to draw.
        """
        self.arm = arm
        _set_stage(server)
        self.meshes: list[viser.MeshHandle] = []
        self.bodies: dict[str, viser.FrameHandle] = {}
        for i, shape in enumerate(shapes(arm.model)):
            path = f"/arm/{shape.body}"
            if shape.body not in self.bodies:
                self.bodies[shape.body] = server.scene.add_frame(path, show_axes=False)
            mesh = server.scene.add_mesh_simple(
                f"{path}/{i}",
                shape.vertices.astype(np.float32),
                shape.faces,
                color=shape.rgba[:3],
            )
            self.meshes.append(mesh)
        self.triads = {
            name: Triad(server, f"/frames/{name}", name, ANCHORS[i % len(ANCHORS)])
            for i, name in enumerate(arm.names)
        }
        self.way = _lines(server, "/way")
        self.update()

    def update(self) -> None:
        """Move everything to the arm's present configuration."""
        for name, body in self.bodies.items():
            place(body, self.arm.by_mujoco[f"body:{name}"])
        for name, triad in self.triads.items():
            triad.place(self.arm.by_hand[self.arm.names[name]])

    def light(self, chosen: str | None, shown: Collection[str] | None) -> None:
        """Make one frame stand out.

        Args:
            chosen: its short name; None for no one.
            shown: the frames that are drawn at all; None for every one.
        """
        for name, triad in self.triads.items():
            triad.show(shown is None or name in shown, name == chosen)

    def trace(self, origins: Array) -> None:
        """Draw the way from the world through these origins, (n, 3); n = 0: none."""
        joined = np.array([[0.0, 0.0, 0.0], *origins], dtype=np.float32)
        self.way.visible = len(origins) > 0
        if self.way.visible:
            self.way.points = np.stack([joined[:-1], joined[1:]], axis=1)

    def see_through(self, on: bool) -> None:
        """Make the arm's meshes see-through, or solid again."""
        for mesh in self.meshes:
            mesh.opacity = SEE_THROUGH if on else None


class TwoOrdersScene:
    """Both results of T_extra, drawn beside the end effector's frame."""

    def __init__(self, server: viser.ViserServer) -> None:
        """Draw them hidden."""
        self.right = Triad(server, "/extra/right", "T_world_ee @ T_extra", "top-right")
        self.left = Triad(server, "/extra/left", "T_extra @ T_world_ee", "bottom-left")
        self.lines = _lines(server, "/extra/lines")
        self.show(None)

    def update(self, T_world_ee: Array, right: Array, left: Array) -> None:
        """Move both, and the lines that lead to them from the end effector."""
        self.right.place(right)
        self.left.place(left)
        ends = [[T_world_ee[:3, 3], T[:3, 3]] for T in (right, left)]
        self.lines.points = np.array(ends, dtype=np.float32)

    def show(self, chosen: str | None) -> None:
        """Show both with one of them ("right" or "left") standing out, or neither."""
        self.right.show(chosen is not None, chosen == "right")
        self.left.show(chosen is not None, chosen == "left")
        self.lines.visible = chosen is not None


def _set_stage(server: viser.ViserServer) -> None:
    """Set camera, backdrop and floor."""
    camera = server.initial_camera
    camera.position, camera.look_at, camera.fov = CAMERA, LOOK_AT, FOV
    backdrop = np.full((2, 2, 3), BACKDROP, dtype=np.uint8)
    server.scene.set_background_image(backdrop, format="png")
    server.scene.add_grid(
        "/floor",
        2.0,
        2.0,
        cell_size=0.1,
        section_size=0.5,
        cell_thickness=0.5,
        cell_color=(180, 187, 196),
        section_thickness=0.8,
    )


def _lines(server: viser.ViserServer, path: str) -> viser.LineSegmentsHandle:
    """Add line segments that have their points yet to come."""
    return server.scene.add_line_segments(
        path,
        np.zeros((1, 2, 3), dtype=np.float32),
        ORIGIN_CHOSEN,
        thickness=2.5,
        thickness_units="screen",
        visible=False,
    )


def place(node: viser.SceneNodeHandle, T: Array) -> None:
    """Put a node of the scene at a pose, (4, 4)."""
    node.wxyz, node.position = se3.R_to_quat(T[:3, :3]), T[:3, 3]
