"""A scene recorded as one HTML file: orbit it, move through its time, no server.

    film = Recording(model)
    for qpos in ...:
        film.pose(qpos)
        film.wait(1 / 30)
    path.write_text(film.page())

The file holds viser's player and what was drawn; it opens from disk. Metres, seconds.
"""

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.inspector.draw import Sketch
from labkit.inspector.guard import LocalServer
from labkit.inspector.meshes import Skin
from labkit.inspector.scene import set_stage
from labkit.inspector.shapes import GRID, shapes, thinned
from robo47 import se3
from robo47.checks import Array

FRAMES = 30  # a second
OVER = (0.0, 0.0, 0.98)  # m: where words stand
# Out of sight. What is hidden instead would stay so when the film begins again.
AWAY = se3.make_T(np.eye(3), [0.0, 0.0, -50.0])
CAMERA, LOOK_AT = (1.35, -1.05, 0.87), (0.2, 0.0, 0.44)
FOV = 0.8  # vertical, radians: the arm fills half of the height


class Recording:
    """What a robot does, with all that is drawn around it."""

    def __init__(self, model: mujoco.MjModel, back: float = 1.0) -> None:
        """Begin with a model at zero, with the looks that are to be seen.

        The camera stands back by 1, which suits an arm at ready, or more.
        """
        self.model = model
        self.data = mujoco.MjData(model)
        self.server = LocalServer(0)
        set_stage(self.server)
        camera = self.server.initial_camera
        position = LOOK_AT + back * np.subtract(CAMERA, LOOK_AT)
        (camera.position, camera.look_at), camera.fov = (position, LOOK_AT), FOV
        seen = [thinned(shape, GRID) for shape in shapes(model)]
        self.skin = Skin(self.server, "/arm")
        self.skin.put_on(seen)
        self.draw = Sketch(self.server, seen)
        self._recorded: viser.infra.StateSerializer | None = None
        self._label: viser.LabelHandle | None = None
        self.seconds = 0.0

    def say(self, text: str, at: tuple[float, float, float] = OVER) -> None:
        """Write over the arm, from now on; call it when all is drawn."""
        if self._label is None:
            self._label = self.draw.label("", at)
            self.wait(0.0)  # the next round sets again all that is set from here on
        self._label.text = text

    def pose(self, qpos: ArrayLike) -> None:
        """Move the model to a configuration; see `poses`."""
        self.skin.pose(self.poses(qpos))

    def poses(self, qpos: ArrayLike) -> dict[str, Array]:
        """Return {body: T_world_body (4, 4)} of what is seen, see `Skin.poses`."""
        return self.skin.poses(self.data, qpos)

    def wait(self, seconds: float = 1 / FRAMES) -> None:
        """Let time go by; what was drawn so far is there from the beginning."""
        if self._recorded is None:
            self._recorded = self.server.get_scene_serializer()
        self._recorded.insert_sleep(seconds)
        self.seconds += seconds

    def page(self, title: str, nonce: str = "") -> str:
        """Return the HTML file with a window's title, and end the recording.

        The nonce is its scripts', where a page's policy lets no other run.
        """
        self.wait(0.0)
        assert self._recorded is not None
        text = self._recorded.as_html()
        self.server.stop()
        text = text.replace("<title>Viser</title>", f"<title>{title}</title>", 1)
        if nonce:  # viser's own script adds one more
            text = text.replace("<script", f'<script nonce="{nonce}"')
            text = text.replace('e.type="module"', f'e.nonce="{nonce}";e.type="module"')
        return text
