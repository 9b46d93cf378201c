"""The questions of one check, made once; the replies come back to them in order."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from labkit.judge.ask import Ask, HeldOut, Inputs, Robot
from labkit.judge.exchange import Path, Question
from robo47.checks import Array

SEED = 47


@dataclass(frozen=True)
class Round:
    """All that one function is asked in one check.

    Attributes:
        function: its name.
        ask: its row.
        main: the questions that are the same at every check.
        fresh: drawn anew.
        held_out: per entry of `ask.held_out`.
        probes: those of `ask.probe`.
    """

    function: str
    ask: Ask
    main: tuple[Question, ...]
    fresh: tuple[Question, ...]
    held_out: tuple[tuple[Question, ...], ...]
    probes: tuple[Question, ...]

    @property
    def questions(self) -> list[Question]:
        """All of them, in the order in which replies are expected."""
        held = [question for some in self.held_out for question in some]
        return [*self.main, *self.fresh, *held, *self.probes]


def make_round(task: str, function: str, ask: Ask, seed: int) -> Round:
    """Return the questions to a function.

    Args:
        task: whose function it is.
        function: its name.
        ask: its row.
        seed: of the fresh inputs; nobody should know it beforehand.
    """

    def make(inputs: Inputs, seed: int = SEED) -> tuple[Question, ...]:
        calls = inputs(np.random.default_rng(seed))
        return tuple(Question(task, function, tuple(args)) for args in calls)

    fresh = make(ask.inputs, seed)[-ask.fresh :] if ask.fresh else ()
    return Round(
        function,
        ask,
        make(ask.inputs),
        fresh,
        tuple(make(held.inputs) for held in ask.held_out),
        make(ask.probe.inputs) if ask.probe else (),
    )


def robots(rounds: Iterable[Round]) -> list[Robot]:
    """Return every robot that occurs in questions, each once."""
    found: dict[int, Robot] = {}
    for one in rounds:
        for question in one.questions:
            for arg in question.args:
                if isinstance(arg, Robot):
                    found.setdefault(id(arg), arg)
    return list(found.values())


def stacked(questions: Sequence[Question]) -> tuple[Any, ...]:
    """Return all questions' arguments, one array (n, ...) per argument.

    A robot is one model for all of them, and a path one path.
    """
    columns = zip(*(question.args for question in questions), strict=True)
    return tuple(_column(column) for column in columns)


def _column(column: tuple[Any, ...]) -> Any:
    first = column[0]
    if isinstance(first, Robot):
        return first.model
    if isinstance(first, Path):
        return first.pairs
    return np.array(column, dtype=np.float64)


def right_answers(ask: Ask, questions: Sequence[Question]) -> tuple[Array, ...]:
    """Return the right answers to questions: per part of the answer, (n, ...)."""
    assert ask.truth is not None
    return parts(ask.truth(*stacked(questions)))


def held_out_answers(
    held: HeldOut, ask: Ask, questions: Sequence[Question]
) -> tuple[Array, ...]:
    """Return what answers to held-out questions are compared with."""
    function = held.mistaken or held.truth or ask.truth
    assert function is not None
    return parts(function(*stacked(questions)))


def parts(answers: Any) -> tuple[Array, ...]:
    """Return answers as a tuple of parts, also where there is one."""
    some = answers if isinstance(answers, tuple) else (answers,)
    return tuple(np.asarray(part, dtype=np.float64) for part in some)


def in_words(question: Question, names: Sequence[str] = ()) -> str:
    """Return a question's input as a student can type it: numbers and short vectors.

    Args:
        question: whose arguments.
        names: theirs, where they are known.
    """
    named = len(names) == len(question.args) > 1
    words = []
    for i, arg in enumerate(question.args):
        if isinstance(arg, (int, float)):
            says = number(float(arg))
        elif isinstance(arg, np.ndarray) and arg.ndim == 1:
            says = "(" + ", ".join(number(float(x)) for x in arg) + ")"
        else:
            continue
        words.append(f"{names[i]} = {says}" if named else says)
    return (", " if named else " and ").join(words)


def number(x: float) -> str:
    """Return a number as Python reads it back, "pi / 2" for a fraction of pi."""
    for over in (1, 2, 3, 4, 6):
        times = x * over / np.pi
        if times and times == round(times) and abs(times) <= 2 * over:
            sign = "-" if times < 0 else ""
            many = "" if abs(times) == 1 else f"{abs(round(times))} * "
            return f"{sign}{many}pi" + (f" / {over}" if over > 1 else "")
    return repr(round(x)) if x == round(x) and abs(x) < 1e6 else repr(x)
