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
_studio: processes.Child | None = None


def draw(scene: Scene) -> Array:
    """Return the picture of a scene, (height, width, 3), bytes.

    The process that draws is started at the first picture and kept for the next.

    Raises:
        Robo47Error: nothing draws here, or the robot cannot be loaded; where the
            process ended instead of answering, its last words.
    """
    with _lock:
        for forget in (False, True):
            studio = _open(forget)
            try:
                studio.send(pickle.dumps(scene))
                reply = pickle.load(studio.process.stdout)
            except (EOFError, OSError, pickle.UnpicklingError):
                words = studio.last_words()
                close()  # perhaps the remembered backend is gone: look once more
                continue
            except KeyboardInterrupt:  # the late answer would pass for the next picture
                close()
                raise
            if isinstance(reply, Robo47Error):
                raise reply
            return reply
        raise Robo47Error(f"cannot draw: {words}")


def close() -> None:
    """End the process that draws, if there is one."""
    global _studio
    if _studio is not None:
        _studio.close()
        _studio = None


def _open(forget: bool) -> processes.Child:
    global _studio
    if _studio is None:
        environment = backends.rendering_environment(forget=forget)  # it draws there
        _studio = processes.Child("labkit.figures.studio", env=environment)
    return _studio


atexit.register(close)
