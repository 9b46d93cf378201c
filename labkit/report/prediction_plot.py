"""A day's predictions as an SVG: a dot for what was predicted, a ring for the result.

Each prediction has a scale of its own, since each has its own unit. Coordinates are
pixels, y downwards; a role is a colour of the page's style, by name. The text of a
worksheet is a student's, so all of it is escaped.
"""

import math
import textwrap
from html import escape

from labkit.base.text import visible
from labkit.report.prediction_values import Prediction, compared, value_of

WIDTH, LEFT, RIGHT = 360, 10, 350
LINE = 15  # pixels, of a line of text
TICK = 16  # pixels, from an axis to the foot of its labels
BELOW = 26  # pixels, from the last line of a prediction to the first of the next
LETTERS = 56  # the most letters in a line of text
MOST = 12  # predictions of a day that are drawn
CLIP = 40  # letters that are shown of a cell
DECADES = 20.0  # the ratio of two numbers from which on their scale is logarithmic


def draw(worksheet: str) -> str:
    """Return the picture of a worksheet's predictions; "" where it has none."""
    rows = compared(worksheet)[:MOST]
    if not rows:
        return ""
    parts, y = _legend(), 2.0 * LINE + 4
    for row in rows:
        drawn, y = _row(row, y)
        parts += drawn
    says = escape("Predicted and measured. " + " ".join(map(_in_words, rows)))
    return (
        f'<svg viewBox="0 0 {WIDTH} {y:.0f}" role="img" aria-label="{says}">'
        f"{''.join(parts)}</svg>"
    )


def _in_words(row: Prediction) -> str:
    """Return a prediction as a sentence, for those who do not see the picture."""
    return f"{_clip(row.number, 100)}: {_both(row)}."


def _both(row: Prediction) -> str:
    """Return the two numbers as the worksheet has them."""
    measured = f"measured {_clip(row.measured)}" if row.measured else "not measured yet"
    return f"predicted {_clip(row.predicted)}, {measured}"


def _clip(text: str, most: int = CLIP) -> str:
    return visible(text, most)


def _row(row: Prediction, y: float) -> tuple[list[str], float]:
    """Return one prediction's marks below y, and where the next one begins."""
    parts = []
    for text in textwrap.wrap(_clip(row.number, 100), LETTERS):
        parts.append(_text(LEFT, y, text, "ink"))
        y += LINE
    values = value_of(row.predicted), value_of(row.measured)
    there = [value for value in values if value is not None]
    if there:
        parts += _marks(there, values, y)
        y += TICK + LINE
    parts.append(_text(LEFT, y, _both(row), "muted"))
    return parts, y + BELOW


def _marks(
    there: list[float], values: tuple[float | None, float | None], y: float
) -> list[str]:
    """Return the scale, and the dot and the ring on it."""
    scale = _Scale(there)
    parts = [f'<path d="M{LEFT} {y}H{RIGHT}" stroke="var(--grid)" stroke-width="2"/>']
    for x, label in scale.ticks():
        parts.append(f'<path d="M{x:.1f} {y - 4}v8" stroke="var(--muted)"/>')
        parts.append(_text(x, y + TICK, label, "muted", ' text-anchor="middle"'))
    predicted, measured = values
    if predicted is not None:
        parts.append(_dot(scale.x(predicted), y))
    if measured is not None:
        parts.append(_ring(scale.x(measured), y))
    return parts


class _Scale:
    """Where a value is: linear from 0, or in decades if the values lie far apart."""

    def __init__(self, values: list[float]) -> None:
        low, high = min(values), max(values)
        self.log = low > 0 and high / low >= DECADES
        self.low, self.high = min(low, 0.0), max(high, 0.0)
        if self.log:
            self.low = float(math.floor(math.log10(low)))
            self.high = float(math.ceil(math.log10(high)))

    def x(self, value: float) -> float:
        """Return the place of a value."""
        return self._place(math.log10(value) if self.log else value)

    def ticks(self) -> list[tuple[float, str]]:
        """Return the place of 0, or those of a few powers of ten, with their labels."""
        if not self.log:
            return [(self._place(0.0), "0")]
        step = max(1, math.ceil((self.high - self.low) / 6))
        powers = range(int(self.low), int(self.high) + 1, step)
        return [
            (self._place(e), f"1e{e}" if abs(e) > 3 else f"{10.0**e:g}") for e in powers
        ]

    def _place(self, at: float) -> float:
        """Return a place between the ends, with room for a mark."""
        half = self.high / 2 - self.low / 2  # the difference itself may overflow
        fraction = (at / 2 - self.low / 2) / half if half else 0.0
        return LEFT + 8 + fraction * (RIGHT - LEFT - 16)


def _legend() -> list[str]:
    return [
        _dot(LEFT + 8, 10),
        _text(LEFT + 18, 14, "predicted", "muted"),
        _ring(LEFT + 90, 10),
        _text(LEFT + 102, 14, "measured", "muted"),
    ]


def _dot(x: float, y: float) -> str:
    return f'<circle class="dot" cx="{x:.1f}" cy="{y}" r="4" fill="var(--limit)"/>'


def _ring(x: float, y: float) -> str:
    paint = 'fill="none" stroke="var(--line)" stroke-width="2"'
    return f'<circle class="ring" cx="{x:.1f}" cy="{y}" r="7" {paint}/>'


def _text(x: float, y: float, text: str, role: str, more: str = "") -> str:
    paint = f'fill="var(--{role})"{more}'
    return f'<text x="{x:.1f}" y="{y:.1f}" {paint}>{escape(text)}</text>'
