"""The page as a tab sees it: it makes widgets and drawings, which go with the tab."""

from collections.abc import Callable, Collection, Mapping
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from labkit.inspector import words
from labkit.inspector.animate import Animation, Jobs, Step
from labkit.inspector.draw import Colour, Sketch, rgb
from labkit.inspector.own import NoAnswerError, Own
from labkit.inspector.widgets import Widgets
from robo47 import kinematics
from robo47.checks import Array

SLOW = 1.5  # times slower than real time, which is said

if TYPE_CHECKING:
    from labkit.inspector.app import Inspector


class Page(Widgets):
    """One opened tab's view of the page."""

    def __init__(self, host: "Inspector", sketch: Sketch) -> None:
        """Begin a tab without widgets, drawings or animations.

        Args:
            host: the page as a whole.
            sketch: what to draw with.
        """
        super().__init__(host)
        self.draw, self.scene, self.arm = sketch, host.server.scene, host.arm
        self.model: mujoco.MjModel = host.arm.model
        self.running: list[Animation | Jobs] = []  # what ends with the tab
        self.jobs = self.jobs_apart()
        self._own: Own | None = None

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

    def links(self, q: ArrayLike) -> dict[str, Array]:
        """Return where every link is at a configuration, for a ghost's `pose`.

        Args:
            q: of the seven joints, (7,); fingers stay as they are.
        """
        whole = self.q
        whole[: len(np.asarray(q))] = q
        poses = kinematics.fk_all(self.model, whole)
        return {
            name.removeprefix("body:"): T
            for name, T in poses.items()
            if name.startswith("body:link")
        }

    def move(self, q: ArrayLike) -> None:
        """Move the arm, in every browser.

        Args:
            q: radians and metres, (nq,).
        """
        self.host.move(q)

    def light(
        self, chosen: str | None = None, shown: Collection[str] | None = None
    ) -> None:
        """Choose which frames are drawn.

        Args:
            chosen: short name of the one that stands out; None for no one.
            shown: short names of those drawn at all; None for every one.
        """
        self.host.scene.light(chosen, shown)

    def hide_arm(self) -> None:
        """Draw no arm but the tab's own, until the tab is left."""
        self.host.scene.hide()
        self.host.panel.solid.visible = False

    def legend(self, colours: Mapping[str, Colour]) -> None:
        """Say at the end of the panel what the colours in the scene mean.

        Args:
            colours: {what is drawn: its colour, see `draw.COLOURS`}.
        """
        self.host.panel.explain({what: rgb(colour) for what, colour in colours.items()})

    def own(self, library: Any, free: Collection[str] = ()) -> Own:
        """Return the student's functions; a line of the panel says how they compare.

        They wait for the sandbox: call them in `job`, or in the `work` of `animate`.

        Args:
            library: the module with the functions of the same names, or {name: it}.
            free: names of functions that have more than one right answer.
        """
        self._whose = self.html()
        self._own = Own(lambda: self.host.student, library, free)
        return self._own

    def jobs_apart(self) -> Jobs:
        """Return a queue of its own, for what shall not wait behind `job`."""
        made = Jobs(self._ended)
        self.running.append(made)
        return made

    def job(self, work: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Do something that waits; of several that wait the newest is done.

        Args:
            work: may call `own`.
            done: is given what it returned.
        """
        self.jobs.want(work, done)

    def animate(
        self, step: Step, hz: float = 30.0, work: Callable[[float], Any] | None = None
    ) -> Animation:
        """Prepare a loop in real time; `start()` and `stop()` it from a button.

        Args:
            step: is given the seconds since the start; returning False ends the loop.
            hz: calls a second.
            work: called before each step, on another thread: may call `own`.
        """

        def told(seconds: float) -> bool | None:
            more = step(seconds)
            self._ended(None)
            if made.slow > SLOW and seconds > 1.0:
                says = f"slow motion: 1 s of it takes {made.slow:.1f} s here"
                self.say(f"{says}; your functions are asked as fast as they answer")
            return more

        made = Animation(told if work else step, hz, self._ended, work)
        self.running.append(made)
        return made

    def _ended(self, error: Exception | None) -> None:
        """Say what stopped a job or a loop, and how the student's functions compare."""
        if isinstance(error, NoAnswerError):
            self.show_whose(str(error), "bad")
            if self.host.opened.tab is not None:
                self.host.opened.guarded(self.host.opened.tab.lost)
        elif error is not None:
            self.say(f"stopped: {type(error).__name__}: {error}", "bad")
        elif self._own is not None:
            self.show_whose(*self._own.says())
        self.host.schedule()

    def show_whose(self, text: str, kind: str) -> None:
        """Say whose functions are at work, and how they compare."""
        self._whose.content = words.judged(text, "whose", kind)

    def close(self) -> None:
        """Stop the loops, remove the drawings."""
        for each in self.running:
            each.stop()
        self._own = None
        self.draw.clear()
