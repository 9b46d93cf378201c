"""Hide, in a lab's output, the measured numbers that are still to be predicted.

The output is held until the lab ends, because a lab may print a number before it
reports it with `lab.measured`. Then each number that equals a hidden one, to the digits
printed, is replaced by the word (hidden). A line is about a hidden number if the
measurement follows it or if it has all words of the number's label; in such a line a
rounding to fewer digits is replaced as well. If the lab stops before it has measured
all that is hidden, every number is replaced, because any of them may be one. Headings
and failed checks stay as they are.
"""

import io
import math
import re
import sys
from bisect import bisect_right
from collections.abc import Collection, Iterator, Sequence
from typing import Any, NamedTuple

WORD = "(hidden)"
CLOSE = 0.15  # a number this close in the same line would reveal the hidden one
SURE = 3  # significant digits by which a number is recognised anywhere in the output
SCALES = (1.0, 1e3, 1e-3, 1e2)  # a unit, its thousandth, its thousand, and %
_NUMBER = re.compile(
    r"(?<![\w.,])[-+]?(\d+(?:,\d{3})*(?:\.(\d+))?)(?:e([-+]?\d+))?(?![.,]?\w)"
)
_HEADING = re.compile(r"(?m)^\d+\. ")
_OF = re.compile(r" of (\d+)\b")
_WORD = re.compile(r"[^\W\d_]+")


class HiddenNumber(NamedTuple):
    """A number that is still to be predicted."""

    value: float
    at: int  # the position in the output
    label: str = ""  # the first cell of its row in the worksheet

    def is_subject(self, line: str, end: int) -> bool:
        """Return whether a line of the output is about this number.

        Args:
            line: the line, whose numbers are indented.
            end: where it ends in the output.
        """
        words = set(_WORD.findall(self.label.lower()))
        named = bool(words) and words <= set(_WORD.findall(line.lower()))
        return named or (bool(self.label) and end == self.at)


class PrintedNumber(NamedTuple):
    """A number in a line of the output."""

    start: int
    end: int
    value: float  # without its sign
    minus: bool
    half: float  # half a unit of its last digit
    digits: int  # the number of significant digits
    whole: bool  # the number has no decimals
    part: float  # k / n, where the line has "k of n", else NaN

    @property
    def bare(self) -> bool:
        """The number has one or two digits and may be any count."""
        return self.whole and self.digits < SURE

    def is_of(self, value: float) -> bool:
        """Return whether it is this number, in its unit, in a thousandth, or in %.

        A short number with a minus is another number than a positive one.
        """
        if self.part == value:
            return True
        short = self.digits < SURE
        if short and (self._differs_in_sign(value) or self._is_count(value)):
            return False
        scales = (1.0,) if short or value.is_integer() else SCALES
        off = self._distance(value, scales)
        near = not short or off <= abs(value) / 20
        return near and off <= self.half * (1 + 1e-9)

    def rounds(self, value: float) -> bool:
        """Return whether it is this number, rounded to a few digits that are not 0."""
        if not self.digits or self._differs_in_sign(value):
            return False
        scales = (1.0,) if value.is_integer() else SCALES
        return self._distance(value, scales) <= self.half * (1 + 1e-9)

    def _differs_in_sign(self, value: float) -> bool:
        return self.minus and value > 0

    def _is_count(self, value: float) -> bool:
        return self.bare and not value.is_integer()  # 1 is another number than 0.97

    def _distance(self, value: float, scales: tuple[float, ...]) -> float:
        return min(abs(self.value - abs(value) * scale) for scale in scales)

    def tells(self, value: float) -> bool:
        """Return whether it is close to this number, as a formula's result would be."""
        if self.bare or self._differs_in_sign(value):
            return False
        return self._distance(value, (1.0,)) <= CLOSE * abs(value)


class Output(io.StringIO):
    """The output of a lab, held until `release`."""

    def __init__(self, asked: Collection[str]) -> None:
        """Hold what is printed from now on.

        Args:
            asked: the rows of the worksheet without a prediction, by their first cell.
        """
        super().__init__()
        self.asked = frozenset(asked)
        self._missing = set(asked)
        self._hidden: list[HiddenNumber] = []
        self._kept: set[str] = set()  # lines that say what is hidden
        self._before = sys.stdout, sys.breakpointhook
        self._holds = bool(asked)
        if asked:
            sys.stdout, sys.breakpointhook = self, self._debug

    def isatty(self) -> bool:
        """Return whether the lab's output is a terminal."""
        return self._before[0].isatty()

    def hide(self, number: str, value: float, says: str) -> None:
        """Hide a number, before and after this line, and print a line in its place."""
        self._missing.discard(number)
        rounded = float(f"{value:.12g}")
        self._hidden.append(HiddenNumber(rounded, self.tell(), number))
        self._kept.update(says.splitlines())
        print(says)

    def release(self, *, finished: bool = False) -> None:
        """Print what was held, without the hidden numbers; a second call does nothing.

        Args:
            finished: the lab has measured all that it measures.
        """
        if not self._holds:
            return
        self._holds = False
        sys.stdout, sys.breakpointhook = self._before
        every = bool(self._missing) and not finished
        text = without(self.getvalue(), self._hidden, self._kept, every=every)
        sys.stdout.write(text)
        sys.stdout.flush()

    def _debug(self, *args: Any, **kwargs: Any) -> Any:
        """Let a debugger print at once."""
        before = self._before[1]
        self.release()
        return before(*args, **kwargs)


def without(
    text: str,
    hidden: Sequence[HiddenNumber],
    kept: Collection[str] = (),
    *,
    every: bool = False,
) -> str:
    """Return a lab's output without the numbers that are hidden.

    A number of three digits is recognised in the whole output, a shorter one from the
    step that measures it to the end, and a zero in that step. In a line about a hidden
    number, each of its roundings is recognised.

    Args:
        text: the output.
        hidden: the numbers.
        kept: lines that stay as they are.
        every: hide all numbers.
    """
    steps = [found.start() for found in _HEADING.finditer(text)]
    begun = [(one.value, bisect_right(steps, one.at)) for one in hidden]
    lines = text.splitlines(keepends=True)
    known = {
        value
        for value, _ in begun
        for line in lines
        if line.startswith("  ") and line.rstrip() not in kept
        for one in _numbers(line)
        if one.digits >= SURE and one.is_of(value)
    }
    at = 0
    for i, line in enumerate(lines):
        step = bisect_right(steps, at)
        at += len(line)
        if line.startswith("  ") and "FAIL" not in line and line.rstrip() not in kept:
            short = [v for v, of in begun if (of <= step if v else of == step)]
            subjects = [one for one in hidden if one.is_subject(line, at)]
            lines[i] = _hide(line, known, short, subjects, every)
    return "".join(lines)


def _hide(
    line: str,
    known: set[float],
    short: list[float],
    subjects: list[HiddenNumber],
    every: bool,
) -> str:
    """Return a line without the hidden numbers, and without those that tell one."""
    numbers = list(_numbers(line))

    def is_of(one: PrintedNumber, value: float) -> bool:
        return one.is_of(value) and not (one.bare and value in known)

    found = {
        value
        for one in numbers
        for value in (known if one.digits >= SURE else short)
        if is_of(one, value)
    }
    rounded = [one for subject in subjects for one in _roundings(numbers, subject)]
    for one in reversed(numbers):
        if (
            every
            or one in rounded
            or any(is_of(one, value) or one.tells(value) for value in found)
        ):
            line = _replaced(line, one)
    return line


def _roundings(
    numbers: list[PrintedNumber], hidden: HiddenNumber
) -> list[PrintedNumber]:
    """Return the numbers of a line about a hidden number that are roundings of it.

    There are none if the line has the number with more digits. A number that is in the
    label, too, appears in the line first as itself.
    """
    if any(one.digits >= SURE and one.is_of(hidden.value) for one in numbers):
        return []
    found = [one for one in numbers if one.rounds(hidden.value)]
    named = [one for one in _numbers(hidden.label) if one.rounds(hidden.value)]
    return found[len(named) :] if len(found) > len(named) else found


def _replaced(line: str, one: PrintedNumber) -> str:
    """Return a line with the word in the place of a number; columns stay in line."""
    text = line[: one.start].rstrip(" ")
    gap = one.start - len(text)
    least = min(gap, 1 if text else 2)  # spaces that stay
    word = WORD.rjust(max(one.end - len(text), least + len(WORD)) if gap > 1 else 0)
    return text + (word if gap > 1 else " " * gap + WORD) + line[one.end :]


def _numbers(line: str) -> Iterator[PrintedNumber]:
    """Return the numbers of a line; not the n of "k of n", nor the 0 of "q = 0"."""
    for found in _NUMBER.finditer(line):
        mantissa, decimals, exponent = found[1].replace(",", ""), found[2], found[3]
        power = 10.0 ** int(exponent or 0)
        digits = len(mantissa.replace(".", "").lstrip("0"))
        if digits < SURE and line[: found.start()].endswith((" of ", "= ")):
            continue
        value = float(mantissa) * power
        whole = _OF.match(line, found.end())
        part = value / int(whole[1]) if whole and int(whole[1]) else math.nan
        half = 0.5 * power * 10.0 ** -len(decimals or "")
        minus = found.group().startswith("-")
        at = found.span()
        yield PrintedNumber(*at, value, minus, half, digits, not decimals, part)
