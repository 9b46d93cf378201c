"""The other end of `labkit.figures.studio`: starts it, asks it, ends it."""

import atexit
import contextlib
import pickle
import subprocess
import sys
import tempfile
import threading

from labkit.figures import backends
from labkit.figures.scene import Scene
from robo47.checks import Array
from robo47.errors import Robo47Error

_lock = threading.Lock()  # one picture at a time, whichever thread asks
_studio: "Studio | None" = None


class StudioEndedError(Robo47Error):
    """The process that draws ended instead of answering."""


class Studio:
    """A running process that draws."""

    def __init__(self, environment: dict[str, str]) -> None:
        """Start the process that draws.

        Args:
            environment: with a backend that draws, from `rendering_environment`.
        """
        self.complaints = tempfile.TemporaryFile()  # noqa: SIM115 (closed by close)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "labkit.figures.studio"],
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self.complaints,
        )

    def draw(self, scene: Scene) -> Array:
        """Return the picture of a scene, (height, width, 3), bytes.

        Args:
            scene: what to draw.

        Raises:
            StudioEndedError: the process is gone; the line is the last that it said.
            Robo47Error: the robot cannot be loaded.
        """
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        try:
            pickle.dump(scene, self.process.stdin)
            self.process.stdin.flush()
            reply = pickle.load(self.process.stdout)
        except (EOFError, OSError, pickle.UnpicklingError):
            raise StudioEndedError(f"cannot draw: {self._last_words()}") from None
        if isinstance(reply, Robo47Error):
            raise reply
        return reply

    def close(self) -> None:
        """End it: it stops where its input does."""
        for pipe in (self.process.stdin, self.process.stdout):
            with contextlib.suppress(OSError):  # it may have ended already
                pipe.close()  # type: ignore[union-attr]
        try:
            self.process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.complaints.close()

    def _last_words(self) -> str:
        self.process.wait(timeout=5)
        self.complaints.seek(0)
        lines = self.complaints.read().decode(errors="replace").strip().split("\n")
        return lines[-1] or f"exit code {self.process.returncode}"


def draw(scene: Scene) -> Array:
    """Return the picture of a scene, (height, width, 3), bytes.

    The process that draws is started at the first picture and kept for the next.

    Args:
        scene: what to draw.

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
        _studio = Studio(backends.rendering_environment(forget=forget))
    return _studio


atexit.register(close)
