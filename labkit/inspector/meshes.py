"""Meshes in the scene: the arm, the student's, a tab's ghost."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.inspector.ghost import nearest_pose
from labkit.inspector.shapes import Shape, larger
from robo47 import se3
from robo47.checks import Array

Rgb = tuple[float, float, float]
AS_IS: Rgb = (1, 1, 1)
# The browser remembers the pose of a node that is gone: a name is never given again.
NUMBERS = count()


def place(node: viser.SceneNodeHandle, T: Array) -> None:
    """Put a node of the scene at a pose, (4, 4), or at the one nearest to a wrong T."""
    if not se3.is_pose(T):
        T = nearest_pose(T)
    node.wxyz = se3.R_to_quat(T[:3, :3])
    node.position = T[:3, 3]


@dataclass
class Skin:
    """The meshes of an arm, each hanging from a node that is its body."""

    server: viser.ViserServer
    path: str
    colour: tuple[int, int, int] | None = None  # None: the meshes have their own
    opacity: float | None = None  # None: they are solid
    by: float = 0.0  # metres by which they are larger, see `larger`
    bodies: dict[str, viser.FrameHandle] = field(default_factory=dict)
    meshes: list[tuple[viser.MeshHandle, Shape]] = field(default_factory=list)
    posed: Mapping[str, Array | None] = field(default_factory=dict)
    hidden: bool = False

    @property
    def visible(self) -> bool:
        """Whether it is drawn, where it has a pose."""
        return not self.hidden

    @visible.setter
    def visible(self, shown: bool) -> None:
        self.hidden = not shown
        self.pose(self.posed)

    def put_on(self, made: Sequence[Shape]) -> None:
        """Replace its meshes."""
        scene = self.server.scene
        old = self.meshes
        self.meshes = []
        for shape in made:
            path = f"{self.path}/{shape.body}"
            if shape.body not in self.bodies:
                self.bodies[shape.body] = scene.add_frame(path, show_axes=False)
            shape = larger(shape, self.by) if self.by else shape
            mesh = scene.add_mesh_simple(
                f"{path}/{next(NUMBERS)}", shape.vertices.astype(np.float32),
                shape.faces, color=self.colour or _rgb(shape), opacity=self.opacity,
            )  # fmt: skip
            self.meshes.append((mesh, shape))
        self.pose(self.posed)
        for mesh, _ in old:  # after the new ones: no moment without an arm
            mesh.remove()

    def pose(self, poses: Mapping[str, Array | None]) -> None:
        """Move its bodies, {body: T_world_body (4, 4)}; no pose hides one."""
        self.posed = poses
        for name, body in self.bodies.items():
            T = None if self.hidden else poses.get(name)
            body.visible = T is not None
            if T is not None:
                place(body, T)

    def poses(self, data: mujoco.MjData, qpos: ArrayLike) -> dict[str, Array]:
        """Return where its bodies are at qpos, {body: T_world_body (4, 4)}.

        The data are the model's; a shorter qpos, (n,), is that of the first joints.
        """
        data.qpos[: len(np.asarray(qpos))] = qpos
        mujoco.mj_kinematics(data.model, data)
        found = {name: data.body(name) for name in self.bodies}
        return {
            name: se3.make_T(body.xmat.reshape(3, 3), body.xpos)
            for name, body in found.items()
        }

    def look(self, opacity: float | None = None, shade: Rgb = AS_IS) -> None:
        """Make it see-through, or solid, and darker: the shade multiplies (r, g, b)."""
        for mesh, shape in self.meshes:
            mesh.color = _rgb(shape, shade)
            mesh.opacity = opacity


def _rgb(shape: Shape, shade: Rgb = AS_IS) -> tuple[int, int, int]:
    r, g, b = (int(255 * c * s) for c, s in zip(shape.rgba[:3], shade, strict=True))
    return r, g, b
