"""The page as a whole: one arm, its scene, the open tab, the student's code; in step.

Everything here runs on the server's event loop, one thing after the other, whichever
browser it comes from, so no lock is needed. What comes in only notes what is wanted;
`update` does the work, at most once in a sixtieth of a second.
"""

import asyncio
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.inspector import typed, words
from labkit.inspector.animate import Jobs
from labkit.inspector.arm import END, Arm
from labkit.inspector.common_tabs import Chain, Joints, Tasks
from labkit.inspector.draw import Sketch
from labkit.inspector.ghost import Seen, asked
from labkit.inspector.guard import TITLE
from labkit.inspector.page import Page, Widget
from labkit.inspector.scene import GHOST_COLOUR, ArmScene, Pointed
from labkit.inspector.shapes import Shape
from labkit.inspector.standing import ASKING, Standing
from labkit.inspector.student import Student
from labkit.inspector.tab import DayTabs, Tab
from robo47.checks import Array, array

PERIOD = 1 / 60  # seconds between frames
LOOKS = 0.05  # seconds between looks at the student's file
DRAG = 0.7  # seconds between moves that count as one
STEPS = 100  # how many moves can be undone
LAST = 1e15  # below whatever a tab adds
COLOURS = {"MuJoCo": (236, 239, 243), "YOURS, where it differs": GHOST_COLOUR}


class Inspector:
    """The page: what every connected browser sees."""

    def __init__(
        self,
        server: viser.ViserServer,
        arm: Arm,
        about: str,
        day: DayTabs,
        student: Student,
        simple: bool = False,
    ) -> None:
        """Draw everything but the meshes; call it on the server's event loop.

        What `about` says of the robot stands below all, what the day brings in between;
        simple are the meshes of a tab's own robots, too.
        """
        self.server = server
        self.arm = arm
        self.day = day
        self.simple = simple
        self.standing = ASKING
        self.heard_words = 0
        self.q = arm.q.copy()  # the configuration that is wanted
        self.moved = 0.0  # the time of the last change
        self.past: list[Array] = []
        self.scheduled = False
        self.student = student
        self.version = 0  # the version of the file that is asked
        self.unchecked = False
        self.seen = asked(day.ghost)
        self.asks, self.checks = Jobs(), Jobs()
        self.lay_out(server.gui, about)
        self.scene = ArmScene(server, arm)
        self.pointed = Pointed(server, arm, self.look)
        # The day's own come first, and the first of them is open.
        self.kinds = {kind.title: kind for kind in day.tabs}
        for kind in (Joints, Chain, Tasks):
            self.kinds.setdefault(kind.title, kind)
        self.kind: type[Tab] = Joints  # the class of the open tab
        self.tab: Tab  # the open one; a bare one where it failed to open
        self.page: Page | None = None  # the page that holds the tab's widgets
        self.open_tab(next(iter(self.kinds)))
        self.listen(self.frame, lambda _: self.light_frame())
        self.listen(self.solid, lambda _: self.look())
        self.update()

    def lay_out(self, gui: viser.GuiApi, about: str) -> None:
        """Make what stands above the open tab, and below all."""
        gui.set_panel_label(TITLE)
        self.state, self.yours = gui.add_html(""), gui.add_html("")
        self.tasks, self.row = gui.add_html(""), gui.add_html("")
        self.frame = gui.add_dropdown("Frame", tuple(self.arm.names))
        self.proof, self.limits = gui.add_html(""), gui.add_html("")
        self.legend = gui.add_html("", order=LAST)
        self.solid = gui.add_checkbox("solid arm", True, order=LAST + 1e9)
        gui.add_html(words.line(about, "about", "quiet"), order=LAST + 2e9)
        self.fixed = set(self.widgets())

    def widgets(self) -> dict[str, viser.GuiHtmlHandle]:
        """Return what stands in the panel by its uuid, whoever put it there."""
        gui: Any = self.server.gui
        return gui._container_handle_from_uuid["root"]._children

    def move(self, q: ArrayLike) -> None:
        """Move the arm to q, (nq,), in every browser; `arm` follows in `update`.

        Raises:
            ValueError: wrong shape, or a number that is not finite.
        """
        before = self.q
        self.q = array(q, "q", (self.arm.model.nq,)).copy()
        now = time.monotonic()
        if now - self.moved > DRAG:
            self.past = [*self.past[-STEPS:], before]
        self.moved = now
        self.schedule()

    def undo(self) -> None:
        """Take the last move back."""
        if self.past:
            self.q = self.past.pop()
            self.moved = 0.0
        self.schedule()

    def schedule(self) -> None:
        """Have `update` run soon, once, however often this is called meanwhile."""
        if not self.scheduled:
            self.scheduled = True
            self.server.get_event_loop().call_later(PERIOD, self.update)

    def update(self) -> None:
        """Bring everything that is shown to what is wanted."""
        self.scheduled = False
        if self.student.saved():  # update at once instead of at the next look
            self.forget()
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

    def dress(
        self, model: mujoco.MjModel, meshes: list[Shape], ghosts: Sequence[Shape] = ()
    ) -> None:
        """Put the meshes of the arm's model on it, and those for ghosts on these."""
        with self.server.atomic():
            self.scene.dress(meshes, ghosts)
            self.look()
            self.pointed.watch(model)
            if ghosts and self.page is not None:
                # Not opened anew: somebody may have a slider of it in hand.
                self.page.draw.dress(ghosts)
                self.tell(self.arm.q)

    def show(self) -> None:
        """Show the numbers, and where the page is."""
        seen, task = self.seen, self.standing
        self.yours.content = words.judged(seen.sentence, "yours", seen.kind)
        self.tasks.content = words.card(
            task.title, task.count, task.sentence, task.kind
        )
        whose = self.day.ghost.frames if self.day.ghost else ()
        name = self.frame.value
        proof = words.proof(self.arm, name, seen, name in whose)
        proof = "" if self.kind.wide else proof
        self.proof.content = proof
        self.limits.content = words.limits(self.arm)
        self.state.content = words.state(self.address, self.heard_words)

    def look(self) -> None:
        """Make the arm solid, or see-through: as it was asked, or to show an axis."""
        self.scene.look(self.solid.value and not self.pointed.body)

    def first(self) -> str:
        """Return what to show before viser does, as HTML."""
        some = (self.yours, self.tasks, self.proof, self.limits)
        return "".join(part.content for part in some)

    @property
    def address(self) -> str:
        """The query that leads here: the configuration, the frame, the tab."""
        return typed.write_address(self.q, self.frame.value, self.kind.title)

    # What the browsers say

    def receive(self, query: str) -> int:
        """Go where "?q=...&frame=...&tab=..." says, as far as that is somewhere.

        Returns:
            The number of this word: a state that knows of it follows.
        """
        self.heard_words += 1
        q, frame, title = typed.read_address(query, self.arm.model.nq)
        self.open_tab(title)
        if frame in self.arm.names:
            self.frame.value = frame  # type: ignore[misc]
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
            self.scene.light(self.frame.value, None)

    # The open tab

    def open_tab(self, title: str) -> None:
        """Leave the open tab with all that it made, and open another one."""
        kind = self.kinds.get(title)
        if kind is None or (self.page and kind is self.kind):
            return
        with self.server.atomic():
            self.leave()
            self.frame.visible = not kind.wide
            self.solid.visible = True
            self.row.content = words.tab_row(self.kinds, title)
            self.scene.hide(False)
            self.scene.light(self.frame.value, None)
            self.scene.trace(())
            self.scene.look_from(kind.camera)
            self.kind = kind
            self.solid.value = kind.solid  # type: ignore[misc]
            self.look()
            self.page = page = Page(self, Sketch(self.server, self.scene.coarse))
            page.legend(COLOURS if self.day.ghost else {})
            self.tab = Tab(page)
            self.guarded(lambda: setattr(self, "tab", kind(page)))
            self.tell(self.q)
            if self.version:  # else when the file has been opened
                self.guarded(self.tab.begin)
        self.schedule()

    def leave(self) -> None:
        """Close the open tab, and remove all that it made."""
        if self.page is not None:
            self.guarded(self.tab.close)
            self.page.close()
            self.page = None
        for uuid, widget in list(self.widgets().items()):
            if uuid not in self.fixed:
                widget.remove()

    def tell(self, q: Array) -> None:
        """Tell the open tab where the arm is; a closed one hears of no move."""
        if self.page is not None:
            self.guarded(partial(self.tab.on_move, q.copy()))

    def lose(self) -> None:
        """Tell the open tab that the student's function gave no numbers."""
        self.guarded(self.tab.lost)

    def guarded(self, call: Callable[[], None]) -> None:
        """Call a tab's code; where it fails the page says so and goes on."""
        try:
            call()
        except Exception as error:
            if self.page is None:  # nobody to tell: the tab is gone
                return
            what = f"{type(error).__name__}: {error}"
            self.page.say(f"the tab {self.kind.title} stopped with {what}", "bad")

    # The student's file

    async def watch(
        self, check: Callable[[], Standing], stop: Callable[[], None] = lambda: None
    ) -> None:
        """Ask the file for the arm at every move, and the checker at every save.

        `stop` ends a check that is at work: its file is not there any more.
        """
        self.check, self.stop = check, stop
        while True:
            if self.student.saved():
                self.forget()  # before the look, which may wait for an old answer
                await asyncio.to_thread(self.student.look)
            if self.version != self.student.version:
                self.version = self.student.version
                self.unchecked = True
                self.ask()  # the checks, which are slower, come after that
            await asyncio.sleep(LOOKS)

    def forget(self) -> None:
        """Say that all is asked again; what an older file showed is not true of it."""
        if self.seen.kind != "asking" or self.standing is not ASKING:
            self.stop()
            self.seen, self.standing = asked(self.day.ghost), ASKING
            with self.server.atomic():
                if self.page is not None:
                    self.page.asking()
                self.show_seen()
            self.show_tasks()

    def ask(self) -> None:
        """Ask the file, once it is open, where it puts the arm."""
        if self.version:
            see = partial(self.student.see, self.arm.q.copy())
            self.asks.want(see, partial(self.hear, self.version))

    def now(self, version: int) -> bool:
        """Return whether a version of the file is the one that is there."""
        return version == self.student.version and not self.student.saved()

    def hear(self, version: int, seen: Seen) -> None:
        """Show what the student's function said, unless it was saved meanwhile."""
        if not self.now(version):
            return
        self.seen = seen
        self.show_seen()
        if self.unchecked:
            self.unchecked = False
            self.tell(self.arm.q)  # whatever the open tab asks is asked again
            self.guarded(self.tab.begin)
            self.schedule()
            if self.student.there:
                self.checks.want(self.check, partial(self.judge, self.version))
            else:
                self.judge(self.version, Standing(""))

    def show_seen(self) -> None:
        """Show the ghost, and what is said of it."""
        end = self.day.ghost.frames[-1] if self.day.ghost else END
        with self.server.atomic():
            self.show()  # first: a page that is behind has the words before the arms
            self.scene.show_ghost(self.seen.drawn, end)

    def judge(self, version: int, found: Standing) -> None:
        """Show how a file's tasks stand, unless it was saved again meanwhile."""
        if self.now(version):
            self.standing = found
            self.show_tasks()

    def show_tasks(self) -> None:
        """Show how the tasks stand, in the open tab too."""
        self.guarded(partial(self.tab.judged, self.standing))
        self.schedule()

    def close(self) -> None:
        """End whatever runs."""
        self.leave()
        self.asks.stop()
        self.checks.stop()
