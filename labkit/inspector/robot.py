"""A tab's own robot in the scene, instead of the page's arm."""

from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from labkit.inspector.meshes import Skin
from labkit.inspector.shapes import Shape, shapes, simple_links
from robo47.checks import Array

Load = Callable[[], mujoco.MjModel]


class Robot:
    """A scene of MuJoCo's in a tab: robot, table, cube, where qpos has them.

    What the bare model has is there at once; the meshes follow when they are loaded.
    """

    def __init__(self, page: Any, model: mujoco.MjModel, dressed: Load) -> None:
        """Draw what is simulated instead of the page's arm.

        `dressed` loads the same with its looks; a function of a module, asked once. The
        page is a `Page`, whose method `robot` makes this.
        """
        self.page = page
        self.model = model
        self.data = mujoco.MjData(model)
        self.skin = Skin(page.host.server, page.draw.path())
        self.skin.put_on(shapes(model))
        self.again: Callable[[], None] = partial(self.show, self.data.qpos)
        page.hide_arm()
        page.jobs_apart().want(partial(_looks, dressed, page.host.simple), self._dress)

    def _dress(self, made: list[Shape]) -> None:
        with self.page.host.server.atomic():
            self.skin.put_on(made)
            self.again()

    def show(self, qpos: ArrayLike) -> None:
        """Put everything where a configuration has it, (nq,)."""
        self.again = partial(self.show, np.array(qpos))
        self.skin.pose(self.skin.poses(self.data, qpos))

    def pose(self, poses: Mapping[str, Array]) -> None:
        """Draw some of its bodies alone, {body: T_world_body (4, 4)}."""
        self.again = partial(self.pose, poses)
        self.skin.pose(poses)


@cache
def _looks(dressed: Load, simple: bool) -> list[Shape]:
    model = dressed()
    if not simple:
        return shapes(model)
    coarse = simple_links(model)
    links = {shape.body for shape in coarse}
    return coarse + [shape for shape in shapes(model) if shape.body not in links]
