"""Numbers as HTML for the panel: aligned, in one type width, readable without colour.

A matrix has its columns named x, y, z (the frame's axes in the world) and p (where its
origin is); the colours are those of the triad. The style is in `client.css`. A key is
unique in the page, for who looks a line or a matrix up there.
"""

import json
import re
from collections.abc import Iterable, Mapping
from html import escape

import numpy as np
from numpy.typing import NDArray

from labkit.inspector.arm import AGREES, Arm
from labkit.inspector.ghost import Seen
from robo47.checks import Array

COLUMNS = "xyzp"
SIGNS = {"good": "✓ ", "bad": "✗ "}


def matrix(
    name: str,
    T: Array,
    key: str,
    marked: NDArray[np.bool_] | None = None,
    mark: str = "off",
) -> str:
    """Return a pose, or any other matrix, as an aligned block under its name.

    Args:
        name: such as "T_world_ee".
        T: (4, 4); another one, (m, n), has no colours and no names of columns.
        key: as above.
        marked: entries to mark, of the same shape, of bool.
        mark: how: "off" for wrong ones, "moves" for what q changes.
    """
    off = np.zeros(T.shape, dtype=bool) if marked is None else marked
    columns = COLUMNS if T.shape == (4, 4) else [""] * T.shape[1]
    head = "".join(f'<span class="{c} head">{c:>10}</span>' for c in columns)
    rows = "\n".join(
        "".join(
            _entry(x, column, mark if bad else "")
            for x, column, bad in zip(row, columns, some, strict=True)
        )
        for row, some in zip(T, off, strict=True)
    )
    top = f'<pre aria-hidden="true">{head}</pre>' if T.shape == (4, 4) else ""
    return (
        f'<div class="r47-matrix"><b>{escape(name)}</b>{top}'
        f'<pre data-matrix="{escape(key)}">{rows}</pre></div>'
    )


def _entry(value: float, column: str, mark: str) -> str:
    """Return one number, 10 wide; the mark covers the number alone."""
    text = f"{value:z.6f}" if np.isfinite(value) else "?"
    space = " " * (10 - len(text))
    return f'{space}<span class="{f"{column} {mark}".strip()}">{text}</span>'


def line(text: str, key: str, kind: str = "") -> str:
    """Return one line of text; the kind is "", good, bad, quiet or asking."""
    if not text:
        return ""
    style = f" r47-{kind}" if kind else ""
    return f'<div class="r47{style}" data-line="{escape(key)}">{escape(text)}</div>'


def table(head: Iterable[str], rows: Iterable[tuple[Iterable[str], str]]) -> str:
    """Return a table: the names of the columns, and (cells, kind as of `line`)."""
    top = "".join(f"<th>{escape(name)}</th>" for name in head)
    made = "".join(
        f'<tr class="r47-{kind}">'
        + "".join(f"<td>{escape(cell)}</td>" for cell in cells)
        + "</tr>"
        for cells, kind in rows
    )
    return f'<table class="r47 r47-table"><tr>{top}</tr>{made}</table>'


def judged(text: str, key: str, kind: str) -> str:
    """Return a line that stands out, see `line`; good and bad ones with their sign.

    It has the height of two lines or more: a longer text makes it grow.
    """
    if not text:
        return ""
    return (
        f'<div class="r47 r47-said r47-{kind}" data-line="{escape(key)}" role="status" '
        f'tabindex="0">{SIGNS.get(kind, "")}{escape(text)}</div>'
    )


def card(title: str, count: str, sentence: str, kind: str) -> str:
    """Return the checker's verdict as a card over the scene; "" without a sentence.

    Args:
        title: the task and its function.
        count: how many tasks pass, for the corner.
        sentence: the whole verdict; what stands between backticks is set as code.
        kind: as that of `line`.
    """
    if not sentence:
        return ""
    code = re.sub("`([^`]+)`", r"<code>\1</code>", escape(sentence))
    return (
        f'<div class="r47 r47-said r47-card r47-{kind}" data-line="standing" '
        f'role="status" tabindex="0"><div><b>{SIGNS.get(kind, "")}{escape(title)}</b> '
        f"<span>{escape(count)}</span></div><div>{code}</div></div>"
    )


def digits(value: float, count: int = 3) -> str:
    """Return a number with so many digits, a large one without a power of ten."""
    rounded = float(f"{value:.{count - 1}e}")
    large = 10**count <= abs(rounded) < 1e9
    return f"{rounded:,.0f}" if large else f"{value:.{count}g}"


def verdict(difference: float, whose: str) -> str:
    """Return how far someone's pose is from MuJoCo's, by the largest of any entry.

    The library's is no news, whatever it is: green is only what is the student's.
    """
    agrees = difference < AGREES
    sign, end = ("✓", "they agree") if agrees else ("✗", "THEY DIFFER")
    text = f"{sign} {whose}: largest difference {difference:.1e}, {end}"
    if whose != "yours" and agrees:
        return line(text.removeprefix("✓ "), "difference", "quiet")
    return line(text, "difference", "good" if agrees else "bad")


def proof(arm: Arm, name: str, seen: Seen, asked: bool) -> str:
    """Return a frame's pose from MuJoCo, and from what the student's function said.

    Where their function is asked for the frame, but has no answer, none stands there;
    where it is not, or there is none yet, the library's does, by its name.
    """
    truth = matrix(f"T_world_{name}, MuJoCo", arm.pose(name), "mujoco")
    if asked and name not in seen.poses and seen.kind in ("asking", "bad"):
        why = "asking ..." if seen.kind == "asking" else "yours: no answer"
        none = matrix(f"T_world_{name}, YOURS", np.full((4, 4), np.nan), "yours")
        return truth + none + line(why, "difference", seen.kind)
    if name not in seen.poses:
        library = arm.by_library[name]
        pose = matrix(f"T_world_{name}, robo47.kinematics", library, "library")
        return truth + pose + verdict(arm.difference(name, library), "the library")
    yours = seen.poses[name]
    apart = np.abs(yours - seen.truth[name])
    pose = matrix(f"T_world_{name}, YOURS", yours, "yours", ~(apart < AGREES))
    return truth + pose + verdict(float(apart.max()), "yours")


def limits(arm: Arm) -> str:
    """Return a warning where the configuration is out of limits, else nothing."""
    broken = "; ".join(arm.out_of_limits())
    text = f"OUT OF LIMITS: {broken}. The real arm cannot go there."
    return line(text if broken else "", "limits", "bad")


def tab_row(names: Iterable[str], chosen: str) -> str:
    """Return the row of tabs, one of them open; a click sends the address of the tab.

    viser's own tabs tell the server nothing, and the server cannot open one.
    """
    made = "".join(
        f'<button type="button" role="tab" data-r47-go="?tab={escape(name)}" '
        f'aria-selected="{str(name == chosen).lower()}">{escape(name)}</button>'
        for name in names
    )
    return f'<div class="r47-tabs" role="tablist">{made}</div>'


def copy_button(label: str, value: Array) -> str:
    """Return a button that copies numbers as NumPy reads them, every digit of them."""
    text = repr(value.tolist())
    if value.ndim > 1:  # one row a line
        rows = ",\n    ".join(map(repr, value.tolist()))
        text = f"[\n    {rows},\n]"
    text = f"np.array({text})"
    return (
        f'<button type="button" class="r47-copy" data-r47-copy="{escape(text)}">'
        f"{escape(label)}</button>"
    )


def state(address: str, heard: int) -> str:
    """Return the hidden element that tells every browser the page's query, "?q=...".

    It knows of the word from a browser with that number, and of those before.
    """
    told = escape(json.dumps({"address": address, "heard": heard}))
    return f'<div hidden data-r47-state="{told}"></div>'


def legend(colours: Mapping[str, tuple[int, int, int]], where: str = "") -> str:
    """Return what colours mean, {what is drawn: its colour}.

    With "stage" it stands over the scene, else where it is made.
    """
    made = "".join(
        f'<span><i style="background:rgb{rgb}"></i>{escape(what)}</span>'
        for what, rgb in colours.items()
    )
    kind = f"r47 r47-legend r47-{where}" if where else "r47 r47-legend"
    return f'<div class="{kind}" data-line="legend">{made}</div>' if made else ""
