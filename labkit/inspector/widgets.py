"""The widgets that a tab puts on the page: viser's own; they go with the tab."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray

from labkit.inspector import words
from labkit.inspector.instruments import Bars, Plot
from robo47.checks import Array

if TYPE_CHECKING:
    from labkit.inspector.app import Inspector

Widget = TypeVar("Widget", bound=Any)
NARROW = "\u202f"  # a space that no line breaks at
DIGITS = 4  # shown behind the point in a slider's box


class Widgets:
    """Sliders, buttons, texts, bars and plots of one opened tab."""

    def __init__(self, host: "Inspector") -> None:
        """Begin a tab without widgets.

        Args:
            host: the page as a whole.
        """
        self.host, self.gui = host, host.server.gui
        self.said: viser.GuiHtmlHandle | None = None

    def html(self, text: str = "") -> viser.GuiHtmlHandle:
        """Add HTML; setting `content` changes it. `words` makes lines and matrices."""
        return self.gui.add_html(text)

    def say(self, text: str, kind: str = "") -> None:
        """Show a line at the tab's end, instead of the one before.

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
    ) -> viser.GuiSliderHandle[float]:
        """Add a slider with a box for typing; setting `value` moves it.

        Args:
            label: what a person reads.
            low: the least value.
            high: the greatest.
            start: at first.
            on_change: is given the new value.
            unit: behind the label; "" for none.
            step: between values, and of an arrow key.
        """
        # What the mouse gives are whole steps: from a whole step on, they are round.
        least, most = np.ceil(low / step) * step, np.floor(high / step) * step
        text = f"{label} ({unit.replace(' ', NARROW)})" if unit else label
        start = float(np.clip(start, least, most))
        handle = self.gui.add_slider(
            text, float(least), float(most), float(step), start, marks=()
        )
        handle.precision = DIGITS

        def changed(value: float) -> None:
            if low <= value <= high:  # viser believes any number
                on_change(round(value, 6))

        return self.listen(handle, changed)

    def buttons(
        self, options: Sequence[str], on_press: Callable[[str], None]
    ) -> viser.GuiButtonGroupHandle:
        """Add a row of buttons; `on_press` is given the text of the one pressed."""
        return self.listen(self.gui.add_button_group("", options), on_press)

    def choice(
        self, label: str, options: Sequence[str], on_change: Callable[[str], None]
    ) -> viser.GuiDropdownHandle[str]:
        """Add a drop-down, its first option chosen."""
        return self.listen(self.gui.add_dropdown(label, tuple(options)), on_change)

    def tick(
        self, label: str, on_change: Callable[[bool], None]
    ) -> viser.GuiCheckboxHandle:
        """Add a check box, unticked."""
        return self.listen(self.gui.add_checkbox(label, False), on_change)

    def listen(self, handle: Widget, then: Callable[[Any], None]) -> Widget:
        """Have a function called when a person changes a widget; return the widget.

        Args:
            handle: viser's.
            then: is given the new value; where it fails the page says so and goes on.
        """
        group = isinstance(handle, viser.GuiButtonGroupHandle)

        @(handle.on_click if group else handle.on_update)
        async def _(event: viser.GuiEvent) -> None:
            if event.client is not None:  # else it was the page itself
                self.host.heard(partial(then, handle.value))

        return handle

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
                negative; "scale" too, and its end is no limit: nothing turns red.
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
        least: float = 0.0,
    ) -> Plot:
        """Add a plot; `show(x, ys)` or `add(x, values)` fills it.

        Args:
            curves: one name per curve.
            x: the horizontal axis.
            y: the title: what is drawn, with its unit.
            height: pixels.
            least: the lowest value of a logarithmic axis; 0 for a plain one.
        """
        return Plot(self.gui, curves, x, y, height, least)

    def image(self, picture: Array, title: str = "") -> viser.GuiImageHandle:
        """Add an image; setting `image` to what `as_bytes` makes of one changes it.

        Args:
            picture: (rows, columns, 3) of bytes, or (rows, columns) of any numbers,
                drawn from black (the smallest) to white.
            title: above.
        """
        return self.gui.add_image(as_bytes(picture), label=title or None, format="png")


def as_bytes(picture: Array) -> NDArray[np.uint8]:
    """Return an image of bytes, (rows, columns, 3), of one that may be of numbers."""
    if picture.ndim == 3:
        return np.asarray(picture, dtype=np.uint8)
    finite = np.nan_to_num(np.asarray(picture, dtype=float))  # no ray: black
    span = max(float(np.ptp(finite)), 1e-12)
    grey = np.round(255.0 * (finite - finite.min()) / span).astype(np.uint8)
    return np.repeat(grey[..., None], 3, axis=2)
