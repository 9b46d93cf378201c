"""Answers: made by a function, how far apart two sets of them are, inputs in words.

Sets of answers are stacked, (n, ...); a function that returns several has its parts.
"""

import contextlib
import re
from collections.abc import Callable, Iterable, Sequence, Set
from dataclasses import dataclass
from itertools import starmap
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robo47.checks import Array, pose_flaw, rotation_flaw

ERROR = "Largest error"  # with this the sentence on how far answers are off begins
# What begins with the symbol A, and not with the article.
OF_A_SYMBOL = ("a is ", "a has ", "a and ", "a should ", "a = ")
Parts = tuple[Array, ...]  # of answers: per result that the function returns, (n, ...)
MATCHES = 1e-5  # "this is the mistake": wide enough for a student's float32
KEPT = 64  # questions whose answers are kept
RIGID = 1e-5  # how far R R^T may be from I before we call it no rotation
# Words that are symbols of a formula; those of one letter but "a" are, too.
SYMBOLS = {"alpha", "beta", "dq", "dt", "ed", "fovy", "fx", "kd", "ki", "kp", "mu",
           "omega", "pi", "qd", "qdd", "sd", "sdd", "tau", "theta", "xi",
           "zeta"}  # fmt: skip


def gap(a: Array, b: Array) -> Array:
    """Return how far apart entries are, (n, ...); one NaN is inf."""
    with np.errstate(invalid="ignore"):
        alike = (a == b) | (np.isnan(a) & np.isnan(b))  # inf equals inf, NaN NaN
        apart = np.where(alike, 0.0, np.abs(a - b))
    return np.nan_to_num(apart, nan=np.inf, posinf=np.inf)


def difference(
    a: Array, b: Array, scale: float | Array = 1.0, rtol: float = 0.0
) -> Array:
    """Return the largest difference of any entry per case, (n,); one NaN is inf.

    Args:
        a: (n, ...).
        b: the same, or one case for all.
        scale: what it is measured in: a number, or an array with one for each entry.
        rtol: the share of b's largest entry that is no difference.
    """
    apart = gap(a, b)
    if rtol:
        sizes = np.where(np.isfinite(b), np.abs(b), 0.0).reshape(len(b), -1)
        free = rtol * sizes.max(axis=1, initial=0.0)
        apart = np.maximum(apart - free.reshape(-1, *[1] * (apart.ndim - 1)), 0.0)
    return (apart / scale).reshape(len(a), -1).max(axis=1, initial=0.0)


def matches(
    a: Array, b: Array, scale: float | Array = 1.0, within: float = MATCHES
) -> bool:
    """Return whether a is b at every case, within rounding of b's largest entry.

    Args:
        a: (n, ...).
        b: the same.
        scale: what an entry is like, where b's are all small; as in `difference`.
        within: which share of that entry is no difference.
    """
    if a.shape != b.shape:
        return False
    size = largest(b, scale)
    return bool(difference(a, b, scale).max(initial=0.0) <= within * max(1.0, size))


def largest(a: Array, scale: float | Array = 1.0) -> float:
    """Return the largest finite entry, in units of a scale."""
    sizes = np.abs(a / np.asarray(scale))
    return float(sizes[np.isfinite(sizes)].max(initial=0.0))


def as_real(value: Any) -> Any:
    """Return complex numbers as pairs of real ones, on the last axis; others as given.

    A question with complex arguments tests whether a function passes them through.
    """
    array = np.asarray(value)
    if array.dtype.kind != "c" or not array.ndim:
        return value
    return np.ascontiguousarray(array, dtype=np.complex128).view(np.float64)


def as_one(some: Sequence[ArrayLike]) -> Array:
    """Return arrays as one, (n, ...); smaller ones are filled up with zeros."""
    arrays = [np.asarray(as_real(one), dtype=np.float64) for one in some]
    sizes = zip(*(one.shape for one in arrays), strict=True)  # refuses other depths
    whole = np.zeros((len(arrays), *map(max, sizes)))
    for at, one in enumerate(arrays):
        place: tuple[Any, ...] = (at, *map(slice, one.shape))
        whole[place] = one
    return whole


def parts(answers: Any) -> Parts:
    """Return answers as a tuple of parts, also where there is one."""
    some = answers if isinstance(answers, tuple) else (answers,)
    return tuple(np.asarray(as_real(part), dtype=np.float64) for part in some)


def plain(some: Parts) -> Any:
    """Return answers as the function does: a tuple only where it has several parts."""
    return some[0] if len(some) == 1 else some


def gaps(kinds: Sequence[Any], S: Parts, T: Parts, rtol: float = 0.0) -> Array:
    """Return per call the largest difference of an entry, in units of its scale."""
    pairs = zip(map(as_one, zip(S, T, strict=True)), kinds, strict=True)
    each = [difference(s, t, kind.scale, rtol) for (s, t), kind in pairs]
    return np.max(each, axis=0)


def all_match(
    kinds: Sequence[Any], S: Parts, T: Parts, within: float = MATCHES
) -> bool:
    """Return whether answers have as many parts, and each part `matches`."""
    trios = zip(S, T, kinds, strict=False)
    return len(S) == len(T) and all(
        matches(s, t, kind.scale, within) for s, t, kind in trios
    )


def worst_part(kinds: Sequence[Any], S: Parts, T: Parts, near: float) -> int:
    """Return the first part of an answer that is wrong, or the one furthest off."""
    trios = zip(S, T, kinds, strict=True)
    off = [gaps([kind], (s,), (t,)).max() for s, t, kind in trios]
    return next((i for i, x in enumerate(off) if x > near), int(np.argmax(off)))


def rigid(M: Array) -> bool:
    """Return whether all of M, (n, 3, 3) or (n, 4, 4), are rotations or poses."""
    flaw = {(3, 3): rotation_flaw, (4, 4): pose_flaw}.get(M.shape[-2:])
    return bool(flaw and np.isfinite(M).all() and flaw(M, RIGID) is None)


class Several(tuple[Any, ...]):
    """A tuple of arrays as one argument: a data set, say.

    To NumPy it is one thing without a shape, as a robot is: nothing is done to its
    numbers to find a mistake. The student's function gets a plain tuple.
    """

    shape = ()
    ndim = 0

    @property
    def size(self) -> int:
        """How many numbers it holds."""
        return sum(map(np.size, self))

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        """Return an array of one object."""
        whole = np.empty(1, dtype=object)
        whole[0] = self
        return whole.reshape(())


def grouped(call: Iterable[Any]) -> tuple[Any, ...]:
    """Return the arguments of a call, each tuple of arrays as `Several`."""
    return tuple(Several(one) if _of_arrays(one) else one for one in call)


def _of_arrays(argument: Any) -> bool:
    plain = type(argument) is tuple
    return plain and any(isinstance(one, np.ndarray) for one in argument)


def own(argument: Any) -> Any:
    """Return a copy of an array or a number; a model or a path is as it is."""
    if _of_arrays(argument) or isinstance(argument, Several):
        return type(argument)(map(own, argument))
    plain = isinstance(argument, np.ndarray | np.generic)
    return np.copy(argument)[()] if plain else argument


def content(argument: Any) -> Any:
    """Return what two arguments share that are the same, to look it up."""
    if isinstance(argument, np.ndarray):
        return argument.shape, argument.dtype, argument.tobytes()
    if isinstance(argument, tuple):
        return tuple(map(content, argument))
    return repr(argument) if isinstance(argument, list) else argument


def once(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that keeps its answers to the last questions."""
    known: dict[Any, Any] = {}

    def keeping(*args: Any) -> Any:
        if (question := tuple(map(content, args))) not in known:
            if len(known) >= KEPT:
                known.clear()
            known[question] = function(*map(own, args))
        return known[question]

    return keeping


def entry_of(
    table: Callable[..., Any], slug: str, known: Set[str]
) -> Callable[..., Any]:
    """Return the function of one mistake of a table, which returns {slug: answer}."""

    def one(*args: Any) -> Any:
        if (answers := table(*args)).keys() != known:
            raise KeyError(*answers.keys() ^ known)
        if callable(answer := answers[slug]):  # made once, as the others are
            answer = answers[slug] = answer()
        return own(answer)

    return one


def _same(answer: Any) -> Any:
    return answer


@dataclass(frozen=True, eq=False)
class InTurn:
    """A function of one question's arguments as one of all, stacked."""

    function: Callable[..., Any]  # of one question, as a student writes it
    numbers: Callable[[Any], Any] = _same  # of an answer, as its kind takes it

    def __call__(self, *columns: Any) -> Any:
        """Return the answers to all questions, (n, ...), or a tuple of such.

        Args:
            columns: one per argument: (n, ...), or what all questions share. Without
            any (n, ...) there is one question.

        Raises:
            ValueError: the function has no answer to one of them.
        """
        answers = self.each(columns)
        if isinstance(answers[0], tuple):
            return tuple(map(as_one, zip(*answers, strict=True)))
        return as_one(answers)

    def each(self, columns: Sequence[Any]) -> list[Any]:
        """Return the answers one by one; every call gets arrays of its own."""
        calls = [
            [own(c[i]) if isinstance(c, np.ndarray) else c for c in columns]
            for i in range(_count(columns))
        ]
        try:
            return [self.numbers(self.function(*args)) for args in calls]
        except Exception as error:  # a mistake may stop, as a student's may
            raise ValueError(str(error)) from error

    def nth(self, i: int, columns: Sequence[Any]) -> Any:
        """Return the answer to one question."""
        one = [c[[i]] if isinstance(c, np.ndarray) else c for c in columns]
        return self.each(one)[0]


class AtOnce(InTurn):
    """A function of the library's, which takes all questions stacked where it can."""

    def each(self, columns: Sequence[Any]) -> list[Any]:
        """Return the answers one by one; the last tells whether stacks are taken."""
        if _count(columns) == 1:
            return super().each(columns)
        with contextlib.suppress(Exception):
            end = [c[-1:] if isinstance(c, np.ndarray) else c for c in columns]
            (last,) = super().each(end)
            whole = self.function(*map(own, columns))
            several = isinstance(whole, tuple)
            rows = zip(*whole, strict=True) if several else whole
            answers = list(map(self.numbers, rows))
            pairs = zip(parts(answers[-1]), parts(last), strict=True)
            if len(answers) == _count(columns) and all(starmap(np.array_equal, pairs)):
                return answers
        return super().each(columns)


def _count(columns: Sequence[Any]) -> int:
    """Return how many questions there are; one where nothing is stacked."""
    return next((len(c) for c in columns if isinstance(c, np.ndarray)), 1)


def millimetres(a: Array, b: Array) -> Array:
    """Return the distance of points, (..., 3) in metres, as (...) in millimetres."""
    return 1000.0 * np.linalg.norm(a - b, axis=-1)


def degrees(R_a: Array, R_b: Array) -> Array:
    """Return the angle between rotations, (..., 3, 3), as (...) in degrees.

    By atan2 from R's skew part and trace: exact near 0, where arccos is not.
    """
    R = R_a.mT @ R_b
    skew = R - R.mT
    sine = np.sqrt(np.sum(skew**2, axis=(-2, -1)) / 8.0)
    cosine = (np.trace(R, axis1=-2, axis2=-1) - 1.0) / 2.0
    return np.rad2deg(np.arctan2(sine, cosine))


def say_mm(mm: Array) -> str:
    """Return the largest of lengths in words; "0" for what rounding leaves."""
    return _say(mm, "mm", 1e-2)


def say_degrees(deg: Array) -> str:
    """Return the largest of angles in words; "0" for what rounding leaves."""
    return _say(deg, "deg", 1e-3)


def _say(values: Array, unit: str, least: float) -> str:
    if (value := np.max(values)) < least:
        return "0"
    if not 0.1 <= value < 1e5:
        return f"{value:.2g} {unit}"
    digits = 0 if value >= 200 else 1 if value >= 10 else 2
    return f"{value:.{digits}f} {unit}"


def say_number(x: float) -> str:
    """Return a number with three digits: "0.0123", "2300", "2.3e+05"."""
    return f"{float(f'{x:.3g}'):.0f}" if 1e3 <= abs(x) < 1e5 else f"{x:.3g}"


def of_result(says: str, called: str) -> str:
    """Return sentences on a result, with its name where there are several.

    Args:
        says: sentences; some are on "the result" or "your result".
        called: what the result is called, "the torque"; "" where it is the only one.
    """
    if not called:
        return says
    verb = is_or_are([called])
    if says.startswith(ERROR):
        return f"{capitalised(called)} {verb} wrong. {says}"

    def name(found: re.Match[str]) -> str:
        its = f"{called} {verb}" if found[1] else called
        return capitalised(its) if found[0][0].isupper() else its

    named = re.sub(r"\b(?:[Tt]he|[Yy]our) result( is)?\b", name, says)
    whole = named == says or says.startswith("Your function return")
    return f"For {called}, {as_clause(named)}" if whole else named


def say_error(off: str) -> str:
    """Return the sentence on the largest error, by how far off answers are in words.

    Every message has this one; a pose has two errors, of its two units.
    """
    error = ERROR.replace("error", "errors") if " and " in off else ERROR
    return f"{error}: {off}."


def say_factor(factor: float) -> str:
    """Return a factor as people write it: "1000", "-1", "pi / 180"."""
    named = {np.pi / 180: "pi / 180", 180 / np.pi: "180 / pi", 2 * np.pi: "2 pi"}
    for value, name in named.items():
        if np.isclose(factor, value, rtol=1e-6):
            return name
    return f"{factor:.4g}"


def say_range(values: Array, say: Callable[[Array], str]) -> str:
    """Return the least and the largest of values in words, once if they are alike."""
    least = say(values.min())
    most = say(values)
    return most if least == most else f"{least} to {most}"


def listed(words: Sequence[str]) -> str:
    """Return words as a list: "m, m cx and m cy"."""
    *before, last = words
    return f"{', '.join(before)} and {last}" if before else last


def is_or_are(names: Sequence[str]) -> str:
    """Return the verb of what results are called: "the levels are"."""
    head = re.split(r" (?:of|with|in|from|at) ", names[0])[0].split()[-1]
    one = len(names) == 1
    plural = head.islower() and re.search(r"[^aius]s$", head)
    return "is" if one and not plural else "are"


def in_calls(n: int, of: int, other: bool = False) -> str:
    """Return in how many calls something happens: "in 2 of 6 calls".

    Args:
        n: in so many.
        of: out of so many.
        other: whether something else was said of calls that are not among these.
    """
    if n < of:
        return f"in {n} of {'the other ' * other}{of} calls"
    if of == 1:
        return "in the other call" if other else "in the only call"
    if not other:
        return f"in all {of} calls"
    return "in the other two calls" if of == 2 else f"in all {of} other calls"


def as_clause(sentence: str) -> str:
    """Return a sentence as it goes on after a comma.

    A symbol that may be taken for a word, Lambda say, is in backticks.
    """
    clause = sentence[:1].lower() + sentence[1:]
    if sentence.startswith("True ") or clause.startswith(OF_A_SYMBOL):
        return sentence
    return clause if capitalised(clause) == sentence else sentence


def capitalised(clause: str) -> str:
    """Return a clause as a sentence starts; a symbol, qd say, stays what it is."""
    first = clause.partition(" ")[0].rstrip(",")
    letter = len(first) == 1 and first != "a"
    mixed = first[1:] != first[1:].lower()  # dY, as no word is written
    if letter or mixed or first in SYMBOLS or not first.isalpha():
        return clause
    return clause[0].upper() + clause[1:]
