"""A series as an SVG of lines, dots and labels.

Every run has the same width, since a date has no time of day. Coordinates are
pixels, y downwards; a role is a colour of the page's style, by name.
"""

import math
from html import escape

from labkit.log.rows import Row
from labkit.report.series import Series, failures_of, float_of, value_of

WIDTH, HEIGHT = 360, 170
LEFT = 46
RIGHT = 348
TOP = 14
BOTTOM = 126
MOST = 240  # points: more cannot be told apart, and would only make the page heavy
LABEL_GAP = 58  # the distance of two commits under the axis
HALF_LABEL = 26  # half the width of a label, a commit's seven figures


def number(value: float | None) -> str:
    """Return a value as the report prints it: three figures, no padding."""
    return "–" if value is None else f"{value:z.3g}"


def draw(series: Series) -> str:
    """Return the plot of a series as an SVG; "" with nothing to plot."""
    if not series.values:
        return ""
    axis = _Axis(series)
    parts = []
    for tick in axis.ticks():
        y = axis.y(tick)
        parts.append(_line([(LEFT, y), (RIGHT, y)], "grid"))
        parts.append(_label(LEFT - 6, y + 3.5, axis.label(tick), "end"))
    parts += _threshold(series, axis)
    chosen = _thinned(series.rows)
    places = [(_x(i, len(chosen)), row) for i, row in enumerate(chosen)]
    line = [(x, axis.y(float_of(row))) for x, row in places if _finite(row)]
    parts.append(_line(line, "line"))
    radius = 4 if len(places) <= 40 else 2
    parts += [_dot(series, axis, x, row, radius) for x, row in places[:-1]]
    x, last = places[-1]
    halo = 'fill="var(--line)" fill-opacity=".2"'
    parts.append(_circle(x, axis.y(float_of(last)), 8, halo, ""))
    parts.append(_dot(series, axis, x, last, 4))
    label = escape(f"{series.wanted.check} {series.wanted.metric}, run by run")
    return (
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{label}">'
        f"{''.join(parts + _under_axis(places))}</svg>"
    )


def _line(points: list[tuple[float, float]], role: str, more: str = "") -> str:
    places = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{places}" fill="none" stroke="var(--{role})"{more}/>'


def _label(
    x: float, y: float, text: str, anchor: str = "middle", role: str = "muted"
) -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"'
        f' fill="var(--{role})">{escape(text)}</text>'
    )


def _circle(x: float, y: float, radius: int, paint: str, tip: str) -> str:
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" {paint}>'
        f"<title>{escape(tip)}</title></circle>"
    )


class _Axis:
    """The vertical axis: which values it spans, and where each one is."""

    def __init__(self, series: Series) -> None:
        self.log = series.is_log
        self.has_zero = False
        shown = [_drawable(v) for v in series.values]
        shown += [bound for _, bound in series.bounds]
        shown = [v for v in shown if v > 0 or not self.log]
        low, high = min(shown), max(shown)
        if self.log:
            low, high = math.floor(math.log10(low)), math.ceil(math.log10(high))
            high = min(high, 308)
            # a decade below for exact zeros, which have no logarithm
            self.has_zero = 0 in series.values
            low -= self.has_zero or low == high
        elif low == high:
            low = low - (abs(low) or 1) / 2
            high = high + (abs(high) or 1) / 2
        self.low, self.high = low, high

    def y(self, value: float) -> float:
        """Return a value's height: no number on top, no logarithm on the floor."""
        if not math.isfinite(value):
            return TOP
        if self.log:
            value = math.log10(value) if value > 0 else self.low
        share = (_drawable(value) - self.low) / (self.high - self.low)
        return BOTTOM - share * (BOTTOM - TOP)

    def ticks(self) -> list[float]:
        """Return up to five round values."""
        if self.log:
            step = max(1, math.ceil((self.high - self.low) / 4))
            first = int(self.low) + self.has_zero
            zero = [0.0] * self.has_zero
            return zero + [10.0**e for e in range(first, int(self.high) + 1, step)]
        step = 10 ** math.floor(math.log10((self.high - self.low) / 2))
        while (self.high - self.low) / step > 4:
            step *= 2
        first = math.ceil(self.low / step)
        last = math.floor(self.high / step)
        return [float(f"{i * step:.12g}") for i in range(first, last + 1)]

    def label(self, tick: float) -> str:
        """Return a tick's text, with the figures that tell it from the next."""
        if self.log or tick == 0:
            return f"{tick:zg}"
        span = (self.high - self.low) / 4
        figures = math.ceil(math.log10(max(abs(tick) / span, 1))) + 2
        return f"{tick:.{min(figures, 8)}g}"


def _drawable(value: float) -> float:
    """Return a value whose distance to any other is still a float."""
    return max(-8e307, min(8e307, value))


def _threshold(series: Series, axis: _Axis) -> list[str]:
    parts = []
    for sign, bound in series.bounds:
        if axis.log and bound <= 0:
            continue
        y = axis.y(bound)
        dashes = ' stroke-dasharray="5 4"'
        parts.append(_line([(LEFT, y), (RIGHT, y)], "limit", dashes))
        label_y = y + 12 if y < TOP + 12 else y - 4
        first, last = (abs(axis.y(float_of(series.rows[i])) - y) for i in (0, -1))
        x, anchor = (LEFT, "start") if first > last else (RIGHT, "end")
        parts.append(_label(x, label_y, f"pass {sign} {bound:g}", anchor, "limit"))
    return parts


def _dot(series: Series, axis: _Axis, x: float, row: Row, radius: int) -> str:
    """Return a run's dot; hollow where the axis cannot show its value."""
    role = series.wanted.judge(row) if series.wanted.limit else "line"
    tip = f"{value_of(row)!r} on {row['date']}, commit {row['git_sha'] or 'unknown'}"
    if failed := failures_of(row):
        tip += f", {failed}"
    paint = f'fill="var(--{role})"'
    if not _finite(row) or (axis.log and float_of(row) <= 0):
        paint = f'fill="var(--card)" stroke="var(--{role})" stroke-width="1.5"'
    return _circle(x, axis.y(float_of(row)), radius, paint, tip)


def _under_axis(places: list[tuple[float, Row]]) -> list[str]:
    """Label the runs with commits, where they change and fit, and with dates."""
    parts = []
    last_x = -math.inf
    before = None
    for x, row in places:
        sha = str(row["git_sha"])[:7]
        if sha != before and x - last_x >= LABEL_GAP:
            middle = min(x, WIDTH - HALF_LABEL)
            parts.append(_label(middle, BOTTOM + 18, sha or "no commit"))
            last_x, before = x, sha
    first, last = str(places[0][1]["date"]), str(places[-1][1]["date"])
    if first == last:
        return [*parts, _label((LEFT + RIGHT) / 2, BOTTOM + 34, first)]
    parts.append(_label(LEFT, BOTTOM + 34, first, "start"))
    parts.append(_label(RIGHT, BOTTOM + 34, last, "end"))
    return parts


def _x(index: int, count: int) -> float:
    if count == 1:
        return (LEFT + RIGHT) / 2
    return LEFT + 10 + index / (count - 1) * (RIGHT - LEFT - 20)


def _thinned(rows: list[Row]) -> list[Row]:
    """Return at most MOST rows: the extremes of each bin, and the latest."""
    if len(rows) <= MOST:
        return rows
    size = math.ceil(2 * len(rows) / (MOST - 1))
    heights = [float_of(row) if _finite(row) else math.inf for row in rows]
    kept = []
    for start in range(0, len(rows), size):
        bin_ = range(start, min(start + size, len(rows)))
        by_value = sorted(bin_, key=heights.__getitem__)
        kept += sorted({by_value[0], by_value[-1]})
    if kept[-1] != len(rows) - 1:
        kept.append(len(rows) - 1)
    return [rows[i] for i in kept]


def _finite(row: Row) -> bool:
    return math.isfinite(float_of(row))
