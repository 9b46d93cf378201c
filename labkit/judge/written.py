"""What does not fit in a row, told to its author when it is written."""

import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from labkit.base.exchange import Exchange, Question
from labkit.judge import fits
from labkit.judge.answers import InTurn, as_real
from labkit.judge.ask import Ask, right_answers
from labkit.judge.mistake import Finding
from labkit.judge.other_kinds import Mask
from labkit.judge.results import Kinds, read
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

EACH = 6  # questions of each truth value, at least


def stop(error: BaseException) -> str:
    """Return what an author's code stops with, and its own line that led there."""
    frames = traceback.extract_tb(error.__traceback__)
    machine = ROOT / "labkit", Path(sys.prefix), Path(np.__file__).parent
    own = [
        frame
        for frame in frames
        if Path(frame.filename).is_file()  # NumPy's compiled frames name none
        and not any(Path(frame.filename).is_relative_to(one) for one in machine)
    ]
    last = (own or frames)[-1]
    where = f"{shown(Path(last.filename))}, line {last.lineno}"
    return f"stops with {type(error).__name__}: {error} ({where})"


def stops_with(error: BaseException) -> str:
    """Return what an author's function stops with, where, and what it has to do."""
    return f"{stop(error)}. It has to take all that @row.inputs yields"


def faults(ask: Ask, seconds: float) -> Iterator[str]:
    """Yield what the questions of a row cannot show, or have no time for.

    Args:
        ask: the row, whose truth has an answer to each of them.
        seconds: for all calls of the function.
    """
    if says := fits.too_long(ask.main, ask.cost_in(seconds), seconds):
        yield says
    if ask.truth is None:
        return
    calls = [*ask.main, *ask.edges]
    right = right_answers(ask, [Exchange(Question("", "", call)) for call in calls])
    for kind, answers in zip(ask.kinds, right, strict=True):
        if isinstance(kind, Mask) and kind.shape == ():
            yes = int(np.sum(answers == 1.0))
            if min(yes, len(answers) - yes) < EACH:
                what = kind.called or "its answer"
                yield (
                    f"{what} is True in {yes} of the {len(answers)} calls that are "
                    f"always asked, edges among them; ask {EACH} of each at least, or "
                    "who always says the same is right too often"
                )


@dataclass(frozen=True, eq=False, kw_only=True)
class Answered(InTurn):
    """The truth: where it has no answer to a question, its author is told."""

    asked: InTurn  # the same function; its answers are read here
    kind: Kinds
    fault: Callable[[str], Robo47Error]  # what is said of its row

    def each(self, columns: Sequence[Any]) -> list[Any]:
        """Return the right answers one by one, read as their kind says.

        Raises:
            Robo47Error: it stops, or returns what its kind does not take.
        """
        try:
            answers = self.asked.each(columns)
        except ValueError as error:
            says = f"truth {stops_with(error.__cause__ or error)}"
            raise self.fault(says) from None
        arrays = (c for c in columns if isinstance(c, np.ndarray))
        if any(np.iscomplexobj(one) for column in arrays for one in column):
            answers = list(map(as_real, answers))
        found = read(self.kind, answers)
        if isinstance(found, Finding):
            says = found.message.replace("Your function returns", "truth returns")
            says = says.replace("; expected", ", and its kind").replace(
                "expected are", "its kind is"
            )
            raise self.fault(says.rstrip("."))
        return [self.numbers(answer) for answer in answers]
