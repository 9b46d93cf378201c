"""A mistake that has a name, and the verdict that says so."""

import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from labkit.base.exchange import Question
from robo47.checks import Array

REDONE = "the reference solution with this mistake"
BOTH = "the reference solution with both mistakes"
AS_A_SOLUTION = "Your code gives the same result as a solution"
THE_PLACE = r"The wrong (line|expressions?) (is|are) |[Ii]n (line \d|`)"
ALONE = "One mistake would explain your result: "
TOGETHER = "Two mistakes together would explain your result."
IN_TURN = "Two mistakes, made one after the other, would explain your result."
ADD_UP = "The errors of both mistakes add up to the error of your code"
YOUR_CODE = "your code "
_BOTH = re.compile(r" => both$")


class Finding(NamedTuple):
    """What was found: its name, and what to say."""

    slug: str
    message: str

    @property
    def by_output(self) -> bool:
        """Whether only the output shows it, as in a `Verdict`."""
        says = self.message
        nowhere = self.slug.startswith("slip-") and not re.search(THE_PLACE, says)
        return nowhere or AS_A_SOLUTION in says or ADD_UP in says


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
    # Whether a change of a right solution, or two mistakes, give the output of a
    # function that may have neither: a line of its own text would say more.
    by_output: bool = False
    # Whether the answers have the property that is asked for, by another method.
    valid: bool = False
    call: str = ""  # the call that failed, in a line, with theirs and the right answer
    # The matrix that this call returned, where some of its entries are right.
    compared: "Compared | None" = field(default=None, compare=False)
    example: "Example | None" = field(default=None, compare=False)  # that call itself


class Compared(NamedTuple):
    """A matrix that a function returned, and the right one."""

    returned: Array  # (m, n)
    expected: Array  # (m, n)
    wrong: NDArray[np.bool_]  # (m, n), whether an entry is wrong


class Example(NamedTuple):
    """A call with a wrong answer, from which a picture can be drawn."""

    question: Question
    returned: Any = None  # as it came; None where it stopped
    right: tuple[Array, ...] = ()  # per result; () where many answers are right


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
    both: bool = False  # whether it is two mistakes at once
    reached: bool = False  # whether it is one of a smaller function that this one calls

    def does(self, evidence: str) -> str:
        """Return a clause on the reference solution with it: "... stops in one call".

        Args:
            evidence: a verb and its object, in the singular: "stops in one call".
        """
        return f"{BOTH if self.both else REDONE} {evidence}"


def both_told(first: str, second: str, in_turn: bool = False) -> str:
    """Return two clauses on two mistakes as sentences; "your code" is said once.

    After another subject, or a rule, it would not be clear what "it" is, and "your code
    for the next pose" is no "it".
    """
    if first.startswith(YOUR_CODE) and ". " not in first:
        second = re.sub(f"^{YOUR_CODE}(?!for )", "it ", second)
    says = as_sentence(f"First, {first}"), as_sentence(f"Second, {second}")
    return f"{IN_TURN if in_turn else TOGETHER} {' '.join(says)}"


def as_sentence(says: str) -> str:
    """Return a clause with its full stop; a question keeps its mark."""
    return says if says.endswith("?") else f"{says}."


def told(text: str) -> Iterator[tuple[str, str, bool]]:
    """Yield slug and sentence of mistakes, and whether they are two at once.

    Args:
        text: a line of each, "slug: sentence", which ends in " => both" where it is on
            two mistakes at once; an indented line goes on with the one above.
    """
    for line in re.sub(r"\n +", " ", inspect.cleandoc(text)).splitlines():
        slug, _, says = line.partition(": ")
        yield slug, _BOTH.sub("", says), bool(_BOTH.search(says))
