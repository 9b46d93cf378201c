"""A mistake that has a name, and the verdict that says so."""

import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from robo47.checks import Array

REDONE = "the reference solution with this mistake"
BOTH = "the reference solution with both mistakes"
# What an answer is called in the catalogue that is no noun: "with min", "upside down".
_FORMULA = re.compile(r"with(out)? ")
_FRAGMENT = re.compile(
    r"(after|at|by|cut|divided|down|for|from|halved|in|less|minus|rounded|squared"
    r"|times|turned|up|upside|where|[+*/])\b ?|[+*/] "
)
# A name that only the sentence before it explains: "the correct result with that sign".
_POINTS_BACK = re.compile(
    r"\bthat (?!is\b|are\b)|\b(these|those)\b(?! above)|^this \w+$|\bwithout it\b"
)
_OF_BOTH = re.compile(r"\bwith both( mistakes)?$")
_ITS = re.compile(r"its (negative|inverse|transpose|square|root)\b(.*)")
# A formula has a sign, or is of symbols alone, and has none of these words.
_SYMBOL = r"(?:\w|\w*[\d_]\w*|dq|qd|tau)"
_CODE = re.compile(rf"[-+*/^=@()\[\].|]|^{_SYMBOL}(?: {_SYMBOL})*$")
_WORDS = {
    "all", "an", "and", "as", "at", "by", "each", "for", "from", "in", "instead",
    "its", "last", "of", "on", "one", "over", "plus", "the", "then", "this", "times",
    "to", "with", "without", "where",
}  # fmt: skip
_PLURAL = re.compile(
    r"(all|both|two|three|five|ten|eleven|twenty|fifty|rays|zeros)\b"
    r"|(the|its|their) (?!series\b)\w*[^\Wsiu]s\b"
)


class Finding(NamedTuple):
    """What was found: its name, and what to say."""

    slug: str
    message: str


@dataclass(frozen=True)
class Verdict:
    """What the answers to a task's questions show."""

    # "passed"; "close": the method is right, the digits are not; "wrong"; or "todo":
    # not written yet.
    status: str
    mistake: str = ""  # its name ("joint-before-link"), "" when passed
    # One or two sentences for the student, with the telling number; "" when passed and
    # there is nothing to add.
    message: str = ""
    measured: tuple[str, ...] = ()  # lines for --explain
    follows: str = ""  # the id of the task that has to be right first, "" where none
    # Places of the main questions with a wrong answer, where neither a named mistake
    # nor anything else says more than by how much.
    wrong_calls: tuple[int, ...] = ()
    function: str = ""  # that was judged
    # Whether the answers have the property that is asked for, by another method.
    valid: bool = False
    call: str = ""  # the call that failed, in a line, with theirs and the right answer
    # The matrix that this call returned, where some of its entries are right.
    compared: "Compared | None" = field(default=None, compare=False)


class Compared(NamedTuple):
    """A matrix that a function returned, and the right one."""

    returned: Array  # (m, n)
    expected: Array  # (m, n)
    wrong: NDArray[np.bool_]  # (m, n), whether an entry is wrong


@dataclass(frozen=True)
class Mistake:
    """One way to be wrong. It is claimed only where redoing it gives the answer."""

    slug: str  # its name, "chain-reversed"
    # For the student: a clause without capital and full stop, so that it can follow "In
    # each link's transform, ".
    says: str
    # The function with the mistake in it. It takes all questions' arguments stacked,
    # one array (n, ...) per argument (a `Robot` as its model), and returns (n, ...), or
    # a tuple of such where the function returns several.
    redo: Callable[..., Any]
    # What to call that answer, as in "0 from its transpose".
    redone: str = REDONE
    reached: bool = False  # whether it is one of a smaller function that this one calls

    def does(self, evidence: str) -> str:
        """Return a clause on its answers: "the correct formula with min stops".

        Args:
            evidence: a verb and its object, in the singular: "stops in one call".
        """
        called = self._called()
        if _FORMULA.match(called):
            return f"the correct formula {called} {evidence}"
        if _FRAGMENT.match(called):
            return f"the correct result, {called.rstrip(',')}, {evidence}"
        if _PLURAL.match(called):
            evidence = re.sub(r"^(\w+)s\b", r"\1", evidence)
        return f"{called} {evidence}"

    def _called(self) -> str:
        """Return what to call its answers in a sentence that stands alone."""
        called = self.redone
        if _OF_BOTH.search(called):
            return BOTH
        if _POINTS_BACK.search(called):
            return REDONE
        if its := _ITS.fullmatch(called):
            rest = f"{its[2]}," if its[2] else ""
            return f"the {its[1]} of the correct result{rest}"
        return f"`{called}`" if _is_code(called) else called


def _is_code(text: str) -> bool:
    """Return whether a text is a formula or a name of code and no phrase."""
    words = set(re.findall(r"[a-z]+", text))
    return bool(_CODE.search(text)) and "`" not in text and not words & _WORDS


def told(text: str) -> Iterator[tuple[str, str, str]]:
    """Yield slug, sentence and what to call the answer of mistakes, "" where none says.

    Args:
        text: a line of each, "slug: sentence => what to call the answer"; an indented
            line goes on with the one above.
    """
    for line in re.sub(r"\n +", " ", inspect.cleandoc(text)).splitlines():
        slug, _, rest = line.partition(": ")
        says, _, redone = rest.partition(" => ")
        yield slug, says, redone
