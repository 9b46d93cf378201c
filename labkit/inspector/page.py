"""The page as a tab sees it: it makes widgets and drawings, which go with the tab."""

from collections.abc import Callable, Collection, Sequence
from typing import Any

import mujoco
from numpy.typing import ArrayLike

from labkit.base.exchange import Question, Reply
from labkit.inspector.animate import Animation, Step
from labkit.inspector.draw import Sketch
from labkit.inspector.widgets import Host, Widgets
from robo47.checks import Array


class Page(Widgets):
    """One opened tab's view of the page."""

    def __init__(self, host: Host, sketch: Sketch, title: str) -> None:
        """Begin a tab without widgets, drawings or animations.

        Args:
            host: the page as a whole.
            sketch: what to draw with.
            title: of the tab.
        """
        super().__init__(host, title)
        self.draw, self.scene, self.arm = sketch, host.server.scene, host.arm
        self.model: mujoco.MjModel = host.arm.model
        self.animations: list[Animation] = []

    @property
    def q(self) -> Array:
        """The configuration that was asked for last, (nq,), a copy.

        The numbers in `arm` and what `pose` returns follow a moment later, before
        `on_move` is called.
        """
        return self.host.q.copy()

    def pose(self, name: str) -> Array:
        """Return MuJoCo's T_world_NAME, (4, 4); "ee" is the end effector."""
        return self.arm.pose(name)

    def move(self, q: ArrayLike) -> None:
        """Move the arm, in every browser.

        Args:
            q: radians and metres, (nq,).
        """
        self.host.move(q)

    def undo(self) -> None:
        """Take the last move back; several times, one by one."""
        self.host.undo()

    def light(
        self, chosen: str | None = None, shown: Collection[str] | None = None
    ) -> None:
        """Choose which frames are drawn.

        Args:
            chosen: short name of the one that stands out; None for no one.
            shown: short names of those drawn at all; None for every one.
        """
        self.host.light(chosen, shown)

    def trace(self, origins: Array) -> None:
        """Draw the way from the world through points, (n, 3)."""
        self.host.trace(origins)

    def ask(
        self, function: str, args: Sequence[Any], done: Callable[[Reply], None]
    ) -> None:
        """Call a function of the student's file, in the sandbox.

        Args:
            function: its name.
            args: arrays, floats, `page.model`, `Path(...)`.
            done: is given the reply a few milliseconds later; `reply.kind` is "" where
                the function returned `reply.value`. Without a file: "missing".
        """
        self.host.ask(Question("view", function, tuple(args)), done)

    def animate(self, step: Step, hz: float = 30.0) -> Animation:
        """Prepare a loop in real time; `start()` and `stop()` it from a button.

        Args:
            step: is given the seconds since the start; returning False ends the loop.
            hz: calls a second.
        """

        def changed() -> None:
            if made.error is not None:
                self.say(f"stopped: {type(made.error).__name__}: {made.error}", "bad")
            self.host.refresh()

        made = Animation(step, hz, changed)
        self.animations.append(made)
        return made

    def close(self) -> None:
        """Stop the loops, forget the controls, remove the drawings."""
        for animation in self.animations:
            animation.stop()
        self.host.controls.forget(self.names)
        self.draw.clear()
