"""Numbers as bars and as curves, for a tab."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
import viser
from numpy.typing import ArrayLike, NDArray
from viser import uplot

from robo47.checks import Array

WIDE = 60  # pixels, for the numbers beside a plot: 10,000
LOW = 34  # pixels, for the numbers below a plot
NAMED = 18  # pixels of the name below an axis
LABELS = 9  # labels on a logarithmic axis, at most
KEPT = 2_000  # points of a plot that is added to
STROKES = ("#0b57c4", "#d55e00", "#00704f", "#7a3e9d", "#8a6d00", "#4a5560", "#b3261e",
           "#1e2228")  # fmt: skip


@dataclass
class Bars:
    """A bar per number, see `Page.bars`; over its limit it is red and says so."""

    handle: viser.GuiHtmlHandle
    labels: Sequence[str]
    full: Array
    unit: str
    title: str
    kind: str

    def __post_init__(self) -> None:
        """Start at zero."""
        self.show(np.zeros(len(self.labels)))

    def show(self, values: ArrayLike, wanted: ArrayLike | None = None) -> None:
        """Set every bar, (n,), and the marks of what they should be, (n,)."""
        given = np.asarray(values, dtype=float)
        marks = np.full(len(given), np.nan) if wanted is None else np.asarray(wanted)
        rows = zip(self.labels, given, marks, self.full, strict=True)
        title = f"<b>{escape(self.title)}</b>" if self.title else ""
        made = "".join(self._row(*row) for row in rows)
        kind = "both" if self.both else self.kind
        self.handle.content = f'<div class="r47-bars {kind}">{title}{made}</div>'

    @property
    def both(self) -> bool:
        """Whether they go to both sides."""
        return self.kind in ("both", "signed")

    def clear(self) -> None:
        """Show no numbers."""
        self.show(np.full(len(self.labels), np.nan))

    def _at(self, value: float, full: float) -> float:
        """Return where a value is along its row, per cent."""
        part = float(np.clip(value / full, -1.0, 1.0)) if np.isfinite(value) else 0.0
        return 50.0 + 50.0 * part if self.both else max(100.0 * part, 0.0)

    def _row(self, label: str, value: float, wanted: float, full: float) -> str:
        over = self.kind not in ("scale", "signed") and abs(value) > full * (1 + 1e-6)
        left, right = sorted((self._at(0.0, full), self._at(value, full)))
        red = ' class="over"' if over else ""
        bar = f'<u{red} style="left:{left:.1f}%;width:{right - left:.1f}%"></u>'
        if np.isfinite(wanted):
            bar += f'<q style="left:{self._at(wanted, full):.1f}%"></q>'
        number = f"{three(value, full)} {self.unit}{' !' if over else ''}"
        name = escape(label)
        return f"<div><span>{name}</span><s>{bar}</s><em>{escape(number)}</em></div>"


def three(value: float, most: float) -> str:
    """Return a number as text, with three digits of the largest that it comes to."""
    places = max(0, 2 - int(np.floor(np.log10(most))))
    return f"{value:z.{places}f}" if np.isfinite(value) else "?"


class Plot:
    """Curves over one axis; a new point can be added at their right."""

    def __init__(
        self,
        gui: viser.GuiApi,
        curves: Sequence[str],
        x: str,
        y: str,
        height: int,
        least: float,
        below: int = 0,
    ) -> None:
        """Start empty; see `Page.plot`."""
        self.count = len(curves)
        self.least = least
        self.points: list[list[float]] = []
        series = [uplot.Series(label=x)] + [
            uplot.Series(
                label=name,
                stroke=STROKES[i % len(STROKES)],
                width=6 if i < below else 2,
            )
            for i, name in enumerate(curves)
        ]
        empty = tuple(np.full(1, least) for _ in series)
        self.top = 0.0  # of a logarithmic axis, at the curves' last points
        name = {"label": x, "labelSize": NAMED, "labelFont": "12px sans-serif"}
        self.across = uplot.Axis(**name, size=LOW)  # type: ignore[typeddict-item]
        self.handle = gui.add_uplot(
            empty, tuple(series), title=y or None, height=height,
            scales={"x": uplot.Scale(time=False)},
            axes=(self.across, uplot.Axis(size=WIDE)),
            # Without a mouse over the plot its values would all be "--".
            legend=uplot.Legend(live=False),
            padding=(14, 20, 0, 0),  # no tick is cut in half
        )  # fmt: skip
        if least:
            self._span(10 * least)

    def show(self, x: ArrayLike, ys: ArrayLike) -> None:
        """Draw whole curves over x, (n,), one row of ys per curve, (m, n)."""
        rows = np.atleast_2d(np.asarray(ys, dtype=float))
        if self.least:  # a logarithm has no zero
            rows = np.maximum(rows, self.least)
            self._span(float(np.max(rows, where=np.isfinite(rows), initial=self.least)))
        self.handle.data = (np.asarray(x, dtype=float), *rows)

    def _span(self, most: float) -> None:
        """Have a logarithmic axis end above a value, with a tick at each decade.

        uPlot's own ticks are nine a decade, which over seven decades merge into a bar.
        """
        low = int(np.floor(np.log10(self.least)))
        high = max(low + 1, int(np.ceil(np.log10(most))))
        if (top := 10.0**high) == self.top:
            return
        self.top = top
        powers = tuple(10.0**e for e in range(low, high + 1))
        step = -(-len(powers) // LABELS)
        labels = tuple(
            None if i % step else f"{power:,g}" if power < 1e6 else f"{power:.0e}"
            for i, power in enumerate(powers)
        )
        span = uplot.Scale(distr=3, log=10, range=(powers[0], top))
        self.handle.scales = {"x": uplot.Scale(time=False), "y": span}
        ticks = uplot.Axis(size=WIDE, splits=powers, values=labels)
        self.handle.axes = (self.across, ticks)

    def add(self, x: float, values: ArrayLike) -> None:
        """Add a point to every curve, (m,), NaN for none; the oldest go after 2,000."""
        self.points.append([x, *np.asarray(values, dtype=float)])
        self.points = self.points[-KEPT:]
        x_, *ys = np.array(self.points).T
        self.show(x_, ys)

    def clear(self) -> None:
        """Forget the points that were added."""
        self.points = []
        self.show(np.zeros(1), np.full((self.count, 1), self.least))


def as_bytes(picture: Array) -> NDArray[np.uint8]:
    """Return an image of bytes, (rows, columns, 3), of one that may be of numbers."""
    if picture.ndim == 3:
        return np.asarray(picture, dtype=np.uint8)
    finite = np.nan_to_num(np.asarray(picture, dtype=float))  # no ray: black
    span = max(float(np.ptp(finite)), 1e-12)
    grey = np.round(255.0 * (finite - finite.min()) / span).astype(np.uint8)
    return np.repeat(grey[..., None], 3, axis=2)
