"""The page as a whole: one arm, its scene, the open tab, the student's code; in step.

Everything here runs on the server's event loop, one thing after the other, whichever
browser it comes from, so no lock is needed. What comes in only notes what is wanted;
`update` does the work, at most once in a sixtieth of a second.
"""

import contextlib
from collections.abc import Callable, Collection
from typing import NamedTuple, TypeVar

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.base.exchange import Question, Reply
from labkit.inspector import address, panel
from labkit.inspector.arm import END, Arm
from labkit.inspector.chain import Chain
from labkit.inspector.checks import Standing
from labkit.inspector.controls import Controls
from labkit.inspector.draw import Sketch
from labkit.inspector.ghost import Difference, Seen, compare
from labkit.inspector.history import History
from labkit.inspector.hover import Hover, Pointer, pointer
from labkit.inspector.joints import Joints
from labkit.inspector.page import Page
from labkit.inspector.scene import ArmScene
from labkit.inspector.shapes import Shape
from labkit.inspector.student import Student
from labkit.inspector.tab import DayTabs, Opened
from labkit.inspector.tasks import Tasks
from robo47.checks import Array, array

T = TypeVar("T")
PERIOD = 1 / 60


class Meshes(NamedTuple):
    """An arm's meshes; `ghosts` has other arms drawn with them, too."""

    shapes: list[Shape]
    ghosts: bool


class Inspector:
    """The page: what every connected browser sees."""

    def __init__(
        self, server: viser.ViserServer, arm: Arm, about: str, day: DayTabs
    ) -> None:
        """Draw everything but the meshes; call it on the server's event loop.

        Args:
            server: already listening.
            arm: the one that every browser moves.
            about: the line that says which robot this is.
            day: what the day brings.
        """
        self.server, self.arm, self.day = server, arm, day
        self.controls, self.standing = Controls(), Standing("")
        self.history, self.scheduled = History(arm.q), False
        self.student: Student | None = None
        self.seen: Seen | None = None
        self.apart: Difference | None = None
        self.pointer: Pointer | None = None
        self.panel = panel.Panel(server.gui, arm, about, self.controls)
        self.scene, self.hover = ArmScene(server, arm), Hover(server, arm)
        self.opened = Opened([Joints, Chain, *day.tabs, Tasks])
        for name, listener in {
            "frame": self.choose_frame, "solid": self.make_solid, "tab": self.open_tab,
            "address": self.go_to, "hover": self.point,
        }.items():  # fmt: skip
            self.controls.listen(name, listener)
        self.controls.values |= {"frame": END, "solid": "false"}
        self.open_tab(Joints.title)
        self.update()

    @property
    def q(self) -> Array:
        """The configuration that was asked for last; `arm` follows in `update`."""
        return self.history.q

    def move(self, q: ArrayLike) -> None:
        """Move the arm, in every browser.

        Args:
            q: configuration, (nq,).

        Raises:
            ValueError: wrong shape, or a number that is not finite.
        """
        self.history.go(array(q, "q", (self.arm.model.nq,)))
        self.schedule()

    def undo(self) -> None:
        """Take the last move back."""
        self.history.back()
        self.schedule()

    def schedule(self) -> None:
        """Have `update` run soon, once, however often this is called meanwhile."""
        if not self.scheduled:
            self.scheduled = True
            self.server.get_event_loop().call_later(PERIOD, self.update)

    def update(self) -> None:
        """Bring everything that is shown to what is wanted."""
        self.scheduled = False
        moved = (self.q != self.arm.q).any() or self.opened.tab is None
        if moved:
            self.arm.move(self.q)
        with self.server.atomic():
            if self.student is not None and (self.seen is None or moved):
                self.student.want(self.arm.q)
            self.scene.update()
            if moved:
                self.opened.tell(self.arm.q)
            self.hover.show(self.pointer)
            self.show()

    def dress(self, model: mujoco.MjModel, meshes: Meshes) -> None:
        """Put meshes on the arm.

        Args:
            model: the arm's, with its shapes.
            meshes: what to draw.
        """
        ghost = meshes.ghosts
        with self.server.atomic():
            self.scene.dress(meshes.shapes, ghost)
            self.hover.watch(model)
            if ghost and self.opened.page is not None:
                # Not opened anew: somebody may have a slider of it in hand.
                self.opened.page.draw.dress(meshes.shapes)
                self.opened.tell(self.arm.q)

    def show(self) -> None:
        """Show the numbers, and what every control shows."""
        frame = self.controls.values["frame"]
        wide = self.opened.kind.wide
        self.panel.show(frame, self.seen, self.apart, self.standing, wide)
        where = address.write(self.q, frame, self.opened.kind.title)
        self.panel.state.content = self.controls.state(where)

    refresh = schedule

    def on_loop(self, call: Callable[[T], None]) -> Callable[[T], None]:
        """Return a function for other threads that has the event loop call this one."""
        loop = self.server.get_event_loop()

        def soon(value: T) -> None:
            with contextlib.suppress(RuntimeError):  # the page is closed already
                loop.call_soon_threadsafe(call, value)

        return soon

    # What a tab asks for

    def light(self, chosen: str | None, shown: Collection[str] | None) -> None:
        """Choose the frames that are drawn, and the one that stands out."""
        self.scene.light(chosen, shown)

    def trace(self, origins: Array) -> None:
        """Draw the way from the world through points, (n, 3)."""
        self.scene.trace(origins)

    def ask(self, question: Question, done: Callable[[Reply], None]) -> None:
        """Ask the student's file; the answer comes back on the event loop."""
        loop, page = self.server.get_event_loop(), self.opened.page

        def still_open(reply: Reply) -> None:
            if self.opened.page is page:  # the tab may have been left meanwhile
                done(reply)
                self.schedule()

        if self.student is None:
            loop.call_soon(still_open, Reply(kind="missing", error="no file yet"))
        else:
            self.student.request(question, self.on_loop(still_open))

    # What the browsers and the student's file say

    def receive(self, name: str, value: str) -> int:
        """Hear a browser's word; a state that knows of it follows, whatever it was.

        Args:
            name: of a control.
            value: what it says; believed by nobody.

        Returns:
            The number of this word.
        """
        number = self.controls.receive(name, value)
        self.schedule()
        return number

    def choose_frame(self, name: str) -> None:
        """Show another frame's matrices."""
        if name in self.arm.names:
            self.controls.values["frame"] = name
            if self.opened.kind is Joints:
                self.scene.light(name, None)
            self.schedule()

    def make_solid(self, value: str) -> None:
        """Make the arm solid ("true") or see-through."""
        self.controls.values["solid"] = "true" if value == "true" else "false"
        self.scene.look(opaque=value == "true")
        self.schedule()

    def point(self, text: str) -> None:
        """Note where the pointer is."""
        self.pointer = pointer(text)
        self.schedule()

    def go_to(self, query: str) -> None:
        """Go where an address says, as far as that is somewhere."""
        q, frame, title = address.read(query, self.arm.model.nq)
        self.open_tab(title)
        self.choose_frame(frame)
        if q is not None:
            self.move(q)

    def open_tab(self, title: str) -> None:
        """Leave the open tab with all that it made, and open another one."""
        is_open = self.opened.page and title == self.opened.kind.title
        if title in self.opened.kinds and not is_open:
            with self.server.atomic():
                self.opened.leave()
                self.panel.open(list(self.opened.kinds), title)
                self.scene.light(self.controls.values["frame"], None)
                self.scene.trace(np.zeros((0, 3)))
                page = Page(self, Sketch(self.server, self.scene.coarse), title)
                self.opened.enter(title, page)
            self.schedule()

    def hear(self, seen: Seen | None) -> None:
        """Show what the student's function said; None where there is no file."""
        self.seen, self.apart = seen, None
        if seen is not None and self.day.ghost is not None:
            truth = self.arm.poses_at(seen.q)
            self.apart = compare(self.day.ghost, seen, truth)
            end = self.day.ghost.frames[-1]
            with self.server.atomic():
                self.scene.show_ghost(self.apart.drawn, end)
                self.scene.look(agrees=self.apart.good)
                self.show()
        else:
            self.scene.show_ghost({}, END)
            self.scene.look(agrees=False)
            self.schedule()

    def judge(self, standing: Standing) -> None:
        """Show how the tasks stand."""
        self.standing = standing
        if isinstance(self.opened.tab, Tasks):
            self.opened.tab.show(standing)
        self.schedule()
