"""Numbers as bars and as curves, for a tab."""

from collections.abc import Sequence
from html import escape

import numpy as np
import viser
from numpy.typing import ArrayLike
from viser import uplot

from robo47.checks import Array

KEPT = 2_000  # points of a plot that is added to
STROKES = ("#0b57c4", "#d55e00", "#00704f", "#7a3e9d", "#8a6d00", "#4a5560", "#b3261e")


class Bars:
    """A bar per number; over its limit it is red and says so."""

    def __init__(
        self,
        handle: viser.GuiHtmlHandle,
        labels: Sequence[str],
        full: Array,
        unit: str,
        title: str,
    ) -> None:
        """Start at zero; see `Page.bars`."""
        self.handle, self.labels, self.full = handle, labels, full
        self.unit, self.title = unit, title
        self.show(np.zeros(len(labels)))

    def show(self, values: ArrayLike) -> None:
        """Set every bar, (n,)."""
        rows = zip(self.labels, np.asarray(values, dtype=float), self.full, strict=True)
        title = f"<b>{escape(self.title)}</b>" if self.title else ""
        made = "".join(self._row(*row) for row in rows)
        self.handle.content = f'<div class="r47-bars">{title}{made}</div>'

    def _row(self, label: str, value: float, full: float) -> str:
        over = not abs(value) <= full
        share = 50 * min(abs(value) / full, 1.0) if np.isfinite(value) else 0.0
        left = 50.0 if value >= 0 else 50.0 - share
        mark = ' class="over"' if over else ""
        bar = f'<u{mark} style="left:{left:.1f}%;width:{share:.1f}%"></u>'
        text = f"{value:.4g} {self.unit}{' !' if over else ''}"
        name, number = escape(label), escape(text)
        return f"<div><span>{name}</span><s>{bar}</s><em>{number}</em></div>"


class Plot:
    """Curves over one axis; a new point can be added at their right."""

    def __init__(
        self, gui: viser.GuiApi, curves: Sequence[str], x: str, y: str, height: int
    ) -> None:
        """Start empty; see `Page.plot`."""
        self.count = len(curves)
        self.points: list[list[float]] = []
        series = [uplot.Series(label=x)] + [
            uplot.Series(label=name, stroke=STROKES[i % len(STROKES)], width=2)
            for i, name in enumerate(curves)
        ]
        empty = tuple(np.zeros(1) for _ in series)
        scales = {"x": uplot.Scale(time=False)}
        self.handle = gui.add_uplot(
            empty, tuple(series), title=y or None, scales=scales, height=height
        )

    def show(self, x: ArrayLike, ys: ArrayLike) -> None:
        """Draw whole curves.

        Args:
            x: (n,).
            ys: one row per curve, (m, n).
        """
        rows = np.atleast_2d(np.asarray(ys, dtype=float))
        self.handle.data = (np.asarray(x, dtype=float), *rows)

    def add(self, x: float, values: ArrayLike) -> None:
        """Add one point to every curve; the oldest go after 2,000.

        Args:
            x: larger than the one before.
            values: (m,).
        """
        self.points.append([x, *np.asarray(values, dtype=float)])
        self.points = self.points[-KEPT:]
        x_, *ys = np.array(self.points).T
        self.show(x_, ys)

    def clear(self) -> None:
        """Forget the points that were added."""
        self.points = []
        self.show(np.zeros(1), np.zeros((self.count, 1)))
