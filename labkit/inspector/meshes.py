"""The meshes of one arm in the scene: the real one, the student's, a tab's ghost."""

from collections.abc import Mapping

import numpy as np
import viser

from labkit.inspector.shapes import Shape
from labkit.inspector.triad import place
from robo47.checks import Array

Colour = tuple[int, int, int]


class Skin:
    """The meshes of an arm, each hanging from a node that is its body."""

    def __init__(self, server: viser.ViserServer, path: str) -> None:
        """Begin a bare arm; `put_on` brings the meshes.

        Args:
            server: where to draw.
            path: its name in the scene tree.
        """
        self.server, self.path = server, path
        self.bodies: dict[str, viser.FrameHandle] = {}
        self.meshes: list[tuple[viser.MeshHandle, Shape]] = []
        self.posed: Mapping[str, Array | None] = {}

    def put_on(
        self,
        shapes: list[Shape],
        colour: Colour | None = None,
        opacity: float | None = None,
    ) -> None:
        """Replace its meshes.

        Args:
            shapes: what to draw.
            colour: of all of them; None for their own.
            opacity: 0 to 1; None for solid.
        """
        old, self.meshes = self.meshes, []
        for i, shape in enumerate(shapes):
            path = f"{self.path}/{shape.body}"
            if shape.body not in self.bodies:
                self.bodies[shape.body] = self.server.scene.add_frame(
                    path, show_axes=False
                )
            r, g, b = (int(255 * c) for c in shape.rgba[:3])
            mesh = self.server.scene.add_mesh_simple(
                f"{path}/{len(shapes)}_{i}",
                shape.vertices.astype(np.float32),
                shape.faces,
                color=colour or (r, g, b),
                opacity=opacity,
            )
            self.meshes.append((mesh, shape))
        self.pose(self.posed)
        for mesh, _ in old:  # after the new ones: no moment without an arm
            mesh.remove()

    def pose(self, poses: Mapping[str, Array | None]) -> None:
        """Move its bodies; one without a pose is hidden.

        Args:
            poses: {body: T_world_body (4, 4)}.
        """
        self.posed = poses
        for name, body in self.bodies.items():
            T = poses.get(name)
            body.visible = T is not None
            if T is not None:
                place(body, T)

    def look(
        self, opacity: float | None, shade: tuple[float, float, float] = (1, 1, 1)
    ) -> None:
        """Make it see-through, and darker.

        Args:
            opacity: 0 to 1; None for solid.
            shade: its colours (r, g, b) are multiplied by it.
        """
        for mesh, shape in self.meshes:
            rgb = zip(shape.rgba[:3], shade, strict=True)
            r, g, b = (int(255 * c * s) for c, s in rgb)
            mesh.color, mesh.opacity = (r, g, b), opacity

    def remove(self) -> None:
        """Take it off the scene."""
        for body in self.bodies.values():
            body.remove()
        self.bodies, self.meshes = {}, []
