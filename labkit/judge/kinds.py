"""Kinds of answers: the words for what is expected, and for what is wrong with it.

The kind decides the words, not the shape: (2, 3) may be two points or a Jacobian. This
module has numbers, vectors and points; `matrix_kinds` has matrices. Arrays of answers
are stacked, (n, *shape); S is the student's, T the right one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from labkit.judge.compare import (
    gap,
    matches,
    millimetres,
    say_factor,
    say_mm,
    say_value,
)
from labkit.judge.mistake import Finding, Mistake, capitalised
from robo47.checks import Array

NEAR = 1e-4  # entries that differ by less are not called wrong


def negated(answer: Array) -> Array:
    """Return the answer with every sign turned over."""
    return -answer


NEGATED = Mistake("all-signs", "every sign is wrong", negated, "its negative")
TRUNCATED = Mistake(
    "whole-numbers",
    "only whole numbers are left: an array of integers cuts off what is stored in it",
    np.trunc,
    "the right one cut to whole numbers",
)


@dataclass(frozen=True)
class Kind:
    """Any array of numbers; the base of the others."""

    # Of one answer; None is a size that the question decides.
    shape: tuple[int | None, ...] = ()
    unit: str = ""  # of its entries, "" where they have none
    # What an entry is like; errors are judged in units of it. An array, (m, n) say,
    # gives each entry a weight of its own.
    scale: Any = 1.0
    # What it is in a sentence, "the torque"; used where a tuple has several.
    called: str = ""
    empty = True  # whether an answer that is all 0 looks like one that was never filled

    @property
    def expected(self) -> str:
        """What is expected, with its article: "a 4x4 matrix"."""
        return f"an array of shape {self.shape}".replace("None", "any")

    def fits(self, shape: tuple[int, ...]) -> bool:
        """Return whether an answer may have a shape."""
        pairs = zip(shape, self.shape, strict=False)
        return len(shape) == len(self.shape) and all(n in (m, None) for m, n in pairs)

    def read(self, values: Sequence[object]) -> list[Array] | Finding:
        """Return answers as arrays, or what keeps one of them from it."""
        found = []
        for value in values:
            try:
                array = np.asarray(value)
            except ValueError:  # parts of different shapes
                some = value if isinstance(value, tuple | list) else ()
                shapes = ", ".join(str(np.shape(part)) for part in some)
                says = f"It returns parts of shapes {shapes}"
                return Finding("shape", f"{says}; expected is {self.expected}.")
            if array.dtype.kind not in "fiub":
                says = f"It returns {array.dtype} values; expected is {self.expected}"
                return Finding("not-numbers", f"{says} of real numbers.")
            if not self.fits(array.shape):
                return self._misfit(array.shape)
            found.append(self.plain(array))
        return found

    def _misfit(self, got: tuple[int, ...]) -> Finding:
        text = f"It returns shape {got}; expected is {self.expected}"
        if None not in self.shape and str(self.shape) not in text.partition(";")[2]:
            text += f", shape {self.shape}"
        reason = self.why_shape(got)
        return Finding("shape", f"{text}{f': {reason}' if reason else ''}.")

    def plain(self, answer: Array) -> Array:
        """Return an answer without differences that make none."""
        return answer

    def why_shape(self, got: tuple[int, ...]) -> str:
        """Return what a wrong shape is likely to come from, or ""."""
        thicker = got in ((*self.shape, 1), (1, *self.shape))
        return "it has one axis too many" if thicker else ""

    def general(self) -> Sequence[Mistake]:
        """Return mistakes made with a finished answer of this kind."""
        return (NEGATED, TRUNCATED)

    def apart(self, S: Array, T: Array) -> str:
        """Return how far S is from T at worst, in words; "0" for rounding."""
        off = gap(S, T)
        scale = np.broadcast_to(self.scale, off.shape)
        at = np.unravel_index(np.argmax(off / scale), off.shape)
        entry = " in one entry" if self.shape else ""
        return say_value(float(off[at]), self.unit, float(scale[at]), entry)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:
        """Return the most useful true thing about answers that no mistake gives."""
        return one_factor(self, S, T) or Finding(
            "off", f"It is not the right one: off by up to {self.apart(S, T)}."
        )

    def measured(self, S: Array, T: Array) -> tuple[str, ...]:
        """Return lines for --explain."""
        return (f"off by up to {self.apart(S, T)}",)


@dataclass(frozen=True)
class Scalar(Kind):
    """One number. `Scalar(unit="J", scale=10.0)`."""

    expected = "one number"


@dataclass(frozen=True)
class Vector(Kind):
    """A vector. `Vector((7,), "N m", names=JOINTS)`."""

    # Of its entries, "joint1" and so on; else they are counted from 0.
    names: tuple[str, ...] = ()

    @property
    def expected(self) -> str:  # noqa: D102
        return f"a vector of {self.shape[0]} numbers".replace(" of None numbers", "")

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        return (
            one_factor(self, S, T)
            or self._few(S, T)
            or Finding("off", f"It is off by up to {self.apart(S, T)}.")
        )

    def _few(self, S: Array, T: Array) -> Finding | None:
        off = np.abs(S - T).max(axis=0) > NEAR * self.scale
        if not 0 < off.sum() <= max(1, len(off) // 3):
            return None
        where = " and ".join(self.name(int(i)) for i in np.flatnonzero(off))
        return Finding(
            "few-entries-off",
            f"All entries are right but {where}: up to {self.apart(S, T)} off.",
        )

    def name(self, i: int) -> str:
        """Return what entry i is called."""
        return f"{self.names[i]}'s" if self.names else f"[{i}], counted from 0"


@dataclass(frozen=True)
class _Halves(Kind):
    """Six numbers in two halves: the first angular, the second linear."""

    shape: tuple[int, ...] = (6,)
    halves = ("first half", "second half")

    @property
    def expected(self) -> str:
        return f"six numbers ({'; '.join(self.halves)})"

    def general(self) -> Sequence[Mistake]:
        first, second = self.halves
        return (
            Mistake(
                "halves-swapped",
                f"the two halves are swapped: {first} comes first, then {second}",
                lambda answer: np.roll(answer, 3, axis=-1),
                "the right one with its halves swapped",
            ),
            NEGATED,
            TRUNCATED,
        )

    def what_is_wrong(self, S: Array, T: Array) -> Finding:
        off = (np.abs(S - T) / self.scale).reshape(-1, 2, 3).max(axis=(0, 2))
        if found := one_factor(self, S, T):
            return found
        for i, slug in enumerate(("second-half-off", "first-half-off")):
            if off[i] <= NEAR:
                says = f"{self.halves[i]} is right; {self.halves[1 - i]} is not: off by"
                return Finding(slug, f"{capitalised(says)} up to {self.apart(S, T)}.")
        says = f"{self.halves[0]} and {self.halves[1]} are both wrong: off by up to"
        return Finding("both-halves-off", f"{capitalised(says)} {self.apart(S, T)}.")


@dataclass(frozen=True)
class Twist(_Halves):
    """A twist or a screw axis, (omega; v)."""

    halves = ("omega", "v")


@dataclass(frozen=True)
class Wrench(_Halves):
    """A wrench, (moment; force)."""

    halves = ("moment", "force")


@dataclass(frozen=True)
class Points(Kind):
    """Points in metres, (m, 3), or a tuple of vectors. `Points((2, 3))`."""

    shape: tuple[int, ...] = (2, 3)
    unit: str = "m"
    # What each is called, "first" and so on.
    names: tuple[str, ...] = ("first", "second")

    @property
    def expected(self) -> str:  # noqa: D102
        return "two vectors of 3" if self.shape[0] == 2 else f"{self.shape[0]} points"

    def why_shape(self, got: tuple[int, ...]) -> str:  # noqa: D102
        count = self.shape[0]
        return {
            (count, 4): "leave the fourth entry of each point out",
            (count, 4, 4): "only the translations are asked for",
            (count, 3, 1): "columns of shape (3, 1) are not plain vectors",
        }.get(got, "")

    def apart(self, S: Array, T: Array) -> str:  # noqa: D102
        if not np.isfinite(S).all():
            return Kind.apart(self, S, T)
        return say_mm(float(millimetres(S, T).max()))

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        off = millimetres(S, T).max(axis=0)
        words = [say_mm(float(mm)) for mm in off]
        if len(off) == 2 and "0" in words:
            right, wrong = (1, 0) if words[1] == "0" else (0, 1)
            says = f"The {self.names[right]} is right; the {self.names[wrong]} is up to"
            return Finding(f"{self.names[wrong]}-off", f"{says} {words[wrong]} off.")
        each = ", ".join(
            f"{mm} the {name}" for mm, name in zip(words, self.names, strict=False)
        )
        every = "Both" if len(off) == 2 else "All"
        return Finding("both-off", f"{every} are wrong: off by up to {each}.")

    def measured(self, S: Array, T: Array) -> tuple[str, ...]:  # noqa: D102
        off = [say_mm(float(mm)) for mm in millimetres(S, T).max(axis=0)]
        pairs = zip(self.names, off, strict=False)
        return (", ".join(f"{name} off by {mm}" for name, mm in pairs),)


def one_factor(kind: Kind, S: Array, T: Array) -> Finding | None:
    """Return that all entries are off by one and the same factor, if so."""
    size = float(np.sum(T * T))
    if size == 0.0:
        return None
    factor = float(np.sum(S * T)) / size
    plain = abs(factor) > 1e-6 and abs(factor - 1.0) > 1e-3
    if not plain or not matches(S, factor * T, kind.scale):
        return None
    return Finding(
        "one-factor-off",
        f"It is {say_factor(factor)} times the right one, in every entry and every "
        "time.",
    )
