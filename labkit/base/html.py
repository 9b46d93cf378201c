"""HTML pages that need nothing else: the head, sections, tiles, tables, cards.

Every argument is HTML already: text of a log or of a student is escaped by then.
"""

from collections.abc import Iterable

_HEAD = """<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; \
style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">"""


def page(title: str, style: str, about: str, *parts: str) -> str:
    """Return a whole page: no script runs in it even if escaping failed somewhere.

    Args:
        title: of the window, and its heading.
        style: CSS.
        about: a line under the heading.
        parts: the rest.
    """
    return "\n".join(
        [
            _HEAD,
            f"<title>{title}</title><style>{style}</style></head><body>",
            f'<h1>{title}</h1><p class="muted">{about}</p>',
            *parts,
            "</body></html>\n",
        ]
    )


def section(heading: str, *parts: str) -> str:
    """Return a section under its heading."""
    return f"<section><h2>{heading}</h2>{''.join(parts)}</section>"


def tiles(cells: Iterable[tuple[str, str, str]]) -> str:
    """Return the numbers at a page's top; each: its colour's class, it, what it is."""
    inner = "".join(
        f'<div class="tile"><b class="{role}">{number}</b>'
        f'<span class="muted">{label}</span></div>'
        for role, number, label in cells
    )
    return f'<div class="tiles">{inner}</div>'


def table(
    head: str, rows: Iterable[str], kind: str = "card scroll", below: str = ""
) -> str:
    """Return a table that scrolls sideways on a phone.

    Args:
        head: cells of its first row.
        rows: the others, each a <tr>.
        kind: classes of the box around it.
        below: what the box holds besides.
    """
    inner = "".join(rows)
    return f'<div class="{kind}"><table><tr>{head}</tr>{inner}</table>{below}</div>'


def card(heading: str, *parts: str) -> str:
    """Return a box under its heading."""
    return f'<div class="card"><h3>{heading}</h3>{"".join(parts)}</div>'


def folded(summary: str, *parts: str) -> str:
    """Return what a click unfolds."""
    return f"<details><summary>{summary}</summary>{''.join(parts)}</details>"
