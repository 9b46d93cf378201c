"""The page as a whole: one arm, its scene, the open tab, the student's code; in step.

Everything here runs on the server's event loop, one thing after the other, whichever
browser it comes from, so no lock is needed. What comes in only notes what is wanted;
`update` does the work, at most once in a sixtieth of a second.
"""

import contextlib
import time
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.inspector import typed, words
from labkit.inspector.arm import END, Arm
from labkit.inspector.checks import Standing
from labkit.inspector.common_tabs import Chain, Joints, Tasks
from labkit.inspector.draw import Sketch
from labkit.inspector.ghost import Difference, Seen, compare
from labkit.inspector.page import Page
from labkit.inspector.panel import Panel
from labkit.inspector.scene import GHOST_COLOUR, ArmScene, Pointed
from labkit.inspector.shapes import Shape
from labkit.inspector.student import Student
from labkit.inspector.tab import DayTabs, Tab
from robo47.checks import Array, array

PERIOD = 1 / 60
DRAG, STEPS = 0.7, 100  # seconds between moves that are one; how many can be undone
COLOURS = {
    "MuJoCo": (122, 125, 135), "YOURS agrees": (87, 158, 133),
    "YOURS, where not": GHOST_COLOUR,
}  # fmt: skip
Widget = TypeVar("Widget", bound=Any)


class Inspector:
    """The page: what every connected browser sees."""

    def __init__(
        self,
        server: viser.ViserServer,
        arm: Arm,
        about: str,
        day: DayTabs,
        simple: bool = False,
    ) -> None:
        """Draw everything but the meshes; call it on the server's event loop.

        What `about` says of the robot stands below all, what the day brings in between;
        simple are the meshes of a tab's own robots, too.
        """
        self.server, self.arm, self.day, self.simple = server, arm, day, simple
        self.standing, self.heard_words = Standing(""), 0
        self.q, self.moved = arm.q.copy(), 0.0  # what is wanted; when that was said
        self.past: list[Array] = []
        self.scheduled = False
        self.student: Student | None = None
        self.seen: Seen | None = None
        self.apart: Difference | None = None
        self.panel = Panel(server.gui, arm, about)
        self.scene, self.pointed = ArmScene(server, arm), Pointed(server, arm)
        tabs: list[type[Tab]] = [Joints, Chain, *day.tabs, Tasks]
        self.kinds = {kind.title: kind for kind in tabs}
        self.kind: type[Tab] = Joints  # of the open tab
        self.tab: Tab | None = None  # the open one; None where it failed to open
        self.page: Page | None = None  # what it made its widgets with
        self.open_tab(Joints.title)
        self.listen(self.panel.frame, lambda _: self.light_frame())
        self.listen(self.panel.solid, lambda solid: self.scene.look(opaque=solid))
        self.update()

    def move(self, q: ArrayLike) -> None:
        """Move the arm to q, (nq,), in every browser; `arm` follows in `update`.

        Raises:
            ValueError: wrong shape, or a number that is not finite.
        """
        before, self.q = self.q, array(q, "q", (self.arm.model.nq,)).copy()
        now = time.monotonic()
        if now - self.moved > DRAG:
            self.past = [*self.past[-STEPS:], before]
        self.moved = now
        self.schedule()

    def undo(self) -> None:
        """Take the last move back."""
        if self.past:
            self.q, self.moved = self.past.pop(), 0.0
        self.schedule()

    def schedule(self) -> None:
        """Have `update` run soon, once, however often this is called meanwhile."""
        if not self.scheduled:
            self.scheduled = True
            self.server.get_event_loop().call_later(PERIOD, self.update)

    def update(self) -> None:
        """Bring everything that is shown to what is wanted."""
        self.scheduled = False
        moved = not np.array_equal(self.q, self.arm.q)
        if moved:
            self.arm.move(self.q)
        with self.server.atomic():
            self.scene.update()
            if moved:
                self.ask()
                self.tell(self.arm.q)
                self.pointed.show()
            self.show()

    def ask(self) -> None:
        """Ask the student's file where it puts the arm."""
        if self.student is not None:
            self.student.want(self.arm.q)

    def dress(self, model: mujoco.MjModel, meshes: list[Shape], ghosts: bool) -> None:
        """Put the meshes of the arm's model on it, and on the ghosts, too."""
        with self.server.atomic():
            self.scene.dress(meshes, ghosts)
            self.pointed.watch(model)
            if ghosts and self.page is not None:
                # Not opened anew: somebody may have a slider of it in hand.
                self.page.draw.dress(meshes)
                self.tell(self.arm.q)

    def show(self) -> None:
        """Show the numbers, and where the page is."""
        self.panel.show(self.seen, self.apart, self.standing)
        self.panel.state.content = words.state(self.address, self.heard_words)

    @property
    def address(self) -> str:
        """The query that leads here: the configuration, the frame, the tab."""
        return typed.write_address(self.q, self.panel.frame.value, self.kind.title)

    def on_loop(self, call: Callable[..., None]) -> Callable[..., None]:
        """Return a function for other threads that has the event loop call this one."""
        loop = self.server.get_event_loop()

        def soon(*values: Any) -> None:
            with contextlib.suppress(RuntimeError):  # the page is closed already
                loop.call_soon_threadsafe(call, *values)

        return soon

    # What the browsers and the student's file say

    def receive(self, query: str) -> int:
        """Go where "?q=...&frame=...&tab=..." says, as far as that is somewhere.

        Returns:
            The number of this word: a state that knows of it follows.
        """
        self.heard_words += 1
        q, frame, title = typed.read_address(query, self.arm.model.nq)
        self.open_tab(title)
        if frame in self.arm.names:
            self.panel.frame.value = frame  # type: ignore[misc]
            self.light_frame()
        if q is not None:
            self.move(q)
        self.schedule()
        return self.heard_words

    def listen(self, widget: Widget, then: Callable[[Any], None]) -> Widget:
        """Have a function called when a person changes a widget; return the widget."""
        group = isinstance(widget, viser.GuiButtonGroupHandle)

        @(widget.on_click if group else widget.on_update)
        async def _(event: viser.GuiEvent) -> None:
            if event.client is not None:  # else it was the page itself
                self.guarded(partial(then, widget.value))
                self.schedule()

        return widget

    def light_frame(self) -> None:
        """Have the frame that is chosen stand out."""
        if self.kind is Joints:
            self.scene.light(self.panel.frame.value, None)

    def open_tab(self, title: str) -> None:
        """Leave the open tab with all that it made, and open another one."""
        kind = self.kinds.get(title)
        if kind is None or (self.page and kind is self.kind):
            return
        with self.server.atomic():
            self.leave()
            self.panel.open(list(self.kinds), title, kind.wide)
            self.panel.explain(COLOURS if self.day.ghost else {})
            self.scene.hide(False)
            self.scene.light(self.panel.frame.value, None)
            self.scene.trace(())
            self.scene.look_from(kind.camera)
            self.kind = kind
            self.page = Page(self, Sketch(self.server, self.scene.coarse))
            self.guarded(self.enter)
            self.tell(self.q)
            self.page.end()
        self.schedule()

    def enter(self) -> None:
        """Build the tab that was chosen."""
        assert self.page is not None
        self.tab = self.kind(self.page)

    def leave(self) -> None:
        """Close the open tab, and remove all that it made."""
        if self.tab is not None:
            self.guarded(self.tab.close)
        if self.page is not None:
            self.page.close()
        self.tab = self.page = None

    def tell(self, q: Array) -> None:
        """Tell the open tab where the arm is."""
        if self.tab is not None:
            self.guarded(partial(self.tab.on_move, q.copy()))

    def guarded(self, call: Callable[[], None]) -> None:
        """Call a tab's code; where it fails the page says so and goes on."""
        try:
            call()
        except Exception as error:
            if self.page is None:  # nobody to tell: the tab is gone
                return
            what = f"{type(error).__name__}: {error}"
            self.page.say(f"the tab {self.kind.title} stopped with {what}", "bad")

    def hear(self, seen: Seen | None) -> None:
        """Show what the student's function said; None where there is no file."""
        self.seen = seen
        ghost, apart = self.day.ghost, None
        if seen is not None and ghost is not None:
            apart = compare(ghost, seen, self.arm.poses_at(seen.q))
        self.apart = apart
        with self.server.atomic():
            self.scene.show_ghost(
                apart.drawn if apart else {}, ghost.frames[-1] if ghost else END
            )
            self.scene.look(agrees=apart is not None and apart.good)
            self.show()

    def reload(self) -> None:
        """Ask the student's file again whatever the open tab asks."""
        self.tell(self.arm.q)
        self.schedule()

    def judge(self, standing: Standing) -> None:
        """Show how the tasks stand."""
        self.standing = standing
        if isinstance(self.tab, Tasks):
            self.tab.show(standing)
        self.schedule()
