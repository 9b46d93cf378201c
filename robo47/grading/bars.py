"""Bar charts as inline SVG that need no script and fit any width.

Widths are in per cent and texts in pixels, so a chart on a phone has shorter bars and
not smaller letters.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

LINE, TEXT, BAR = 40, 13, 12  # pixels: a row's height, a letter's, a bar's


@dataclass(frozen=True)
class Row:
    """One row: a label, words at the right, and the bar below them.

    Attributes:
        label: at the left.
        words: at the right.
        parts: (role, number) from left to right; a role is a colour of the page.
        whole: the number that fills the width.
    """

    label: str
    words: str
    parts: Sequence[tuple[str, int]]
    whole: int


def chart(rows: Sequence[Row], about: str) -> str:
    """Return a chart as SVG.

    Args:
        rows: from top to bottom.
        about: what it shows, for those who cannot see it.
    """
    body = "".join(_row(row, i * LINE) for i, row in enumerate(rows))
    return (
        f'<svg class="bars" height="{len(rows) * LINE}" role="img"'
        f' aria-label="{escape(about)}">{body}</svg>'
    )


def _row(row: Row, top: int) -> str:
    base = top + TEXT
    bar = top + TEXT + 7
    shapes = [
        f'<text x="0" y="{base}" fill="var(--ink)">{escape(row.label)}</text>',
        f'<text x="100%" y="{base}" text-anchor="end" fill="var(--muted)">'
        f"{escape(row.words)}</text>",
        f'<rect x="0" y="{bar}" width="100%" height="{BAR}" fill="var(--grid)"/>',
    ]
    start = 0.0
    for role, number in row.parts:
        share = 100 * number / max(1, row.whole)
        if number:
            shapes.append(
                f'<rect x="{start:.2f}%" y="{bar}" width="{share:.2f}%" height="{BAR}"'
                f' fill="var(--{role})"><title>{escape(row.label)}: {number}</title>'
                "</rect>"
            )
        start += share
    return "".join(shapes)
