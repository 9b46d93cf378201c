"""Hide, in a lab's output, the measured numbers that are still to be predicted.

The output is held until the lab ends, because a lab may print a number before it
reports it with `lab.measured`. Then each number that equals a hidden one, to the digits
printed, is replaced by the word (hidden). If the lab stops before it has measured all
that is hidden, every number is replaced, because any of them may be one. Headings and
failed checks stay as they are.
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
_NUMBER = re.compile(
    r"(?<![\w.,])[-+]?(\d+(?:,\d{3})*(?:\.(\d+))?)(?:e([-+]?\d+))?(?![.,]?\w)"
)
_HEADING = re.compile(r"(?m)^\d+\. ")
_OF = re.compile(r" of (\d+)\b")


class HiddenNumber(NamedTuple):
    """A number that is still to be predicted."""

    value: float
    at: int  # the position in the output


class PrintedNumber(NamedTuple):
    """A number in a line of the output."""

    start: int
    end: int
    value: float
    half: float  # half a unit of its last digit
    digits: int  # the number of significant digits
    whole: bool  # the number has no decimals
    part: float  # k / n, where the line has "k of n", else NaN

    @property
    def bare(self) -> bool:
        """The number has one or two digits and may be any count."""
        return self.whole and self.digits < SURE

    def is_of(self, value: float) -> bool:
        """Return whether it is this number, in its unit, in a thousandth, or in %."""
        if self.part == value:
            return True
        if self.bare and not value.is_integer():
            return False  # 1 is another number than 0.97
        others = self.digits >= SURE and not value.is_integer()
        scales = (1.0, 1e3, 1e-3, 1e2) if others else (1.0,)
        off = min(abs(self.value - value * scale) for scale in scales)
        near = self.digits >= SURE or off <= value / 20
        return near and off <= self.half * (1 + 1e-9)

    def tells(self, value: float) -> bool:
        """Return whether it is close to this number, as a formula's result would be."""
        return not self.bare and abs(self.value - value) <= CLOSE * value


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
        self._hidden.append(HiddenNumber(float(f"{abs(value):.12g}"), self.tell()))
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
    step that measures it to the end, and a zero in that step.

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
            short = [v for v, at in begun if (at <= step if v else at == step)]
            lines[i] = _hide(line, known, short, every)
    return "".join(lines)


def _hide(line: str, known: set[float], short: list[float], every: bool) -> str:
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
    for one in reversed(numbers):
        if every or any(is_of(one, value) or one.tells(value) for value in found):
            line = _replaced(line, one)
    return line


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
        yield PrintedNumber(*found.span(), value, half, digits, not decimals, part)
