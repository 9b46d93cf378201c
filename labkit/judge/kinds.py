"""Kinds of answers: the words for what is expected, and for what is wrong with it.

The kind decides the words, not the shape: (2, 3) may be two points or a Jacobian. This
module has numbers and vectors; the others have all else. Arrays of
answers are stacked, (n, *shape); S is the student's, T the right one.
"""

import contextlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from labkit.base.text import count
from labkit.judge.answer_mistakes import general
from labkit.judge.answers import (
    MATCHES,
    as_real,
    capitalised,
    gap,
    in_calls,
    largest,
    listed,
    matches,
    say_error,
    say_factor,
    say_number,
)
from labkit.judge.mistake import Finding, Mistake
from robo47.checks import Array
from robo47.errors import Robo47Error

NEAR = 1e-4  # entries that differ by less are not called wrong
ROUNDED_AWAY = 1e12  # rounding divided by nothing: its digits are the processor's
DUST = 1e-9  # in units of the scale: what rounding leaves of a right answer
DIVERGES = 1e9  # times the right answer: how far off it is says nothing
RIGHT = 1e-6  # and those that differ by less are called right
# Of arrays that hold no real numbers, by the kind of their dtype.
OTHERS = {"U": "strings", "S": "bytes", "O": "objects", "c": "complex numbers"}
OF_UNITS = (1e3, 1e-3)  # factors that a unit with another prefix has


def array_of(shape: tuple[int | None, ...]) -> str:
    """Return an array in words; None is any size: "an array with 3 axes"."""
    if set(shape) == {None}:
        return "an array with " + (
            "1 axis" if len(shape) == 1 else f"{len(shape)} axes"
        )
    letters = iter("nmkl")
    sizes = [next(letters) if n is None else str(n) for n in shape]
    free = [size for size in sizes if size.isalpha()]
    told = f"({', '.join(sizes)}{',' * (len(sizes) == 1)})"
    return f"an array of shape {told}" + (f" with any {listed(free)}" if free else "")


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
    # What it means where the answer is None, "no way is free"; "" where it never is.
    none: str = field(default="", kw_only=True)
    single: ClassVar[bool] = False  # whether it has no shape
    whole: ClassVar[bool] = False  # whether equal numbers prove little: counts, choices
    gap: ClassVar[str] = "largest error:"  # said before how far answers are apart
    empty = True  # whether an answer that is all 0 looks like one that was never filled
    # Mistakes made with a finished answer, by their names in `answer_mistakes`.
    usual: ClassVar[tuple[str, ...]] = ("all-signs", "whole-numbers")
    # What wrong shapes come from; where none is known, an axis too many is told.
    misfits: ClassVar[Mapping[tuple[int, ...], str]] = {}

    def __post_init__(self) -> None:
        """Refuse a shape that is none: kinds begin with it, and "s" is a unit."""
        sizes = isinstance(self.shape, tuple) and all(
            n is None or (isinstance(n, int) and n >= 0) for n in self.shape
        )
        alone = type(self).single and self.shape != ()
        if sizes and not alone:
            return
        name = type(self).__name__
        remedy = (
            "is one value and has no shape"
            if alone
            else ("begins with its shape, a tuple such as (7,) or (None, 2)")
        )
        raise Robo47Error(
            f"{name}({self.shape!r}): a {name} {remedy}. Give the others by name: "
            f'{name}(unit="m"), scale=10.0, called="the distance"'
        )

    @property
    def expected(self) -> str:
        """What is expected, with its article: "a 4x4 matrix"."""
        return array_of(self.shape)

    def fits(self, shape: tuple[int, ...]) -> bool:
        """Return whether an answer may have a shape."""
        pairs = zip(shape, self.shape, strict=False)
        return len(shape) == len(self.shape) and all(n in (m, None) for m, n in pairs)

    def read(self, values: Sequence[object]) -> list[Array] | Finding:
        """Return answers as arrays, or what keeps one of them from it."""
        found = []
        for value in values:
            if value is None and self.none:
                found.append(self.numbers(None))
                continue
            if value is None or isinstance(value, str):
                says = f"Your function returns {value!r}; expected {self.expected}."
                slug = "not-an-array" if value else "nothing-returned"
                return Finding(slug, says)
            try:
                array = np.asarray(value)
            except ValueError:  # parts of different shapes
                says = f"Your function returns {_shapes(value)}"
                return Finding("shape", f"{says}; expected {self.expected}.")
            if array.dtype.kind not in "fiub":
                words = OTHERS.get(array.dtype.kind, f"dtype {array.dtype}")
                says = f"Your function returns an array of {words}; "
                says += f"expected real numbers ({self.expected})."
                return Finding("not-numbers", says)
            if not self.fits(array.shape):
                return self._misfit(array.shape, values)
            # A truth value is 0 or 1: NumPy subtracts none.
            found.append(self.plain(array.astype(np.float64)))
        return found

    def _misfit(self, got: tuple[int, ...], values: Sequence[Any]) -> Finding:
        expected = self.expected
        told = str(self.shape), "x".join(map(str, self.shape))
        if None not in self.shape and not any(one in expected for one in told):
            expected += f", shape {self.shape}"
        why = self.why_shape(got)
        why = f" {capitalised(why)}." if why else ""
        often = ""
        with contextlib.suppress(ValueError):  # one has parts of different shapes
            fit = sum(self.fits(np.asarray(value).shape) for value in values)
            often = f" in {len(values) - fit} of {len(values)} calls" if fit else ""
        what = f"an array of shape {got}" if got else "a single number"
        says = f"Your function returns {what}{often}; expected {expected}.{why}"
        return Finding("shape", says)

    def numbers(self, value: Any) -> Array:
        """Return a right or a mistaken answer as numbers; None is NaN."""
        if value is None and self.none:
            return np.full([n or 1 for n in self.shape], np.nan)
        return np.asarray(as_real(value), dtype=np.float64)

    def sent(self, answer: Array) -> Any:
        """Return such numbers as the function returns them."""
        return None if self.is_none(answer) else self._sent(answer)

    def is_none(self, answer: Array) -> bool:
        """Return whether such numbers stand for None."""
        return bool(self.none and answer.size and np.isnan(answer).all())

    def another_size(self, got: tuple[int, ...], right: tuple[int, ...]) -> str:
        """Return that some answers have not the size that their questions ask for.

        Args:
            got: the shape of the first.
            right: the right one, of as many axes or of others.
        """
        return "Your function returns an array of the wrong shape"

    def _sent(self, answer: Array) -> Any:
        return answer if np.ndim(answer) else float(answer)

    def plain(self, answer: Array) -> Array:
        """Return an answer without differences that make none.

        It is asked of the student's alone: right answers and those of mistakes have
        that form already.
        """
        return answer

    def why_shape(self, got: tuple[int, ...]) -> str:
        """Return what a wrong shape is likely to come from, or ""."""
        thicker = got in ((*self.shape, 1), (1, *self.shape)) and not self.misfits
        return (
            "your array has one axis too many" if thicker else self.misfits.get(got, "")
        )

    def general(self) -> Sequence[Mistake]:
        """Return mistakes made with a finished answer of this kind."""
        return general(*self.usual)

    def apart(self, S: Array, T: Array) -> str:
        """Return how far S is from T at worst, in words; "0" for rounding alone."""
        off = gap(S, T)
        scale = np.broadcast_to(self.scale, off.shape)
        at = np.unravel_index(np.argmax(off / scale), off.shape)
        if off[at] < DUST * scale[at]:
            return "0"
        if np.isinf(off[at]):  # or NaN
            return "infinite"
        one = self.unit and "," not in self.unit  # else that of each entry is another
        unit = f" {self.unit}" if one else ""
        digits = say_number(off[at]) if off[at] < ROUNDED_AWAY else "more than 1e+12"
        if off[at] < MATCHES * scale[at]:  # its further digits are rounding
            digits = f"{off[at]:.0e}"
        return f"{digits}{unit}"

    def diverges(self, S: Array, T: Array) -> str:
        """Return that S is larger than T by orders of magnitude, or "".

        Where that is so of some wrong answers alone, it is told how far off the others
        are.
        """
        usual = max(1.0, largest(T, self.scale))
        sizes = np.array([largest(s[None], self.scale) for s in S])
        far = sizes >= DIVERGES * usual
        if not far.any():
            return ""
        times = f"1e{np.floor(np.log10(sizes[far].min() / usual)):.0f}"
        off = (gap(S, T) / self.scale).reshape(len(T), -1).max(axis=1)
        says = f"The result is over {times} times as large as expected"
        if not np.any((off > RIGHT) & ~far):
            return f"{says}."
        others = (
            f"In the other calls, the largest error is {self.apart(S[~far], T[~far])}."
        )
        return f"{says} {in_calls(int(far.sum()), len(T))}. {others}"

    def largest_error(self, S: Array, T: Array) -> str:
        """Return how far S is from T at worst as a sentence: "Largest error: 2 m.".

        The number of a joint, say, has no distance: there wrong calls are counted.
        """
        if self.whole and self.gap == Kind.gap:
            wrong = (S != T).reshape(len(T), -1).any(axis=1)
            return f"The result is wrong {in_calls(int(np.sum(wrong)), len(T))}."
        apart = self.apart(S, T)
        if self.gap != Kind.gap:
            return f"The result is {self.gap} {apart}."
        return self.diverges(S, T) or say_error(apart)

    def what_is_wrong(self, S: Array, T: Array) -> Finding:
        """Return the most useful true thing about answers that no mistake gives.

        Where nothing but their size is known, the message is that of `say_error`.
        """
        return one_factor(self, S, T) or Finding("off", say_error(self.apart(S, T)))

    def measured(self, S: Array, T: Array) -> tuple[str, ...]:
        """Return lines for --explain."""
        return (f"{self.gap} {self.apart(S, T)}",)


def _shapes(value: Any) -> str:
    """Return what is in a list or tuple whose parts make no one array."""
    if isinstance(value, tuple):
        return f"a tuple of {count(len(value), 'result')}"
    try:
        shapes = listed([str(np.shape(part)) for part in value])
    except (TypeError, ValueError):  # a part is no array either
        return "a list whose parts have different lengths"
    return f"a list whose parts have the shapes {shapes}"


@dataclass(frozen=True)
class Scalar(Kind):
    """One number. `Scalar(unit="J", scale=10.0)`."""

    single = True
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
        if found := one_factor(self, S, T):
            return found
        wrong = gap(S, T) > RIGHT * self.scale
        off = wrong.any(axis=0)
        counted = [f"[{i}], counted from 0" for i in range(len(off))]
        empty = np.flatnonzero(off & ~S.any(axis=0))
        same = None not in self.shape  # else the shorter are filled up with 0
        if same and len(S) > 1 and 0 < len(empty) < len(off):
            where = _entries(self.names, counted, empty)
            says = (
                f"{capitalised(where)} {'are' if len(empty) > 1 else 'is'} 0 in every"
            )
            off_by = say_error(self.apart(S, T))
            return Finding("entries-empty", f"{says} call. {off_by}")
        if not _others_right(self, wrong, S, T):
            return Finding("off", say_error(self.apart(S, T)))
        if not same and _only_the_last(wrong, S, T):
            says = "All entries are correct except the last one."
            error = say_error(self.apart(S, T))
            return Finding("few-entries-off", f"{says} {error}")
        if not 0 < off.sum() <= (max(1, len(off) // 3) if same else 1):
            right = np.flatnonzero(~off & T.any(axis=0))
            only = _only(_entries(self.names, counted, right)) if len(right) else ""
            says = only if same and self.names and len(S) > 1 else ""
            return Finding("off", f"{says} {say_error(self.apart(S, T))}".strip())
        where = _entries(self.names, counted, np.flatnonzero(off))
        says = f"All entries are correct except {where}."
        return Finding("few-entries-off", f"{says} {say_error(self.apart(S, T))}")


def _only(names: str) -> str:
    """Return that some entries, and no others, are correct."""
    return f"Only {names} {'are' if ' and ' in names else 'is'} correct."


def _others_right(kind: Kind, wrong: Array, S: Array, T: Array) -> bool:
    """Return whether a wrong answer has an entry that is right.

    Of answers of several sizes the smaller ones are filled up with 0: these are none.
    """
    there = (S != 0) | (T != 0) if None in kind.shape else np.ones(S.shape, bool)
    bad = wrong.any(axis=tuple(range(1, wrong.ndim)))
    return bool(np.any(there[bad] & np.logical_not(wrong[bad])))


def _entries(names: Sequence[str], counted: Sequence[str], at: Any) -> str:
    """Return entries of a vector in words: "the entry for joint1", "the mass"."""
    if not names:
        return " and ".join(counted[i] for i in at)
    if all(names[i].startswith("the ") for i in at):
        return listed([names[i] for i in at])
    return (
        f"the entr{'y' if len(at) == 1 else 'ies'} for {listed([names[i] for i in at])}"
    )


def _only_the_last(wrong: Array, S: Array, T: Array) -> bool:
    """Return whether of vectors of several lengths only the last entry is wrong.

    Args:
        wrong: which entries are, (n, m).
        S: the student's; the shorter ones are filled up with 0, (n, m).
        T: the right ones.
    """
    there = (S != 0) | (T != 0)
    last = there.shape[1] - 1 - np.argmax(there[:, ::-1], axis=1)
    several = len(set(last[wrong.any(axis=1)].tolist())) > 1
    at_last = np.arange(S.shape[1]) == last[:, None]
    return bool(several and not (wrong & ~at_last).any())


def one_factor(kind: Kind, S: Array, T: Array) -> Finding | None:
    """Return that all entries are off by one and the same factor, if so."""
    size = float(np.sum(T * T))
    if size == 0.0:
        return None
    factor = float(np.sum(S * T)) / size
    plain = abs(factor) > 1e-6 and abs(factor - 1.0) > 1e-3
    if not plain or not matches(S, factor * T, kind.scale):
        return None
    which = "Every entry of the result" if S.ndim > 1 else "The result"
    says = f"{which} is {say_factor(factor)} times the correct value in every call."
    if kind.unit and any(np.isclose(factor, other) for other in OF_UNITS):
        says += (
            f" Is your result in another unit? The function should return {kind.unit}."
        )
    return Finding("one-factor-off", says)


def few_entries(
    kind: Kind, S: Array, T: Array, ignored: int | None = None
) -> Finding | None:
    """Return which entries are wrong if they are one or two, or one row or column.

    Args:
        kind: of the answers.
        S: the student's, (n, m, k).
        T: the right ones.
        ignored: a row and column that has a name of its own, such as a pose's last.
    """
    apart = gap(S, T)
    wrong = apart > RIGHT * kind.scale
    rows, columns = np.nonzero(wrong.any(axis=0))
    if not len(rows) or not _others_right(kind, wrong, S, T):
        return None
    sides = {"row": rows, "column": columns}
    one = {side: at[0] for side, at in sides.items() if len(set(at)) == 1}
    if ignored in one.values() and len(rows) > 1:
        return None
    if len(rows) <= 2:
        where = " and ".join(f"[{i}, {j}]" for i, j in zip(rows, columns, strict=True))
        where += ", counted from 0"
    elif one:
        side, k = next(iter(one.items()))
        names = getattr(kind, f"{side}s", ())
        where = names[k] if k < len(names) else f"{side} {k}, counted from 0"
    else:
        return None
    off = Kind.apart(kind, S, T)  # of entries, whatever the kind measures
    return few_told(where, wrong.reshape(len(S), -1), say_error(off))


def few_told(where: str, wrong: Array, error: str) -> Finding:
    """Return that only some entries are wrong.

    An advice to look at them follows where they are so nearly always; else it is the
    inputs that make the difference, and with others it may be other entries.

    Args:
        where: the entries, in words.
        wrong: which are wrong, (n, ...), per answer.
        error: the sentence on the largest error.
    """
    if 2 * wrong.any(axis=1).sum() < len(wrong):
        says = f"In every wrong call, all entries are correct except {where}."
        return Finding("few-entries-off", f"{says} {error}")
    says = f"All entries are correct except {where}. {error}"
    look = "Look for a wrong sign, variable or factor."
    return Finding("few-entries-off", f"{says} {look}")
