"""Controlled experiments on a wrong function: with which argument neutral it is right.

"It is right whenever ed is 0, and whenever M is the identity" says which term is wrong
where no named mistake fits. It is true by construction: it was asked.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from labkit.base.exchange import Question, Reply
from labkit.judge.answers import InTurn, own, rigid, say_factor
from labkit.judge.ask import Asked, as_plain
from labkit.judge.problems import flat
from robo47.checks import Array

QUESTIONS = 4  # per experiment; three of them at least must agree
AGREE = 3
NOTHING = 1e-12  # a right answer as small as this says nothing
COMMON = 0.5  # the share of other wrong functions that may be right there as well
OTHERS = 12  # of them are asked
Call = tuple[Any, ...]


class Experiment(NamedTuple):
    """Calls in which one argument is neutral."""

    says: str  # "ed is 0"
    changed: float  # how many numbers of the argument were made neutral
    calls: list[Call]  # the arguments of each


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
    mains = [asked.main[i].question for i in wrong][-QUESTIONS:]
    calls = [question.args for question in mains]
    tried, twice = experiments(calls, names), doublings(calls, names)

    def answers(some: Sequence[Call]) -> list[Any]:
        questions = [Question(mains[0].task, asked.function, call) for call in some]
        return [None if r.kind else r.value for r in reply_to(questions)]

    given, doubled = ([answers(one.calls) for one in some] for some in (tried, twice))
    ask, near = asked.ask, asked.ask.near
    assert isinstance(ask.truth, InTurn)
    truth = _of_one(ask.truth)
    others = [_of_one(m.redo) for m in ask.named if isinstance(m.redo, InTurn)]
    says = conclude(tried, given, truth, near, others)
    more = not_doubled(twice, answers(calls), doubled, calls, truth, near)
    return f"{says} {more}".strip()


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
        turned[:3, 3], moved[:3, :3] = 0.0, np.eye(3)
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


def experiments(calls: Sequence[Call], names: Sequence[str]) -> list[Experiment]:
    """Return what to ask of a function that answered these calls wrongly.

    Args:
        calls: the arguments of each, of the same shapes; three at least.
        names: of the arguments.
    """
    some = _asked_again(calls, names)
    found = []
    for k, name in enumerate(names if some else ()):
        for choices in zip(*(neutrals(call[k]) for call in some), strict=False):
            says, values = zip(*choices, strict=True)
            pairs = list(zip(some, values, strict=True))
            count = np.mean([np.sum(np.not_equal(call[k], v)) for call, v in pairs])
            if len(set(says)) == 1 and count:
                changed = [(*call[:k], v, *call[k + 1 :]) for call, v in pairs]
                found.append(Experiment(says[0].format(name), float(count), changed))
    return found


def _asked_again(calls: Sequence[Call], names: Sequence[str]) -> list[Call]:
    """Return the calls to change; none where too few, or with other arguments."""
    some = list(calls)[-QUESTIONS:]
    fit = len(some) >= AGREE and all(len(names) == len(call) for call in some)
    return some if fit else []


def doublings(calls: Sequence[Call], names: Sequence[str]) -> list[Experiment]:
    """Return calls with one argument doubled, per argument that may be; as above."""
    some = _asked_again(calls, names)
    found = []
    for k, name in enumerate(names if some else ()):
        if all(_may_be_doubled(call[k]) for call in some):
            twice = [(*call[:k], 2.0 * call[k], *call[k + 1 :]) for call in some]
            found.append(Experiment(name, 0.0, twice))
    return found


def _may_be_doubled(x: Any) -> bool:
    if isinstance(x, np.ndarray):
        turned = x.shape in ((3, 3), (4, 4)) and rigid(x[None])
        return bool(x.any()) and not turned
    return isinstance(x, float) and x != 0.0


def growth(before: Sequence[Any], after: Sequence[Any], near: float) -> float | None:
    """Return by which one factor all answers grew, None where there is none.

    Args:
        before: answers; None where there was none, which says nothing.
        after: the same calls' with an argument doubled.
        near: how far off a right answer may be, relative to its largest entry.
    """
    pairs = [(flat(b), flat(a)) for b, a in zip(before, after, strict=True)]
    whole = [(b, a) for b, a in pairs if b is not None and a is not None and b.any()]
    if len(whole) < AGREE or any(b.shape != a.shape for b, a in whole):
        return None
    one, two = (np.concatenate(some) for some in zip(*whole, strict=True))
    factor = float(one @ two / (one @ one))
    off = np.abs(two - factor * one).max()
    return factor if off <= near * max(1.0, float(np.abs(two).max())) else None


def not_doubled(
    asked: Sequence[Experiment],
    before: Sequence[Any],
    after: Sequence[Sequence[Any]],
    calls: Sequence[Call],
    truth: Callable[..., Any],
    near: float,
) -> str:
    """Return that answers do not grow with an argument as the right ones do, or "".

    Args:
        asked: from `doublings`.
        before: the function's answers without.
        after: per experiment its answers.
        calls: the arguments of each without.
        truth, near: as in `conclude`.
    """
    base = [_or_none(truth, call) for call in calls]
    for one, given in zip(asked, after, strict=True):
        right = [_or_none(truth, call) for call in one.calls]
        if any(answer is None for answer in right):
            continue
        mine, its = growth(before, given, near), growth(base, right, near)
        if mine is None or (its is not None and np.isclose(mine, its, rtol=1e-3)):
            continue
        if np.isclose(mine, 1.0, rtol=near):
            return f"With {one.says} doubled, your answer stays the same; it must not."
        if its is not None:
            says = f"With {one.says} doubled, your answer becomes {say_factor(mine)}"
            return f"{says} times what it was; the right one {say_factor(its)} times."
    return ""


def conclude(
    asked: Sequence[Experiment],
    answers: Sequence[Sequence[Any]],
    truth: Callable[..., Any],
    near: float,
    others: Sequence[Callable[..., Any]] = (),
) -> str:
    """Return the sentence that the experiments allow, or "".

    Args:
        asked: the experiments.
        answers: per experiment the function's answers, None where there was none.
        truth: the right answer to one call.
        near: how far off a right answer may be, relative to its largest entry.
        others: other wrong functions. What is true of most of them says nothing.
    """
    telling = []
    for i, (one, given) in enumerate(zip(asked, answers, strict=True)):
        if _right(one.calls, given, truth, near):
            said = [[_or_none(o, call) for call in one.calls] for o in others[:OTHERS]]
            right = [_right(one.calls, those, truth, near) for those in said]
            if (share := sum(right) / max(1, len(right))) <= COMMON:
                telling.append((share, one.changed, i))
    says: list[str] = []
    seen: set[str] = set()
    for *_, i in sorted(telling):
        argument = _argument(asked[i].says)
        if argument not in seen and len(says) < 2:
            seen.add(argument)
            says.append(f"whenever {asked[i].says}")
    return f"It is right {', and '.join(says)}." if says else ""


def _argument(says: str) -> str:
    """Return the argument's name in "all entries of kp are equal"."""
    words = says.split()
    return words[words.index("of") + 1] if "of" in words else words[0]


def _right(
    calls: Sequence[Call], given: Sequence[Any], truth: Callable[..., Any], near: float
) -> bool:
    """Return whether all answers are right and enough of them say something.

    Zeros say nothing, and neither do right answers that are all the same.
    """
    agree, different = 0, False
    first: Array | None = None
    for call, answer in zip(calls, given, strict=True):
        right = flat(_or_none(truth, call))
        if right is None or not np.isfinite(right).all():
            continue  # the question has no answer: it says nothing
        mine = flat(answer)
        if mine is None or mine.shape != right.shape:
            return False
        scale = max(1.0, float(np.abs(right).max(initial=0.0)))
        if not np.abs(mine - right).max(initial=0.0) <= near * scale:
            return False
        agree += bool(np.abs(right).max(initial=0.0) > NOTHING)
        first = right if first is None else first
        different = different or not np.allclose(right, first)
    return agree >= AGREE and different


def _or_none(function: Callable[..., Any], call: Call) -> Any:
    try:
        with np.errstate(all="ignore"):
            return function(*map(own, call))
    except Exception:  # a singular matrix, say
        return None


def _of_one(function: InTurn) -> Callable[..., Any]:
    """Return a function of one question's arguments."""
    return lambda *args: function.function(*map(as_plain, args))
