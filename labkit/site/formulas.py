"""Mistakes as formulas in the joint angles, for a page that cannot run Python.

A mistake of a day is run once on symbols q1 to q7: what NumPy multiplies and adds is
written down, one operation a line, and the page evaluates the lines at any q. So no
formula is written twice, and the page's poses are those of the day's own code.
"""

import tomllib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any
from unittest.mock import patch

import mujoco
import numpy as np

from labkit.base.exchange import Path
from labkit.judge.row import Row, Way, row_of
from labkit.lesson.day import find_day
from labkit.lesson.script import lab_of
from robo47 import checks
from robo47.errors import Robo47Error
from robo47.panda import READY_Q
from robo47.paths import ROOT, TWIN_XML

LISTED = ROOT / "site" / "ghosts.toml"  # rigid poses, each seen
JOINTS = 7


class Tape:
    """Operations in the order in which they are done; none stands there twice."""

    def __init__(self) -> None:
        self.lines: list[tuple] = []
        self._known: dict[tuple, int] = {}
        self.q = np.array([Symbol(self, ("q", i)) for i in range(JOINTS)], dtype=object)

    def at(self, line: tuple) -> int:
        """Return the number of an operation's line."""
        if line not in self._known:
            self._known[line] = len(self.lines)
            self.lines.append(line)
        return self._known[line]

    def number(self, value: Any) -> int:
        """Return the line of a symbol, or of a plain number."""
        return value.line if isinstance(value, Symbol) else self.at(("=", float(value)))

    def used(self, ends: Iterable[int]) -> tuple[list[tuple], dict[int, int]]:
        """Return the lines that some lines need, and the new number of each."""
        needed, left = set(), [*ends]
        while left:
            if (line := left.pop()) not in needed:
                needed.add(line)
                left += self._of(line)
        now = {line: i for i, line in enumerate(sorted(needed))}
        lines = [self.lines[line] for line in now]
        return [(n, *(now[x] if n in _OF else x for x in of)) for n, *of in lines], now

    def _of(self, line: int) -> list[int]:
        name, *of = self.lines[line]
        return of if name in _OF else []


def run(lines: Iterable[Sequence], q: Sequence[float]) -> list[float]:
    """Return the value of every line at joint angles q, as the page does."""
    values: list[float] = []
    for name, *of in lines:
        values.append(_DO[name](values, q, *of))
    return values


_OF = {"+", "-", "*", "sin", "cos"}  # operations on earlier lines


_DO: dict[str, Any] = {
    "q": lambda v, q, i: float(q[i]),
    "=": lambda v, q, x: x,
    "+": lambda v, q, a, b: v[a] + v[b],
    "-": lambda v, q, a, b: v[a] - v[b],
    "*": lambda v, q, a, b: v[a] * v[b],
    "sin": lambda v, q, a: float(np.sin(v[a])),
    "cos": lambda v, q, a: float(np.cos(v[a])),
}


class Symbol:
    """A number that is not known yet; NumPy takes it as an entry of an array."""

    def __init__(self, tape: Tape, line: tuple) -> None:
        self.tape, self.line = tape, tape.at(line)

    def _with(self, name: str, a: Any, b: Any) -> Any:
        if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
            return NotImplemented  # NumPy goes through the entries
        return Symbol(self.tape, (name, self.tape.number(a), self.tape.number(b)))

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
        return Symbol(self.tape, ("sin", self.line))

    def cos(self) -> "Symbol":
        """Return the cosine; `np.cos` calls this."""
        return Symbol(self.tape, ("cos", self.line))

    def _unknown(self, *_: Any) -> "Symbol":
        """Stand for what no ghost needs, and a mistake beside its own makes."""
        return Symbol(self.tape, ("?",))

    __abs__ = __truediv__ = __rtruediv__ = __ge__ = __le__ = _unknown
    deg2rad = rad2deg = _unknown


def _is(value: Any, number: int) -> bool:
    return bool(np.isscalar(value)) and value == number


@contextmanager
def symbols_allowed() -> Iterator[None]:
    """Let NumPy's empty matrices and the library's checks take symbols."""
    eye, zeros = np.eye, np.zeros

    def as_it_is(value: Any, *_: Any) -> Any:
        return np.asarray(value)

    with ExitStack() as stack:
        for name, make in (("eye", eye), ("zeros", zeros)):
            made = lambda *a, make=make, **k: make(*a, **k).astype(object)  # noqa: E731
            stack.enter_context(patch.object(np, name, made))
        for name in ("array", "rotation", "pose", "unit_vector", "screws"):
            stack.enter_context(patch.object(checks, name, as_it_is))
        yield


def twin() -> mujoco.MjModel:
    """Return the page's robot, the kit's own Panda."""
    return mujoco.MjModel.from_xml_path(str(TWIN_XML))


def chosen() -> list[tuple[int, Row, Way]]:
    """Return the day, the row and the mistake of each ghost."""
    found = []
    for one in tomllib.loads(LISTED.read_text("utf-8"))["ghosts"]:
        number, function, slug = one["day"], one["function"], one["slug"]
        row = row_of(find_day(number), function)
        ways = [way for way in row.named if way.slug == slug]
        if not ways:
            raise Robo47Error(f"day {number}: {function} has no mistake {slug!r} now")
        found.append((number, row, ways[0]))
    return found


def questions(number: int, q: Any) -> dict[str, tuple]:
    """Return {frame: what a day's inspector asks the arm's function} at q, (7,)."""
    ghost = find_day(number).module("inspector").GHOST
    asked = zip(ghost.frames, ghost.questions(twin(), q), strict=True)
    return {
        frame: tuple(list(x.pairs) if isinstance(x, Path) else x for x in question)
        for frame, question in asked
        if frame != "link0"
    }


def tables() -> dict[str, Any]:
    """Return what the page reads: the lines, and per mistake its words and entries."""
    tape, mistakes = Tape(), list[dict[str, Any]]()
    for number, row, way in chosen():
        asked = questions(number, tape.q)
        # A mistake of an argument is made with the lab's own: MuJoCo takes no symbols.
        own = getattr(lab_of(find_day(number)), row.function)
        with symbols_allowed(), patch.object(row, "truth", own):
            drawn = {frame: way.code(*of) for frame, of in asked.items()}
        mistakes.append(
            {
                "day": number,
                "function": row.function,
                "slug": way.slug,
                "says": f"{way.says[0].upper()}{way.says[1:]}.",
                "frames": {
                    name: [tape.number(x) for x in T[:3].flat]
                    for name, T in drawn.items()
                },
            }
        )
    lines, now = tape.used(
        n for one in mistakes for frame in one["frames"].values() for n in frame
    )
    for one in mistakes:
        for frame in one["frames"].values():
            frame[:] = [now[n] for n in frame]
    return {"ready": READY_Q.tolist(), "lines": lines, "mistakes": mistakes}
