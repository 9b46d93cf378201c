"""Kinds of answers that are twists, points, counts, choices, paths or pixels."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from labkit.judge.answer_mistakes import general
from labkit.judge.answers import (
    capitalised,
    difference,
    gap,
    in_calls,
    listed,
    millimetres,
    say_error,
    say_mm,
)
from labkit.judge.kinds import NEAR, RIGHT, Kind, Scalar, array_of, one_factor
from labkit.judge.matrix_kinds import Matrix
from labkit.judge.mistake import Finding, Mistake
from robo47.checks import Array
from robo47.errors import Robo47Error


@dataclass(frozen=True)
class _Halves(Kind):
    """Six numbers in two halves: the first angular, the second linear."""

    shape: tuple[int, ...] = (6,)
    halves = ("first half", "second half")

    @property
    def expected(self) -> str:
        return f"six numbers ({'; '.join(self.halves)})"

    def general(self) -> Sequence[Mistake]:
        return general("halves-swapped", *self.usual, halves=self.halves)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:
        off = (gap(S, T) / self.scale).reshape(-1, 2, 3).max(axis=(0, 2))
        if found := one_factor(self, S, T):
            return found
        error = say_error(self.apart(S, T))
        yours = [x if x.startswith("the ") else f"your {x}" for x in self.halves]
        for i, slug in enumerate(("second-half-off", "first-half-off")):
            if off[i] <= RIGHT:
                right, wrong = yours[i], yours[1 - i]
                says = f"{capitalised(right)} is correct, but {wrong} is not. {error}"
                return Finding(slug, says)
        says = f"{capitalised(yours[0])} and {yours[1]} are both wrong."
        return Finding("both-halves-off", f"{says} {error}")


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
        count = self.shape[0]
        return "two vectors of 3 numbers" if count == 2 else f"{count} points"

    def why_shape(self, got: tuple[int, ...]) -> str:  # noqa: D102
        count = self.shape[0]
        return {
            (count, 4): "omit the fourth entry of each point",
            (count, 4, 4): "return only the translations",
            (count, 3, 1): "return vectors of shape (3,), not columns of shape (3, 1)",
        }.get(got, "")

    def apart(self, S: Array, T: Array) -> str:  # noqa: D102
        if not np.isfinite(S).all():
            return Kind.apart(self, S, T)
        found = say_mm(millimetres(S, T))
        return Kind.apart(self, S, T) if found == "0" else found

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        words = self._off(S, T)
        if len(words) == 2 and "0" in words:
            right, wrong = (1, 0) if words[1] == "0" else (0, 1)
            off = self.names[wrong]
            says = f"The {self.names[right]} is correct, but the {off} is not."
            return Finding(f"{off}-off", f"{says} {say_error(words[wrong])}")
        pairs = zip(words, self.names, strict=False)
        each = listed([f"{mm} for the {name}" for mm, name in pairs])
        every = "Both vectors" if len(words) == 2 else "All points"
        return Finding("both-off", f"{every} are wrong. {say_error(each)}")

    def measured(self, S: Array, T: Array) -> tuple[str, ...]:  # noqa: D102
        pairs = zip(self.names, self._off(S, T), strict=False)
        return (", ".join(f"{name} off by {mm}" for name, mm in pairs),)

    def _off(self, S: Array, T: Array) -> list[str]:
        return [say_mm(mm) for mm in millimetres(S, T).T]


@dataclass(frozen=True)
class Count(Scalar):
    """How many: one whole number."""

    whole = True
    empty = False
    expected = "a whole number"
    usual: ClassVar[tuple[str, ...]] = ()

    def _sent(self, answer: Array) -> Any:
        whole = np.isfinite(answer) and answer == np.round(answer)
        return int(answer) if whole else float(answer)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        odd = S[np.round(S) != S]
        if odd.size:
            says = f"Your function returned {odd[0]:g}; expected {self.expected}."
            return Finding("not-whole", says)
        i = int(np.argmax(S != T))
        says = f"Your function returned {S[i]:z.0f}; expected {T[i]:z.0f}."
        return Finding("miscounted", says)


@dataclass(frozen=True)
class Index(Count):
    """Which one: a whole number that counts places from 0."""

    expected = "an index"
    usual = ("counted-from-one", "one-too-small")

    def read(self, values: Sequence[object]) -> list[Array] | Finding:  # noqa: D102
        for value in values:
            one = isinstance(value, float | bool | np.generic | np.ndarray)
            array = np.asarray(value if one else 0)
            if array.ndim == 0 and array.dtype.kind not in "iu":
                says = f"Your function returns {value!r}; "
                says += f"expected {self.expected}. Only a whole number can index an "
                says += "array, so convert the result with int(...)."
                return Finding("not-an-index", says)
        return super().read(values)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        i = int(np.argmax(S != T))
        says = f"Your function returned {S[i]:z.0f}; "
        says += f"expected {T[i]:z.0f}, counted from 0."
        return Finding("another-one", says)


@dataclass(frozen=True)
class Word(Kind):
    """One word of several. `Word(words=("reached", "advanced", "trapped"))`."""

    words: tuple[str, ...] = ()
    single = True
    whole = True
    gap = "wrong in"
    empty = False
    usual = ()

    def __post_init__(self) -> None:
        """Refuse a choice of nothing."""
        super().__post_init__()
        if not isinstance(self.words, tuple) or len(self.words) < 2:
            raise Robo47Error('a Word says which there are: Word(words=("yes", "no"))')

    @property
    def expected(self) -> str:  # noqa: D102
        *first, last = map(repr, self.words)
        return f"{', '.join(first)} or {last}"

    def read(self, values: Sequence[object]) -> list[Array] | Finding:  # noqa: D102
        for value in values:
            known = isinstance(value, str) and value in self.words
            if not known and not (value is None and self.none):
                says = f"Your function returns {_briefly(value)}; "
                says += f"expected {self.expected}."
                return Finding("another-word", says)
        return [self.numbers(value) for value in values]

    def numbers(self, value: Any) -> Array:  # noqa: D102
        if value is None and self.none:
            return np.array(np.nan)
        there = isinstance(value, str) and value in self.words
        return np.array(float(self.words.index(value) if there else -1))

    def _sent(self, answer: Array) -> Any:
        place = int(answer) if np.isfinite(answer) else -1
        return self.words[place] if 0 <= place < len(self.words) else "?"

    def apart(self, S: Array, T: Array) -> str:  # noqa: D102
        return in_calls(int(np.sum(S != T)), len(S)).removeprefix("in ")

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        i = int(np.argmax(S != T))
        says = f"Your function returned {self.sent(S[i])!r}; "
        says += f"expected {self.sent(T[i])!r}."
        return Finding("the-other-word", says)


@dataclass(frozen=True)
class Mask(Kind):
    """True or False, one or many. `Mask((8,))`."""

    whole = True
    gap = "wrong in"
    empty = False
    usual = ("inverted",)

    @property
    def expected(self) -> str:  # noqa: D102
        free = None in self.shape
        where = f", in {array_of(self.shape) if free else f'shape {self.shape}'}"
        return f"True or False{where if self.shape else ''}"

    def _sent(self, answer: Array) -> Any:
        odd = np.any((answer != 0) & (answer != 1))
        found = np.asarray(answer if odd else answer == 1)
        return found if found.ndim else found.item()

    def apart(self, S: Array, T: Array) -> str:  # noqa: D102
        wrong = int(np.sum(S != T))
        if self.shape:
            return f"{wrong} of {np.size(T)} entries"
        return in_calls(wrong, np.size(T)).removeprefix("in ")

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        if (odd := S[(S != 0) & (S != 1)]).size:
            says = f"Your function returned {odd[0]:zg}; expected {self.expected}."
            return Finding("not-true-or-false", says)
        yes, no = int(np.sum((S == 1) & (T == 0))), int(np.sum((S == 0) & (T == 1)))
        where = ("entry", "entries") if self.shape else ("call", "calls")
        slug = "both-ways" if yes and no else f"too-{'often' if yes else 'seldom'}-true"
        parts = [
            f"{value} in {n:,} {where[n > 1]}; expected {not value}"
            for value, n in ((True, yes), (False, no))
            if n
        ]
        says = f"Your function returned {'. It returned '.join(parts)}."
        return Finding(slug, says)


@dataclass(frozen=True)
class Waypoints(Matrix):
    """A path of any length, a row per waypoint. `Waypoints((None, 7), "rad")`."""

    shape: tuple[int | None, ...] = (None, 7)

    @property
    def expected(self) -> str:  # noqa: D102
        return f"a path, with a row of {self.shape[1]} numbers per waypoint"

    def another_size(self, got: tuple[int, ...], right: tuple[int, ...]) -> str:  # noqa: D102
        if got[1:] != right[1:]:
            return super().another_size(got, right)
        return "Your path has the wrong number of waypoints"

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        off = gap(S, T) / self.scale > RIGHT
        first = int(np.argmax(off.any(axis=(0, 2))))
        says = f"The first wrong waypoint is waypoint {first}, counted from 0."
        says = says if first else "The path is wrong from its first waypoint on."
        return Finding("off", f"{says} {say_error(self.apart(S, T))}")


@dataclass(frozen=True)
class Pixels(Kind):
    """Where points are seen, (n, 2): x to the right, y down, in pixels."""

    shape: tuple[int | None, ...] = (None, 2)
    unit: str = "px"
    scale: float | Array = 100.0
    expected = "a pixel (x, y) per point"
    usual = ("row-first", "whole-numbers")

    def what_is_wrong(self, S: Array, T: Array) -> Finding:  # noqa: D102
        there = (S != 0).any(axis=-1) | (T != 0).any(axis=-1)  # no filling up
        off = (S - T)[there]
        if difference(off, off[:1]).max() < NEAR:
            x, y = off[0]
            says = f"Every pixel is off by the same ({x:z.3g}, {y:z.3g})."
            return Finding("shifted", says)
        return one_factor(self, S, T) or super().what_is_wrong(S, T)


def _briefly(value: Any) -> str:
    """Return what came for a word, in few words."""
    if isinstance(value, str | None):
        return repr(value)
    return f"an array of shape {np.shape(value)}" if np.shape(value) else f"{value!r}"
