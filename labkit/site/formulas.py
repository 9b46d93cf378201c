"""Mistakes as formulas in the joint angles, for a page that cannot run Python.

A mistake of a day is run once on symbols q1 to q7: what NumPy multiplies and adds is
written down, one operation a line, and the page evaluates the lines at any q. So no
formula is written twice, and the page's poses are those of the day's own code.
"""

import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

import mujoco
import numpy as np

from labkit.base.exchange import Path
from labkit.judge.row import Row, Way, row_of
from labkit.lesson.day import Day, find_day
from labkit.lesson.lab_module import lab_of
from robo47 import checks
from robo47.errors import Robo47Error
from robo47.panda import READY_Q
from robo47.paths import ROOT, TWIN_XML

LISTED = ROOT / "site" / "ghosts.toml"  # rigid poses, each seen
JOINTS = 7
ON_LINES = {"+", "-", "*", "sin", "cos"}  # operations on earlier lines
Tape = dict[tuple, int]


class Symbol:
    """A number that is not known yet; NumPy takes it as an entry of an array.

    All of one tape, {operation: its line}: none stands there twice.
    """

    def __init__(self, tape: Tape, *operation: Any) -> None:
        self.tape = tape
        self.line = tape.setdefault(operation, len(tape))

    def _with(self, name: str, a: Any, b: Any) -> Any:
        if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
            return NotImplemented  # NumPy goes through the entries
        return Symbol(self.tape, name, *(number(self.tape, x) for x in (a, b)))

    def __add__(self, other: Any) -> Any:
        """Add; 0 changes nothing."""
        return self if _is(other, 0) else self._with("+", self, other)

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        """Subtract; 0 changes nothing."""
        return self if _is(other, 0) else self._with("-", self, other)

    def __rsub__(self, other: Any) -> Any:
        """Subtract from a number."""
        return self._with("-", other, self)

    def __mul__(self, other: Any) -> Any:
        """Multiply; 0 and 1 need no operation."""
        if _is(other, 0):
            return 0.0
        return self if _is(other, 1) else self._with("*", self, other)

    __rmul__ = __mul__

    def __neg__(self) -> Any:
        """Change the sign."""
        return self._with("*", -1.0, self)

    def sin(self) -> "Symbol":
        """Return the sine; `np.sin` calls this."""
        return Symbol(self.tape, "sin", self.line)

    def cos(self) -> "Symbol":
        """Return the cosine; `np.cos` calls this."""
        return Symbol(self.tape, "cos", self.line)

    def _unknown(self, *_: Any) -> "Symbol":
        """Stand for what no ghost needs, and a mistake beside its own makes."""
        return Symbol(self.tape, "?")

    __truediv__ = __rtruediv__ = _unknown


def number(tape: Tape, value: Any) -> int:
    """Return the line of a symbol, or of a plain number: a new one is written down."""
    if isinstance(value, Symbol):
        return value.line
    return tape.setdefault(("=", float(value)), len(tape))


def _is(value: Any, number: int) -> bool:
    return bool(np.isscalar(value)) and value == number


@contextmanager
def symbols_allowed() -> Iterator[None]:
    """Let NumPy's empty matrices and the library's checks take symbols."""
    eye, zeros = np.eye, np.zeros
    with (
        patch.object(np, "eye", lambda *a, **k: eye(*a, **k).astype(object)),
        patch.object(np, "zeros", lambda *a, **k: zeros(*a, **k).astype(object)),
        patch.object(checks, "array", lambda value, *_: np.asarray(value)),
    ):
        yield


def chosen() -> list[tuple[Day, Row, Way]]:
    """Return the day, the row and the mistake of each ghost."""
    found = []
    for one in tomllib.loads(LISTED.read_text("utf-8"))["ghosts"]:
        day = find_day(one["day"])
        name = one["function"]
        slug = one["slug"]
        row = row_of(day, name)
        ways = [way for way in row.named if way.slug == slug]
        if not ways:
            raise Robo47Error(f"day {day.number}: {name} has no mistake {slug!r} now")
        found.append((day, row, ways[0]))
    return found


def questions(day: Day, q: Any) -> dict[str, tuple]:
    """Return {frame: what a day's inspector asks the arm's function} at q, (7,)."""
    ghost = day.module("inspector").GHOST
    twin = mujoco.MjModel.from_xml_path(str(TWIN_XML))  # the page's robot
    asked = zip(ghost.frames, ghost.questions(twin, q), strict=True)
    return {
        frame: tuple(list(x.pairs) if isinstance(x, Path) else x for x in question)
        for frame, question in asked
        if frame != "link0"
    }


def tables() -> dict[str, Any]:
    """Return what the page reads: the lines, and per mistake its words and entries."""
    tape: Tape = {}
    q = np.array([Symbol(tape, "q", i) for i in range(JOINTS)], dtype=object)
    mistakes = list[dict[str, Any]]()
    for day, row, way in chosen():
        asked = questions(day, q)
        # A mistake of an argument is made with the lab's own: MuJoCo takes no symbols.
        own = getattr(lab_of(day), row.function)
        with symbols_allowed(), patch.object(row, "truth", own):
            drawn = {frame: way.code(*of) for frame, of in asked.items()}
        mistakes.append(
            {
                "day": day.number,
                "function": row.function,
                "slug": way.slug,
                "says": f"{way.says[0].upper()}{way.says[1:]}.",
                "frames": {
                    name: [number(tape, x) for x in T[:3].flat]
                    for name, T in drawn.items()
                },
            }
        )
    entries = [frame for one in mistakes for frame in one["frames"].values()]
    return {
        "ready": READY_Q.tolist(),
        "lines": _used(list(tape), entries),
        "mistakes": mistakes,
    }


def _used(lines: list[tuple], entries: list[list[int]]) -> list[tuple]:
    """Return the lines that some entries need, and number these anew, in place."""
    needed = {line for each in entries for line in each}
    for line in reversed(range(len(lines))):  # an operation is on earlier ones
        name, *of = lines[line]
        if line in needed and name in ON_LINES:
            needed.update(of)
    now = {line: i for i, line in enumerate(sorted(needed))}
    for each in entries:
        each[:] = [now[line] for line in each]
    return [
        (name, *(now[x] if name in ON_LINES else x for x in of))
        for name, *of in (lines[line] for line in now)
    ]
