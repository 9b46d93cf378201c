"""The report as one PNG, for a slide or a mail: the same cards, drawn by Pillow."""

import io
from collections.abc import Sequence

from PIL import Image, ImageDraw, ImageFont

from labkit.report import plot
from labkit.report.page import STATUS
from labkit.report.series import Report, Series, value_of

SCALE = 2  # pixels of the file per pixel of the drawing: sharp on any screen
SMOOTH = 2  # drawn larger still and shrunk, which rounds the edges
COLUMNS_WIDE = 3
CARD_W, CARD_H, GAP, HEAD = 392, 276, 18, 104
MOST = 60  # cards; a taller picture is no use to anyone
COLOURS = {
    "paper": "#f6f7f9",
    "card": "#ffffff",
    "ink": "#1b1f24",
    "muted": "#5c6670",
    "grid": "#e3e7eb",
    "line": "#3467b4",
    "halo": "#d6e1f1",
    "pass": "#1a7f37",
    "fail": "#c4232e",
    "limit": "#8a5a00",
    "open": "#5c6670",
    "none": "#5c6670",
}
ABSENT = str.maketrans({"–": "-"})  # from Pillow's own font
ANCHORS = {"start": "ls", "middle": "ms", "end": "rs"}


class _Canvas:
    """A drawing in the plot's own pixels, whatever the file's are."""

    def __init__(self, width: int, height: int, paper: str) -> None:
        self.size = (width, height)
        self.k = SCALE * SMOOTH
        self.image = Image.new("RGB", (width * self.k, height * self.k), COLOURS[paper])
        self.pen = ImageDraw.Draw(self.image)

    def text(
        self, x: float, y: float, words: str, size: int, role: str, anchor: str = "ls"
    ) -> None:
        font = ImageFont.load_default(size * self.k)
        place = (x * self.k, y * self.k)
        self.pen.text(place, words.translate(ABSENT), COLOURS[role], font, anchor)

    def line(
        self, points: Sequence[tuple[float, float]], role: str, wide: float
    ) -> None:
        scaled = [(x * self.k, y * self.k) for x, y in points]
        self.pen.line(scaled, COLOURS[role], round(wide * self.k), joint="curve")

    def circle(
        self, x: float, y: float, r: float, role: str, hollow: bool = False
    ) -> None:
        box = [(x - r) * self.k, (y - r) * self.k, (x + r) * self.k, (y + r) * self.k]
        fill = COLOURS["card" if hollow else role]
        self.pen.ellipse(box, fill, COLOURS[role], round(1.5 * self.k))

    def done(self) -> Image.Image:
        w, h = self.size
        return self.image.resize((w * SCALE, h * SCALE), Image.Resampling.LANCZOS)


def render(report: Report, heading: str) -> bytes:
    """Return the picture as a PNG file's bytes.

    Args:
        report: what to show; the first MOST series of it.
        heading: one line of plain text on where the rows come from.
    """
    shown = report.series[:MOST]
    lines = -(-len(shown) // COLUMNS_WIDE)
    width = COLUMNS_WIDE * (CARD_W + GAP) + GAP
    image = Image.new(
        "RGB",
        (width * SCALE, (HEAD + lines * (CARD_H + GAP)) * SCALE),
        COLOURS["paper"],
    )
    image.paste(_head(report, heading, width), (0, 0))
    for i, series in enumerate(shown):
        x = GAP + i % COLUMNS_WIDE * (CARD_W + GAP)
        y = HEAD + i // COLUMNS_WIDE * (CARD_H + GAP)
        image.paste(_card(series), (x * SCALE, y * SCALE))
    file = io.BytesIO()
    image.save(file, "PNG", optimize=True)
    return file.getvalue()


def _head(report: Report, heading: str, width: int) -> Image.Image:
    canvas = _Canvas(width, HEAD, "paper")
    canvas.text(GAP, 44, "robo47 metrics", 26, "ink")
    attention = len(report.repaired) + len(report.unread)
    counts = (
        f"{report.count('pass')} passing, {report.count('fail')} failing,"
        f" {report.count('none')} not run yet, {attention} lines to look at"
    )
    canvas.text(GAP, 70, counts, 15, "fail" if report.count("fail") else "ink")
    more = len(report.series) - MOST
    heading += f"; {more} more checks are in report.html" if more > 0 else ""
    canvas.text(GAP, 90, heading, 13, "muted")
    return canvas.done()


def _card(series: Series) -> Image.Image:
    canvas = _Canvas(CARD_W, CARD_H, "card")
    edge = canvas.k
    w, h = canvas.image.size
    canvas.pen.rectangle([0, 0, w - 1, h - 1], None, COLOURS["grid"], edge)
    canvas.text(16, 28, _fit(series.check or "(empty)", 28), 16, "ink")
    where = f"day {series.day}, " if series.day is not None else ""
    canvas.text(16, 47, _fit(where + series.metric, 40), 12, "muted")
    words = STATUS[series.status][1]
    canvas.text(CARD_W - 16, 28, words, 15, series.status, "rs")
    latest = value_of(series.rows[-1]) if series.rows else None
    best = "best" if series.threshold else "lowest"
    facts = [
        ("latest", plot.number(latest)),
        (best, plot.number(series.best)),
        ("runs", f"{len(series.rows):,}"),
        ("threshold", series.limits),
    ]
    for i, (name, value) in enumerate(facts):
        x = 16 + i * 96
        canvas.text(x, 70, name, 12, "muted")
        canvas.text(x, 89, value, 15, series.status if i == 0 else "ink")
    shapes = plot.draw(series)
    if not shapes:
        words = "no value to plot" if series.rows else "make its first row"
        canvas.text(CARD_W / 2, 180, words, 13, "muted", "ms")
    for shape in shapes:
        _draw(canvas, shape, 16, 98)
    return canvas.done()


def _draw(canvas: _Canvas, shape: plot.Shape, dx: float, dy: float) -> None:
    if isinstance(shape, plot.Words):
        place = (shape.x + dx, shape.y + dy)
        canvas.text(*place, shape.text, 11, shape.role, ANCHORS[shape.anchor])
    elif isinstance(shape, plot.Dot):
        place = (shape.x + dx, shape.y + dy)
        canvas.circle(*place, shape.radius, shape.role, shape.hollow)
    else:
        points = [(x + dx, y + dy) for x, y in shape.points]
        for part in _dashes(points) if shape.dashed else [points]:
            canvas.line(part, shape.role, 1)


def _dashes(points: list[tuple[float, float]]) -> list[list[tuple[float, float]]]:
    """Return a level line as dashes."""
    (x, y), (end, _) = points
    starts = range(int(x), int(end), 9)
    return [[(start, y), (min(start + 5, end), y)] for start in starts]


def _fit(text: str, most: int) -> str:
    return text if len(text) <= most else text[: most - 1] + "…"
