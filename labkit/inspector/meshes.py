"""The meshes of one arm in the scene: the real one, the student's, a tab's ghost."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.inspector.shapes import Shape
from robo47 import se3
from robo47.checks import Array


def place(node: viser.SceneNodeHandle, T: Array) -> None:
    """Put a node of the scene at a pose, (4, 4)."""
    node.wxyz, node.position = se3.R_to_quat(T[:3, :3]), T[:3, 3]


class Skin:
    """The meshes of an arm, each hanging from a node that is its body."""

    def __init__(self, server: viser.ViserServer, path: str) -> None:
        """Begin a bare arm under a name in the scene tree."""
        self.server, self.path = server, path
        self.bodies: dict[str, viser.FrameHandle] = {}
        self.meshes: list[tuple[viser.MeshHandle, Shape]] = []
        self.posed: Mapping[str, Array | None] = {}

    def put_on(
        self,
        shapes: Sequence[Shape],
        colour: tuple[int, int, int] | None = None,
        opacity: float | None = None,
    ) -> None:
        """Replace its meshes; without a colour they have their own, or are solid."""
        scene, old, self.meshes = self.server.scene, self.meshes, []
        for i, shape in enumerate(shapes):
            path = f"{self.path}/{shape.body}"
            if shape.body not in self.bodies:
                self.bodies[shape.body] = scene.add_frame(path, show_axes=False)
            mesh = scene.add_mesh_simple(
                f"{path}/{len(shapes)}_{i}", shape.vertices.astype(np.float32),
                shape.faces, color=colour or _rgb(shape), opacity=opacity,
            )  # fmt: skip
            self.meshes.append((mesh, shape))
        self.pose(self.posed)
        for mesh, _ in old:  # after the new ones: no moment without an arm
            mesh.remove()

    def pose(self, poses: Mapping[str, Array | None]) -> None:
        """Move its bodies, {body: T_world_body (4, 4)}; no pose hides one."""
        self.posed = poses
        for name, body in self.bodies.items():
            T = poses.get(name)
            body.visible = T is not None
            if T is not None:
                place(body, T)

    def poses(self, data: mujoco.MjData, qpos: ArrayLike) -> dict[str, Array]:
        """Return where its bodies are, {body: T_world_body (4, 4)}.

        Args:
            data: of the model whose bodies these are.
            qpos: a configuration; a shorter one is that of the first joints, (n,).
        """
        data.qpos[: len(np.asarray(qpos))] = qpos
        mujoco.mj_kinematics(data.model, data)
        found = {name: data.body(name) for name in self.bodies}
        return {
            name: se3.make_T(body.xmat.reshape(3, 3), body.xpos)
            for name, body in found.items()
        }

    def look(
        self, opacity: float | None, shade: tuple[float, float, float] = (1, 1, 1)
    ) -> None:
        """Make it see-through, or solid, and darker: the shade multiplies (r, g, b)."""
        for mesh, shape in self.meshes:
            mesh.color, mesh.opacity = _rgb(shape, shade), opacity


def _rgb(
    shape: Shape, shade: tuple[float, float, float] = (1, 1, 1)
) -> tuple[int, int, int]:
    r, g, b = (int(255 * c * s) for c, s in zip(shape.rgba[:3], shade, strict=True))
    return r, g, b
