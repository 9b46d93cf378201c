"""A scene of MuJoCo's in the picture of a tab: robot, table, cube, where qpos has them.

What the bare model has is there at once; the meshes follow when they are loaded.
"""

from collections.abc import Callable
from functools import cache, partial

import mujoco
from numpy.typing import ArrayLike

from labkit.inspector.meshes import Skin
from labkit.inspector.page import Page
from labkit.inspector.shapes import COLLISION_GROUPS, VISIBLE_GROUPS, Shape, shapes
from robo47 import se3

Load = Callable[[], mujoco.MjModel]
WHITE = (0.92, 0.92, 0.92, 1.0)  # the links; collision shapes have no colour


class Robot:
    """The bodies of a model."""

    def __init__(self, page: Page, model: mujoco.MjModel, dressed: Load) -> None:
        """Draw it instead of the page's arm.

        Args:
            page: of the tab.
            model: what is simulated, without its looks.
            dressed: loads the same with its looks; a function of a module, asked once.
        """
        self.page, self.model, self.data = page, model, mujoco.MjData(model)
        self.skin = Skin(page.host.server, page.draw.path())
        self.skin.put_on(shapes(model))
        page.hide_arm()
        page.jobs_apart().want(partial(_looks, dressed, page.host.simple), self._dress)

    def _dress(self, made: list[Shape]) -> None:
        with self.page.host.server.atomic():
            self.skin.put_on(made)

    def show(self, qpos: ArrayLike) -> None:
        """Put everything where a configuration has it, (nq,)."""
        self.data.qpos[:] = qpos
        mujoco.mj_kinematics(self.model, self.data)
        bodies = {name: self.data.body(name) for name in self.skin.bodies}
        self.skin.pose({
            name: se3.make_T(body.xmat.reshape(3, 3), body.xpos)
            for name, body in bodies.items()
        })  # fmt: skip


@cache
def _looks(dressed: Load, simple: bool) -> list[Shape]:
    model = dressed()
    if not simple:
        return shapes(model)
    coarse = [s._replace(rgba=WHITE) for s in shapes(model, COLLISION_GROUPS)]
    links = {shape.body for shape in coarse}
    return coarse + [s for s in shapes(model, VISIBLE_GROUPS) if s.body not in links]
