"""The call that failed, as a student can type it: theirs and the right answer."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from labkit.base.exchange import Exchange, Question
from labkit.judge import problems
from labkit.judge.answers import (
    Parts,
    as_one_size,
    difference,
    gaps,
    own,
    typed,
    worst_part,
)
from labkit.judge.ask import Asked, HeldOut, right_answers
from labkit.judge.mistake import Finding
from robo47.checks import Array


@dataclass(frozen=True)
class Failing:
    """One call whose answer is not right."""

    # In a line, "Rz(2.9)[0, 0] is -1, and -0.971 is right."; "" without one.
    says: str = ""
    whole: tuple[str, ...] = ()  # the same with every argument and entry, in lines


def failing_call(asked: Asked, names: Sequence[str] = ()) -> Failing:
    """Return the call that is furthest off, of those always asked if one of them is."""
    with np.errstate(all="ignore"):
        for exchanges, held in _rounds(asked):
            if found := _broken(exchanges, names):
                return found
            if (asked.ask.truth or held) and (
                found := _wrong(asked, exchanges, held, names)
            ):
                return found
    return _refused(asked, names)


def _rounds(asked: Asked) -> list[tuple[list[Exchange], HeldOut | None]]:
    rounds: list[tuple[list[Exchange], HeldOut | None]]
    rounds = [(asked.main, None), (asked.fresh, None)]
    held_out = zip(asked.held_out, asked.ask.held_out, strict=True)
    rounds += [(some, held) for some, held in held_out if not held.mistaken]
    return [(exchanges, held) for exchanges, held in rounds if exchanges]


def _broken(exchanges: Sequence[Exchange], names: Sequence[str]) -> Failing | None:
    for one in exchanges:
        if one.reply and (one.reply.kind or one.reply.value is None):
            what = "stops" if one.reply.kind else "returns nothing"
            says = f"{typed(one.question, names)} {what}."
            return Failing(says, _given(one.question, names))
    return None


def _wrong(
    asked: Asked,
    exchanges: Sequence[Exchange],
    held: HeldOut | None,
    names: Sequence[str],
) -> Failing | None:
    ask = asked.ask
    S = problems.read([e.reply for e in exchanges if e.reply], ask, "")
    if isinstance(S, Finding):
        return None
    main = exchanges is asked.main
    T = asked.right if main else right_answers(ask, exchanges, held)
    gap = gaps(ask.kinds, S, T)
    i, part = int(np.argmax(gap)), worst_part(ask.kinds, S, T, ask.near)
    if gap[i] <= ask.tolerance:
        return None
    mine, its = (some[i] for some in as_one_size(S[part], T[part]))
    question = exchanges[i].question
    apart = np.nan_to_num(np.abs(mine - its), nan=np.inf)
    at = np.unravel_index(int(np.argmax(apart)), mine.shape)
    place = f"[{part}]" if len(S) > 1 else ""
    place += str([int(x) for x in at]) if at else ""
    says = f"{typed(question, names)}{place} is {_apart(mine[at], its[at])} is right."
    whole = [*_given(question, names)]
    for word, one in (("yours", S), ("right", T)):
        whole += [f"{word}: {_matrix(values[i])}" for values in one]
    return Failing(says, tuple(whole))


def _refused(asked: Asked, names: Sequence[str]) -> Failing:
    """Return the first call that a function with many right answers got wrong."""
    ask = asked.ask
    for one in [*asked.main, *asked.fresh] if ask.accept else []:
        if not one.reply or isinstance(problems.read([one.reply], ask, ""), Finding):
            continue
        if ask.accept and ask.accept(*map(own, one.question.args), one.reply.value):
            yours = (f"yours: {_matrix(np.asarray(one.reply.value))}",)
            says = f"{typed(one.question, names)} is such a call."
            return Failing(says, _given(one.question, names) + yours)
    return Failing()


def for_fresh(asked: Asked, main: Parts, S: Parts | Finding) -> Finding:
    """Return what is wrong with answers to inputs that are not always asked.

    That answers were looked up is said only where all are wrong, and each is one that
    another input has got.
    """
    right = "Right for the inputs that are always asked, but not for"
    if isinstance(S, Finding):
        return Finding("some-inputs", f"{right} fresh ones. {S.message}")
    T = right_answers(asked.ask, asked.fresh)
    wrong = gaps(asked.ask.kinds, S, T) > asked.ask.near
    says = f"{right} {int(wrong.sum())} of {len(wrong)} fresh ones."
    if wrong.all() and _only_known(main, S):
        return Finding("looked-up", f"{says} The answers do not come from the inputs.")
    some = "Some inputs take another way through your function."
    return Finding("some-inputs", says if wrong.all() else f"{says} {some}")


def _only_known(main: Parts, S: Parts) -> bool:
    """Return whether each answer is the same as one to another input."""
    rows, known = (np.hstack([p.reshape(len(p), -1) for p in x]) for x in (S, main))
    others = [np.vstack([known, np.delete(rows, i, 0)]) for i in range(len(rows))]
    return all(
        bool((difference(rest, np.broadcast_to(row, rest.shape)) < 1e-9).any())
        for row, rest in zip(rows, others, strict=True)
    )


def _given(question: Question, names: Sequence[str]) -> tuple[str, ...]:
    """Return the call, and each argument that is too long for it."""
    found = [f"call: {typed(question, names)}"]
    for i, arg in enumerate(question.args):
        if isinstance(arg, np.ndarray) and arg.ndim > 1:
            name = names[i] if len(names) == len(question.args) else f"argument {i + 1}"
            found.append(f"{name} = {_matrix(arg)}")
    return tuple(found)


def _matrix(values: Array) -> str:
    """Return an array as Python reads it."""
    return repr((np.asarray(values, dtype=float) + 0.0).tolist())


def _apart(mine: float, its: float) -> str:
    """Return two numbers with as many digits as tell them apart."""
    for digits in (6, 10, 17):
        one, other = (f"{x + 0.0:.{digits}g}" for x in (mine, its))
        if one != other:
            break
    return f"{one}, and {other}"
