"""The page as a tab sees it: it makes widgets and drawings, which go with the tab.

The widgets are viser's own. Where a callback fails the page says so and goes on.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, Protocol, TypeVar

import mujoco
import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.inspector import words
from labkit.inspector.animate import Animation, Jobs, Step
from labkit.inspector.arm import Arm
from labkit.inspector.draw import Colour, Sketch, rgb
from labkit.inspector.instruments import Bars, Plot, as_bytes
from labkit.inspector.own import NoAnswerError, Own
from labkit.inspector.robot import Load, Robot
from labkit.inspector.scene import ArmScene
from labkit.inspector.student import Student
from robo47.checks import Array

SLOW = 1.5  # times slower than real time, which is said
NARROW = "\u202f"  # a space that no line breaks at
DIGITS = 4  # shown behind the point in a slider's box
END = 1e14  # the order of the last widget of a tab
Widget = TypeVar("Widget", bound=Any)


class Host(Protocol):
    """What a page asks of `labkit.inspector.app.Inspector`, which opens it."""

    server: viser.ViserServer
    arm: Arm
    q: Array
    scene: ArmScene
    solid: viser.GuiCheckboxHandle
    legend: viser.GuiHtmlHandle
    student: Student
    simple: bool
    standing: Any  # how the tasks stand, as a tab of every day shows it

    def move(self, q: ArrayLike) -> None:
        """Move the arm to q, (nq,), in radians and metres."""

    def undo(self) -> None:
        """Take the last move back."""

    def schedule(self) -> None:
        """Have all that is shown brought up to date soon."""

    def listen(self, widget: Widget, then: Callable[[Any], None]) -> Widget:
        """Have a function called when a person changes a widget; return the widget."""

    def lose(self) -> None:
        """Tell the open tab that the student's function gave no numbers."""


class Page:
    """One opened tab's view of the page."""

    def __init__(self, host: Host, sketch: Sketch) -> None:
        self.host = host
        self.gui = host.server.gui
        self.draw = sketch
        self.scene = host.server.scene
        self.arm = host.arm
        self.model: mujoco.MjModel = host.arm.model
        # At the end whatever comes later. One that came with the first word would have
        # viser draw all others anew: a slider in hand would be lost to the mouse.
        self.said = self.gui.add_html("", order=END)
        self.running: list[Animation | Jobs] = []  # everything that ends with the tab
        self.jobs = self.jobs_apart()
        self._own: Own | None = None
        self._whose: viser.GuiHtmlHandle | None = None
        self._asking = False  # whether that line says that no answer is known

    # The arm

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
        """Return where every body is at q, (7,), for a ghost's `pose`."""
        whole = self.q
        whole[: len(np.asarray(q))] = q  # fingers stay as they are
        poses = self.arm.poses_at(whole)
        links = {name: T for name, T in poses.items() if name.startswith("link")}
        return self.arm.carried(links)

    def move(self, q: ArrayLike) -> None:
        """Move the arm, in every browser; q in radians and metres, (nq,)."""
        self.host.move(q)

    def light(
        self, chosen: str | None = None, shown: Collection[str] | None = None
    ) -> None:
        """Choose by short names which frame stands out, and which are shown at all.

        None is no one of the first, and every one of the second.
        """
        self.host.scene.light(chosen, shown)

    def hide_arm(self) -> None:
        """Draw no arm but the tab's own, until the tab is left."""
        self.host.scene.hide()
        self.host.solid.visible = False

    def robot(self, bare: Load, dressed: Load) -> Robot:
        """Draw a scene of MuJoCo's in place of the arm, by its loaders; see `Robot`."""
        return Robot(self, bare(), dressed)

    def legend(self, colours: Mapping[str, Colour]) -> None:
        """Say over the scene what its colours mean: {what is drawn: its colour}."""
        told = {what: rgb(colour) for what, colour in colours.items()}
        self.host.legend.content = words.legend(told, "stage")

    def key(self, colours: Mapping[str, Colour]) -> viser.GuiHtmlHandle:
        """Add what the colours of a picture mean, directly below it."""
        told = {what: rgb(colour) for what, colour in colours.items()}
        return self.html(words.legend(told))

    # The student's functions, and what takes time

    def own(
        self,
        library: Any,
        free: Collection[str] = (),
        any_rows: Collection[str] = (),
        units: Mapping[str, str] | None = None,
    ) -> Own:
        """Return the student's functions; a line of the panel says how they compare.

        They wait for the sandbox: call them in `job`, or in the `work` of `animate`.

        Args:
            library: the module with the functions of the same names, or {name: it}.
            free: names of functions that have more than one right answer.
            any_rows: of those whose answers may have any number of rows, such as ways;
                the tab itself says how they compare.
            units: of what the functions return, {name: unit}; none for plain numbers.
        """
        self._whose = self.html()
        self.asking()
        student, loop = self.host.student, self.host.server.get_event_loop()
        own = self._own = Own(
            student, library, free, any_rows, units,
            lambda: loop.call_soon_threadsafe(self._asks, own),
        )  # fmt: skip
        return own

    def jobs_apart(self) -> Jobs:
        """Return a queue of its own, for what shall not wait behind `job`."""
        made = Jobs(self._ended)
        self.running.append(made)
        return made

    def job(self, work: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Do work that waits, and may call `own`; `done` is given what it returned.

        Of several that wait the newest is done.
        """
        self.jobs.want(work, done)

    def animate(
        self, step: Step, hz: float = 30.0, work: Callable[[float], Any] | None = None
    ) -> Animation:
        """Prepare a loop in real time, see `Animation`; its work may call `own`.

        `start()`, `stop()` or `toggle()` it from a button.
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
        own = self._own
        none = isinstance(error, NoAnswerError) and error.version
        if own is not None and (not own.fresh() or none not in (False, own.version)):
            self.asking()  # an older file's answer is out of date
        elif isinstance(error, NoAnswerError):
            self._show_whose(str(error), "bad")
            self.say("")
            self.host.lose()
        elif error is not None:
            self.host.lose()
            text, kind = own.says() if own else ("", "")
            text = text if kind == "bad" else "The tab stopped: see below"
            self._show_whose(text, "bad")
            self.say(f"stopped: {type(error).__name__}: {error}", "bad")
        elif own is not None:
            text, kind = own.says()
            # What a loop or another job still waits for may be wrong, or never come.
            if kind == "bad" or not (self._asking and self._due()):
                self._show_whose(text, kind)
        self.host.schedule()

    def _asks(self, own: Own) -> None:
        """Say that it is asked for what it was not before, unless all was stopped."""
        if self._own is own and any(one.task for one in self.running):
            self.asking()

    def asking(self) -> None:
        """Say that the student's functions are asked, and that no answer is known."""
        if self._whose is not None:
            self._show_whose("asking YOUR functions ...", "asking")

    def _due(self) -> bool:
        """Return whether a first answer has still to come."""
        return any(one.due for one in self.running)

    def _show_whose(self, text: str, kind: str) -> None:
        self._asking = kind == "asking"
        if self._whose is not None:
            self._whose.content = words.judged(text, "whose", kind)

    # The widgets

    def html(self, text: str = "") -> viser.GuiHtmlHandle:
        """Add HTML; setting `content` changes it. `words` makes lines and matrices."""
        return self.gui.add_html(text)

    def say(self, text: str, kind: str = "") -> None:
        """Show a line at the tab's end, instead of the one before; see `words.line`."""
        self.said.content = words.line(text, "tab", kind)

    def matrix(self, handle: viser.GuiHtmlHandle, name: str, T: Array) -> None:
        """Show a pose, (4, 4), under its name in a handle of `html`."""
        handle.content = words.matrix(name, T, f"tab-{handle._impl.uuid[:6]}")

    def slider(
        self,
        label: str,
        low: float,
        high: float,
        start: float,
        on_change: Callable[[float], None],
        *,
        unit: str = "rad",
        step: float = 0.01,
    ) -> viser.GuiSliderHandle[float]:
        """Add a slider from low to high with a box; setting `value` moves it.

        Args:
            label: what a person reads, with the unit behind it unless "".
            low, high, start: values; the slider's ends are whole steps between.
            on_change: is given the new value.
            unit: of the values.
            step: between values, and of an arrow key.
        """
        # What the mouse gives are whole steps: from a whole step on, they are round.
        least = float(np.ceil(low / step) * step)
        most = float(np.floor(high / step) * step)
        text = f"{label} ({unit.replace(' ', NARROW)})" if unit else label
        start = float(np.clip(start, least, most))
        handle = self.gui.add_slider(text, least, most, float(step), start, marks=())
        handle.precision = DIGITS

        def changed(value: float) -> None:
            if low <= value <= high:  # viser believes any number
                on_change(round(value, 6))

        return self.host.listen(handle, changed)

    def buttons(
        self, options: Sequence[str], on_press: Callable[[str], None]
    ) -> viser.GuiButtonGroupHandle:
        """Add a row of buttons; `on_press` is given the text of the one pressed."""
        return self.host.listen(self.gui.add_button_group("", options), on_press)

    def choice(
        self, label: str, options: Sequence[str], on_change: Callable[[str], None]
    ) -> viser.GuiDropdownHandle[str]:
        """Add a drop-down, its first option chosen."""
        return self.host.listen(self.gui.add_dropdown(label, tuple(options)), on_change)

    def tick(
        self, label: str, on_change: Callable[[bool], None]
    ) -> viser.GuiCheckboxHandle:
        """Add a check box, unticked."""
        return self.host.listen(self.gui.add_checkbox(label, False), on_change)

    def bars(
        self,
        labels: Sequence[str],
        limits: ArrayLike,
        unit: str,
        title: str = "",
        kind: str = "both",
    ) -> Bars:
        """Add a bar per number; `show(values, wanted)` sets them, and marks.

        Args:
            labels: one per bar.
            limits: the absolute value at which a bar is full, (n,) or one for all.
            unit: behind the numbers.
            title: above.
            kind: "both" from zero to both sides; "up" from the left, for what is never
                negative; "scale" too, and its end is no limit: nothing turns red;
                "signed" is a scale to both sides.
        """
        full = np.broadcast_to(np.asarray(limits, dtype=float), (len(labels),))
        return Bars(self.html(), labels, full, unit, title, kind)

    def plot(
        self,
        curves: Sequence[str],
        *,
        x: str = "t (s)",
        y: str = "",
        height: int = 150,
        least: float = 0,
        below: int = 0,
    ) -> Plot:
        """Add a plot; `show(x, ys)` or `add(x, values)` fills it.

        Args:
            curves: one name per curve.
            x: the horizontal axis.
            y: the title: what is drawn, with its unit.
            height: pixels.
            least: the lowest value of a logarithmic axis; 0 for a plain one.
            below: so many of the first curves are wide: an equal one on them is seen.
        """
        return Plot(self.gui, curves, x, y, height, least, below)

    def image(self, picture: Array, title: str = "") -> viser.GuiImageHandle:
        """Add an image; setting `image` to what `as_bytes` makes of one changes it.

        Args:
            picture: (rows, columns, 3) of bytes, or (rows, columns) of any numbers,
                drawn from black (the smallest) to white.
            title: above.
        """
        return self.gui.add_image(as_bytes(picture), label=title or None, format="png")

    def close(self) -> None:
        """Stop the loops, remove the drawings."""
        for each in self.running:
            each.stop()
        self._own = None
        self.draw.clear()
