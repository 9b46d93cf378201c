"""HTML pages that need nothing else: the head, sections, tiles, tables, cards.

Every argument is HTML already: text of a log or of a student is escaped by then.
"""

import re
from collections.abc import Iterable

# Colours for light and dark, cards, tables, phones.
STYLE = """
:root { color-scheme: light dark; --paper: #f6f7f9; --card: #fff; --ink: #1b1f24;
  --muted: #5c6670; --grid: #e3e7eb; --line: #3467b4; --pass: #1a7f37;
  --fail: #c4232e; --limit: #8a5a00; }
@media (prefers-color-scheme: dark) { :root { --paper: #0f1317; --card: #181d23;
  --ink: #e6eaee; --muted: #98a3ae; --grid: #2a323a; --line: #78aaf5;
  --pass: #4cc26a; --fail: #ff7b72; --limit: #dfae55; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1240px; padding: 32px 20px 48px; color: var(--ink);
  background: var(--paper); font: 15px/1.45 system-ui, -apple-system, "Segoe UI",
  Roboto, "Noto Sans", "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums;
  overflow-wrap: anywhere; }
:where(a) { color: var(--line); }
h1 { margin: 0; font-size: 28px; letter-spacing: -.01em; }
h2 { margin: 36px 0 12px; font-size: 19px; }
p { margin: 4px 0; } .jumps { margin-top: 14px; } .muted { color: var(--muted); }
.tiles { display: grid; gap: 12px; margin-top: 20px;
  grid-template-columns: repeat(auto-fit, minmax(130px, 1fr)); }
.tile, .card { background: var(--card); border: 1px solid var(--grid);
  border-radius: 12px; padding: 14px 16px; }
.tile b { display: block; font-size: 26px; line-height: 1.2; }
.cards { display: grid; gap: 16px; align-items: start;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, 340px), 1fr)); }
.top { display: flex; flex-wrap: wrap; gap: 4px 10px;
  justify-content: space-between; align-items: start; }
.top h3, .card > h3 { margin: 0; font-size: 16px; }
.badge { flex: none; border: 1px solid; border-radius: 99px; padding: 1px 10px;
  font-size: 13px; font-weight: 600; white-space: nowrap; }
.pass { color: var(--pass); } .fail { color: var(--fail); }
.open, .none { color: var(--muted); }
dl { display: flex; flex-wrap: wrap; gap: 6px 14px; margin: 12px 0 8px;
  justify-content: space-between; } dl, dt, dd { white-space: nowrap; }
dt { color: var(--muted); font-size: 12px; } dd { margin: 0; font-weight: 600; }
svg { display: block; width: 100%; height: auto; font-size: 11px; }
details { margin-top: 6px; } summary { cursor: pointer; color: var(--muted);
  font-size: 13px; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: 13px;
  margin-top: 8px; min-width: 100%; }
th, td { text-align: left; vertical-align: top; padding: 4px 12px 4px 0;
  border-top: 1px solid var(--grid); } tr:first-child th { border-top: 0; }
th, td { white-space: nowrap; } th { color: var(--muted); font-weight: 500; }
td.note { white-space: normal; min-width: 150px; }
code { font: 12px/1.4 ui-monospace, Menlo, Consolas, "DejaVu Sans Mono", monospace; }
@media print { body { max-width: none; } .card { break-inside: avoid; } }
"""
_HEAD = """<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; \
style-src 'unsafe-inline'%s">
<meta name="viewport" content="width=device-width, initial-scale=1">"""
# Controls but for the line break, what turns the reading direction, half letters: no
# text that was quoted may bring them into a page.
_OBEYED = re.compile(
    "[\x00-\x09\x0b-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]"
)


def page(
    title: str,
    about: str,
    *parts: str,
    style: str = "",
    policy: str = "",
    meta: str = "",
) -> str:
    """Return a whole page: no script runs in it even if escaping failed somewhere.

    Args:
        title: of the window, and its heading.
        about: a line under the heading.
        parts: the rest.
        style: CSS of this page besides what all have.
        policy: what this page may load besides, "; script-src ...".
        meta: tags of its head besides.
    """
    whole = [
        _HEAD % policy,
        meta,
        f"<title>{title}</title><style>{STYLE}{style}</style></head><body>",
        f'<h1>{title}</h1><p class="muted">{about}</p>',
        *parts,
        "</body></html>\n",
    ]
    return _OBEYED.sub(" ", "\n".join(whole))


def section(heading: str, *parts: str, id: str = "") -> str:
    """Return a section under its heading; `id` is what a link leads to."""
    name = f' id="{id}"' if id else ""
    return f"<section{name}><h2>{heading}</h2>{''.join(parts)}</section>"


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
    """Return a table that scrolls sideways on a phone, and what stands below it.

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


def folded(summary: str, *parts: str, opened: bool = False) -> str:
    """Return what a click unfolds; `opened` is for what should be seen at once."""
    state = " open" if opened else ""
    return f"<details{state}><summary>{summary}</summary>{''.join(parts)}</details>"
