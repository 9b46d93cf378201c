"""Controlled experiments on a wrong function: with which argument neutral it is right.

"It is right whenever ed is 0, and whenever M is the identity" says which term is wrong
where no named mistake fits. It is true by construction: it was asked.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from labkit.base.exchange import Question, Reply
from labkit.judge.answers import InTurn, own, rigid, say_factor
from labkit.judge.ask import Asked, as_plain
from labkit.judge.replies_read import flat
from robo47.checks import Array

QUESTIONS = 4  # per experiment; three of them at least must agree
AGREE = 3
NOTHING = 1e-12  # a right answer as small as this says nothing
COMMON = 0.5  # the share of other wrong functions that may be right there as well
OTHERS = 12  # of them are asked
Call = tuple[Any, ...]  # its arguments
# From calls to the answers of a function, None where there is none, which says nothing.
Answers = Callable[[Sequence[Call]], Iterable[Any]]


def right_when(
    asked: Asked,
    wrong: Sequence[int],
    names: Sequence[str],
    reply_to: Callable[[Sequence[Question]], Sequence[Reply]],
) -> str:
    """Return with which argument neutral a wrong function is right, or "".

    Args:
        asked: what it was asked.
        wrong: the places of the main questions that it answered wrongly.
        names: of its arguments.
        reply_to: asks it further questions.
    """
    ask = asked.ask
    mains = [asked.main[i].question for i in wrong][-QUESTIONS:]
    calls = [question.args for question in mains]
    if any(len(names) != len(call) for call in calls):
        return ""

    def mine(some: Sequence[Call]) -> list[Any]:
        questions = [Question(mains[0].task, asked.function, call) for call in some]
        return [None if r.kind else r.value for r in reply_to(questions)]

    assert isinstance(ask.truth, InTurn)
    others = [_answers_of(m.redo) for m in ask.named if isinstance(m.redo, InTurn)]
    seen = Experiments(calls, names, mine, _answers_of(ask.truth), ask.near)
    return f"{seen.neutral(others)} {seen.doubled()}".strip()


@dataclass(frozen=True)
class Experiments:
    """A wrong function beside the right one."""

    calls: Sequence[Call]  # answered wrongly; their arguments have the same shapes
    names: Sequence[str]  # of the arguments
    mine: Answers  # the function
    truth: Answers  # the right answers
    near: float  # how far off a right answer may be, relative to its largest entry

    def neutral(self, others: Sequence[Answers] = ()) -> str:
        """Return which arguments, neutral, make the answers right, in words, or "".

        Args:
            others: other wrong functions. What is true of most of them says nothing.
        """
        telling = []
        for i, (words, k, changed, some) in enumerate(_neutral_calls(self.calls)):
            if self._right(self.mine, some):
                right = [self._right(other, some) for other in others[:OTHERS]]
                if (share := sum(right) / max(1, len(right))) <= COMMON:
                    telling.append((share, changed, i, k, words))
        says: dict[int, str] = {}  # of each argument the most telling
        for *_, k, words in sorted(telling):
            says.setdefault(k, f"whenever {words.format(self.names[k])}")
        return f"It is right {', and '.join([*says.values()][:2])}." if says else ""

    def doubled(self) -> str:
        """Return that answers do not grow with an argument as the right ones, or ""."""
        before, base = list(self.mine(self.calls)), list(self.truth(self.calls))
        for k, name in enumerate(self.names):
            if not all(_may_be_doubled(call[k]) for call in self.calls):
                continue
            some = _with(self.calls, k, [2.0 * call[k] for call in self.calls])
            given = self.mine(some)
            right = list(self.truth(some))
            if any(answer is None for answer in right):
                continue
            grew, its = self._growth(before, given), self._growth(base, right)
            if grew is None or (its is not None and np.isclose(grew, its, rtol=1e-3)):
                continue
            if np.isclose(grew, 1.0, rtol=self.near):
                return f"With {name} doubled, your answer stays the same; it must not."
            if its is not None:
                says = f"With {name} doubled, your answer becomes {say_factor(grew)}"
                return (
                    f"{says} times what it was; the right one {say_factor(its)} times."
                )
        return ""

    def _right(self, function: Answers, calls: Sequence[Call]) -> bool:
        """Return whether all answers are right and enough of them say something.

        Zeros say nothing, and neither do right answers that are all the same.
        """
        agree, different = 0, False
        first: Array | None = None
        for answer, its in zip(function(calls), self.truth(calls), strict=True):
            right = flat(its)
            if right is None or not np.isfinite(right).all():
                continue  # the question has no answer: it says nothing
            mine = flat(answer)
            if mine is None or mine.shape != right.shape:
                return False
            size = float(np.abs(right).max(initial=0.0))
            if not np.abs(mine - right).max(initial=0.0) <= self.near * max(1.0, size):
                return False
            agree += size > NOTHING
            first = right if first is None else first
            different = different or not np.allclose(right, first)
        return agree >= AGREE and different

    def _growth(self, before: Iterable[Any], after: Iterable[Any]) -> float | None:
        """Return by which one factor all answers grew, None where there is none.

        Args:
            before: answers; None where there was none, which says nothing.
            after: the same calls' with an argument doubled.
        """
        pairs = [(flat(b), flat(a)) for b, a in zip(before, after, strict=True)]
        kept = [(b, a) for b, a in pairs if b is not None and a is not None and b.any()]
        if len(kept) < AGREE or any(b.shape != a.shape for b, a in kept):
            return None
        one, two = (np.concatenate(some) for some in zip(*kept, strict=True))
        factor = float(one @ two / (one @ one))
        off = np.abs(two - factor * one).max()
        return factor if off <= self.near * max(1.0, float(np.abs(two).max())) else None


def _neutral_calls(
    calls: Sequence[Call],
) -> Iterator[tuple[str, int, float, list[Call]]]:
    """Yield "{} is 0", which argument, how many numbers that changed, and the calls."""
    for k, column in enumerate(zip(*calls, strict=True)):
        for choices in zip(*map(neutrals, column), strict=False):
            says, values = zip(*choices, strict=True)
            pairs = zip(column, values, strict=True)
            count = float(np.mean([np.sum(np.not_equal(x, v)) for x, v in pairs]))
            if len(set(says)) == 1 and count:
                yield says[0], k, count, _with(calls, k, values)


def _with(calls: Sequence[Call], k: int, values: Sequence[Any]) -> list[Call]:
    """Return calls with other values of argument k."""
    pairs = zip(calls, values, strict=True)
    return [(*call[:k], value, *call[k + 1 :]) for call, value in pairs]


def neutrals(x: Any) -> Iterator[tuple[str, Any]]:
    """Yield the neutral values of an argument in words, the most telling first.

    Args:
        x: a number, a vector, a matrix, a rotation or a pose; anything else has none.
    """
    if isinstance(x, float) and not isinstance(x, bool):
        yield "{} is 0", 0.0
        yield "{} is 1", 1.0
    elif isinstance(x, np.ndarray) and x.ndim == 1 and len(x) > 1:
        yield "{} is 0", np.zeros_like(x)
        yield "all entries of {} are equal", np.full_like(x, x[0])
        one = np.where(np.arange(len(x)) == np.argmax(np.abs(x)), x, 0.0)
        yield "only one entry of {} is not 0", one
    elif isinstance(x, np.ndarray) and x.ndim == 2:
        yield from _of_a_matrix(x)


def _of_a_matrix(x: Array) -> Iterator[tuple[str, Array]]:
    if x.shape == (4, 4) and rigid(x[None]):
        turned, moved = x.copy(), x.copy()
        turned[:3, 3] = 0.0
        moved[:3, :3] = np.eye(3)
        yield "{} does not translate", turned
        yield "{} does not rotate", moved
    elif x.shape == (3, 3) and rigid(x[None]):
        yield "{} is the identity", np.eye(3)
    elif x.shape[0] == x.shape[1]:
        yield "{} is diagonal", np.diag(np.diag(x))
        yield "{} is the identity", np.eye(len(x))
        yield "{} is 0", np.zeros_like(x)
    else:
        yield "only the first column of {} is not 0", x * (np.arange(x.shape[1]) == 0)


def _may_be_doubled(x: Any) -> bool:
    if isinstance(x, np.ndarray):
        turned = x.shape in ((3, 3), (4, 4)) and rigid(x[None])
        return bool(x.any()) and not turned
    return isinstance(x, float) and x != 0.0


def _answers_of(function: InTurn) -> Answers:
    """Return the answers of a function of one question's arguments, one by one."""

    def answer(call: Call) -> Any:
        try:
            with np.errstate(all="ignore"):
                return function.function(*map(own, map(as_plain, call)))
        except Exception:  # a singular matrix, say
            return None

    return lambda calls: map(answer, calls)
