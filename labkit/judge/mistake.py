"""A mistake that has a name: what to say, and the same mistake made on purpose."""

import contextlib
from collections.abc import Callable, Sequence, Set
from dataclasses import dataclass
from itertools import starmap
from typing import Any, NamedTuple

import numpy as np

from labkit.judge.compare import as_one, parts

KEPT = 64  # questions whose answers are kept
# Words that are symbols of a formula; those of one letter but "a" are, too.
SYMBOLS = {"alpha", "beta", "dq", "ed", "kd", "ki", "kp", "mu", "omega", "pi",
           "qd", "qdd", "sd", "sdd", "tau", "theta", "zeta"}  # fmt: skip


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
    call: str = ""  # the call that failed, in a line, with theirs and the right answer


@dataclass(frozen=True)
class Mistake:
    """One way to be wrong. It is claimed only where redoing it gives the answer."""

    slug: str  # its name, "chain-reversed"
    # For the student: a clause without capital and full stop, so that it can follow "In
    # the links' factors, ".
    says: str
    # The function with the mistake in it. It takes all questions' arguments stacked,
    # one array (n, ...) per argument (a `Robot` as its model), and returns (n, ...), or
    # a tuple of such where the function returns several.
    redo: Callable[..., Any]
    # What to call that answer, as in "0 from its transpose".
    redone: str = "the answer with this mistake"


def capitalised(clause: str) -> str:
    """Return a clause as a sentence starts; a symbol, qd say, stays what it is."""
    first = clause.partition(" ")[0].rstrip(",")
    letter = len(first) == 1 and first != "a"
    if letter or first in SYMBOLS or not first.isalpha():
        return clause
    return clause[0].upper() + clause[1:]


def own(argument: Any) -> Any:
    """Return a copy of an array or a number; a model or a path is as it is."""
    plain = isinstance(argument, np.ndarray | np.generic)
    return np.copy(argument)[()] if plain else argument


def once(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that keeps its answers to the last questions."""
    known: dict[Any, Any] = {}

    def key(argument: Any) -> Any:
        if isinstance(argument, np.ndarray):
            return argument.shape, argument.dtype, argument.tobytes()
        return repr(argument) if isinstance(argument, list) else argument

    def keeping(*args: Any) -> Any:
        if (question := tuple(map(key, args))) not in known:
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
        answer = answers[slug]
        return answer() if callable(answer) else own(answer)

    return one


@dataclass(frozen=True, eq=False)
class InTurn:
    """A function of one question's arguments as one of all, stacked."""

    function: Callable[..., Any]  # of one question, as a student writes it

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
            return [self.function(*args) for args in calls]
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
        with contextlib.suppress(Exception):
            end = [c[-1:] if isinstance(c, np.ndarray) else c for c in columns]
            (last,) = super().each(end)
            whole = self.function(*map(own, columns))
            several = isinstance(whole, tuple)
            answers = list(zip(*whole, strict=True) if several else whole)
            pairs = zip(parts(answers[-1]), parts(last), strict=True)
            if len(answers) == _count(columns) and all(starmap(np.array_equal, pairs)):
                return answers
        return super().each(columns)


def _count(columns: Sequence[Any]) -> int:
    """Return how many questions there are; one where nothing is stacked."""
    return next((len(c) for c in columns if isinstance(c, np.ndarray)), 1)
