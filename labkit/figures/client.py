"""The other end of `labkit.figures.studio`: starts it, asks it, ends it."""

import atexit
import pickle
import threading

from labkit.base import processes
from labkit.figures import backends
from labkit.figures.scene import Scene
from robo47.checks import Array
from robo47.errors import Robo47Error

_lock = threading.Lock()  # one picture at a time, whichever thread asks
_studio: "Studio | None" = None


class StudioEndedError(Robo47Error):
    """The process that draws ended instead of answering."""


class Studio(processes.Child):
    """A running process that draws."""

    def draw(self, scene: Scene) -> Array:
        """Return the picture of a scene, (height, width, 3), bytes.

        Raises:
            StudioEndedError: the process is gone; the line is the last that it said.
            Robo47Error: the robot cannot be loaded.
        """
        self.send(pickle.dumps(scene))
        try:
            reply = pickle.load(self.process.stdout)
        except (EOFError, OSError, pickle.UnpicklingError):
            raise StudioEndedError(f"cannot draw: {self.last_words()}") from None
        if isinstance(reply, Robo47Error):
            raise reply
        return reply


def draw(scene: Scene) -> Array:
    """Return the picture of a scene, (height, width, 3), bytes.

    The process that draws is started at the first picture and kept for the next.

    Raises:
        Robo47Error: nothing draws here, or the robot cannot be loaded.
    """
    with _lock:
        try:
            return _open(forget=False).draw(scene)
        except (
            StudioEndedError
        ):  # perhaps the remembered backend is gone: look once more
            close()
            return _open(forget=True).draw(scene)
        except KeyboardInterrupt:  # the late answer would pass for the next picture
            close()
            raise


def close() -> None:
    """End the process that draws, if there is one."""
    global _studio
    if _studio is not None:
        _studio.close()
        _studio = None


def _open(*, forget: bool) -> Studio:
    global _studio
    if _studio is None:
        environment = backends.rendering_environment(forget=forget)  # it draws there
        _studio = Studio("labkit.figures.studio", env=environment)
    return _studio


atexit.register(close)
