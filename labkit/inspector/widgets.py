"""The widgets that a tab puts on the page; they go with it."""

from collections.abc import Callable, Collection, Sequence
from typing import Protocol

import numpy as np
import viser
from numpy.typing import ArrayLike

from labkit.base.exchange import Question, Reply
from labkit.inspector import controls, words
from labkit.inspector.arm import Arm
from labkit.inspector.checks import Standing
from labkit.inspector.controls import Controls
from labkit.inspector.instruments import Bars, Plot
from robo47.checks import Array


class Host(Protocol):
    """The page as a whole, as far as a tab's `Page` needs it."""

    server: viser.ViserServer
    arm: Arm
    controls: Controls
    standing: Standing

    @property
    def q(self) -> Array:
        """The configuration that was asked for last."""

    def move(self, q: ArrayLike) -> None:
        """Move the arm."""

    def undo(self) -> None:
        """Take the last move back."""

    def refresh(self) -> None:
        """Tell every browser what the controls show."""

    def light(self, chosen: str | None, shown: Collection[str] | None) -> None:
        """Choose the frames that are drawn."""

    def trace(self, origins: Array) -> None:
        """Draw the way from the world through points."""

    def ask(self, question: Question, done: Callable[[Reply], None]) -> None:
        """Ask the student's file."""


class Slider:
    """A number that a person sets; `value` is what it is, `set` changes it."""

    def __init__(
        self, name: str, value: float, host: Host, handle: viser.GuiHtmlHandle
    ) -> None:
        """Start at a value; `handle.visible` hides it."""
        self.name, self.value, self.handle = name, value, handle
        self._host = host

    def set(self, value: float) -> None:
        """Show another value, without a callback."""
        self.value = value
        self._host.controls.values[self.name] = f"{value:.6g}"
        self._host.refresh()


class Widgets:
    """Sliders, buttons, texts, bars and plots of one opened tab."""

    def __init__(self, host: Host, title: str) -> None:
        """Begin a tab without widgets.

        Args:
            host: the page as a whole.
            title: of the tab; begins the controls' names.
        """
        self.host, self.gui, self.title = host, host.server.gui, title
        self.names: list[str] = []
        self.said: viser.GuiHtmlHandle | None = None

    def html(self, text: str = "") -> viser.GuiHtmlHandle:
        """Add HTML; setting `content` changes it. `words` makes lines and matrices."""
        return self.gui.add_html(text)

    def say(self, text: str, kind: str = "") -> None:
        """Show a line at the tab's end, in place of the one before.

        Args:
            text: plain text; "" for none.
            kind: "", "good", "bad" or "quiet".
        """
        self.end()
        assert self.said is not None
        self.said.content = words.line(text, "tab", kind) if text else ""

    def end(self) -> None:
        """Make the line of `say`, unless it is there.

        A widget that comes later has viser draw all the others anew: a slider that is
        being dragged is then lost to the mouse.
        """
        if self.said is None:
            self.said = self.html()

    def matrix(self, handle: viser.GuiHtmlHandle, name: str, T: Array) -> None:
        """Show a pose under its name in a handle of `html`."""
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
    ) -> Slider:
        """Add a slider with a box for typing.

        Args:
            label: what a person reads.
            low: the least value.
            high: the greatest.
            start: at first.
            on_change: is given the new value.
            unit: behind the box; in "rad", degrees can be typed as "90 deg".
            step: of an arrow key.
        """
        name = self._name()
        row = controls.dial(name, label, low, high, unit, step)
        made = Slider(name, start, self.host, self.html(row))

        def listen(text: str) -> None:
            try:
                made.set(controls.typed(text, label, low, high, unit))
            except ValueError as error:
                self.say(str(error), "bad")
                self.host.refresh()
                return
            self.say("")
            on_change(made.value)

        self.host.controls.listen(name, listen, f"{start:.6g}")
        return made

    def buttons(
        self, options: Sequence[str], on_press: Callable[[str], None]
    ) -> viser.GuiHtmlHandle:
        """Add a row of buttons.

        Args:
            options: their texts.
            on_press: is given the text of the one that was pressed.
        """
        name = self._name()
        self.host.controls.listen(name, _among(options, on_press))
        return self.html(controls.buttons(name, options))

    def choice(
        self,
        label: str,
        options: Sequence[str],
        on_change: Callable[[str], None],
        start: str | None = None,
    ) -> None:
        """Add a drop-down.

        Args:
            label: what a person reads.
            options: to choose from.
            on_change: is given the chosen one.
            start: chosen at first; the first unless given.
        """
        name = self._name()

        def listen(option: str) -> None:
            self.host.controls.values[name] = option
            self.host.refresh()
            on_change(option)

        row = controls.choice(name, label, options)
        self.html(f'<div class="r47-row">{row}</div>')
        self.host.controls.listen(name, _among(options, listen), start or options[0])

    def tick(
        self, label: str, on_change: Callable[[bool], None], start: bool = False
    ) -> None:
        """Add a check box.

        Args:
            label: what a person reads.
            on_change: is given whether it is ticked.
            start: at first.
        """
        name = self._name()

        def listen(value: str) -> None:
            self.host.controls.values[name] = value
            self.host.refresh()
            on_change(value == "true")

        self.html(f'<div class="r47-row">{controls.tick(name, label)}</div>')
        options = ("true", "false")
        self.host.controls.listen(name, _among(options, listen), str(start).lower())

    def bars(
        self, labels: Sequence[str], limits: ArrayLike, unit: str, title: str = ""
    ) -> Bars:
        """Add a bar per number, from zero to both sides; `show(values)` sets them.

        Args:
            labels: one per bar.
            limits: the absolute value at which a bar is full, (n,) or one for all.
            unit: behind the numbers.
            title: above.
        """
        full = np.broadcast_to(np.asarray(limits, dtype=float), (len(labels),))
        return Bars(self.html(), labels, full, unit, title)

    def plot(
        self, curves: Sequence[str], *, x: str = "t (s)", y: str = "", height: int = 150
    ) -> Plot:
        """Add a plot; `show(x, ys)` or `add(x, values)` fills it.

        Args:
            curves: one name per curve.
            x: the horizontal axis.
            y: the title: what is drawn, with its unit.
            height: pixels.
        """
        return Plot(self.gui, curves, x, y, height)

    def _name(self) -> str:
        self.names.append(f"{self.title}.{len(self.names)}")
        return self.names[-1]


def _among(
    options: Sequence[str], listener: Callable[[str], None]
) -> Callable[[str], None]:
    """Return a listener that hears nothing but these texts."""

    def listen(text: str) -> None:
        if text in options:
            listener(text)

    return listen
