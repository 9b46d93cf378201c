"""Looks of the class's page: colours, marks, and bars as inline SVG of any width.

The words of a row are HTML above its bar, so a long label takes a second line and does
not overlap the words at the right. Widths are in per cent, so a chart on a phone has
shorter bars and not smaller letters. No script is needed.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape

STATUS = {  # role of the colour, mark in the table, word in the legend
    "passed": ("pass", "✓", "passed"),
    "close": ("limit", "≈", "close"),
    "wrong": ("fail", "✗", "wrong"),
    "todo": ("none", "·", "to do"),
    "does not load": ("broken", "!", "does not load"),
    "ungraded": ("dark", "?", "not graded"),
}
# Bars differ in lightness too, for those who do not tell red from green.
STYLE = """
:root { --none: #b9c2cb; --dark: #4a525b; --broken: #7a4fa3; --bar-pass: #14602f;
  --bar-fail: #f28b7d; --bar-limit: #d8a53c; }
@media (prefers-color-scheme: dark) { :root { --none: #4a5560; --dark: #b9c2cb;
  --broken: #b48be0; --bar-pass: #1f7a42; --bar-fail: #ffb4a8; --bar-limit: #dfae55; } }
body { max-width: 1080px; } .none { color: var(--muted); }
.limit { color: var(--limit); } .dark { color: var(--dark); }
.broken { color: var(--broken); } a { color: inherit; }
.two { display: grid; gap: 16px; align-items: start;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); }
.card h3 { margin: 0 0 4px; font-size: 16px; } .card > .muted { margin-bottom: 12px; }
.bar { margin-top: 9px; font-size: 13px; }
.bar p { display: flex; gap: 12px; justify-content: space-between; align-items: end;
  margin: 0 0 4px; } .bar p .muted { flex: none; }
.legend span { margin-right: 14px; white-space: nowrap; font-size: 13px; }
.legend i { display: inline-block; width: 10px; height: 10px; margin-right: 5px;
  border-radius: 2px; }
ul { list-style: none; margin: 0; padding: 0; }
li { padding: 10px 0; border-top: 1px solid var(--grid); } li:first-child { border: 0; }
li .head { display: flex; flex-wrap: wrap; gap: 4px 12px; align-items: baseline; }
li .head > .muted { margin-left: auto; font-size: 13px; } li p { margin-top: 3px; }
.says { white-space: pre-line; } details { margin: 0; padding: 7px 0; }
details + details { border-top: 1px solid var(--grid); }
summary { color: var(--ink); font-size: 14px; } details p { margin: 6px 0 4px 16px; }
td.mark, th.mark { text-align: center; padding-right: 8px; }
.all { max-height: 80vh; overflow: auto; } .all tr:first-child th { position: sticky;
  top: -14px; background: var(--card); z-index: 1; }
.all td:first-child { position: sticky; left: -16px; background: var(--card); }
.wider { display: none; }
@media (max-width: 560px) { li .head > .muted { margin-left: 0; flex-basis: 100%; }
  .wider { display: block; }
  td:first-child { max-width: 130px; overflow: hidden; text-overflow: ellipsis; } }
h2 small { color: var(--muted); font-weight: 400; }
"""
BAR = 12  # the height of a bar in pixels


@dataclass(frozen=True)
class Row:
    """One row: a label, words at the right, and the bar below them."""

    label: str
    words: str
    # (role, number) from left to right; a role is a colour of the page.
    parts: Sequence[tuple[str, int]]
    whole: int  # the number that fills the width


def chart(rows: Sequence[Row], about: str) -> str:
    """Return a chart as HTML: a list of labelled bars.

    Args:
        rows: from top to bottom.
        about: what it shows, for those who cannot see it.
    """
    body = "".join(map(_row, rows))
    return f'<div role="list" aria-label="{escape(about)}">{body}</div>'


def legend(words: Iterable[tuple[str, str]]) -> str:
    """Return what the colours of a chart mean: each a role, and its word."""
    marks = "".join(
        f'<span><i style="background:{colour(role)}"></i>{word}</span>'
        for role, word in words
    )
    return f'<p class="legend muted">{marks}</p>'


def colour(role: str) -> str:
    """Return a bar's colour for a role of the page."""
    own = role in ("pass", "fail", "limit")
    return f"var(--bar-{role})" if own else f"var(--{role})"


def _row(row: Row) -> str:
    shapes = [f'<rect width="100%" height="{BAR}" fill="var(--grid)"/>']
    start = 0.0
    for role, number in row.parts:
        share = 100 * number / max(1, row.whole)
        if number:
            shapes.append(
                f'<rect x="{start:.2f}%" width="{share:.2f}%" height="{BAR}"'
                f' fill="{colour(role)}" stroke="var(--card)">'
                f"<title>{escape(row.label)}: {number}</title></rect>"
            )
        start += share
    return (
        f'<div role="listitem" class="bar"><p><span>{escape(row.label)}</span>'
        f'<span class="muted">{escape(row.words)}</span></p>'
        f'<svg height="{BAR}" aria-hidden="true">{"".join(shapes)}</svg></div>'
    )
