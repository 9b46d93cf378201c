"""The judge: from the replies to one function's questions to a verdict."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from labkit.judge import answers, near_miss
from labkit.judge.ask import Ask, Case, HeldOut
from labkit.judge.exchange import Reply
from labkit.judge.mistake import Finding, Verdict
from labkit.judge.naming import diagnose, gaps, off_by, redone, worst_part
from labkit.judge.rounds import (
    Round,
    held_out_answers,
    in_words,
    right_answers,
    stacked,
)
from robo47.checks import Array

Parts = tuple[Array, ...]


def judge(
    asked: Round,
    replies: Sequence[Reply],
    source: str = "",
    names: Sequence[str] = (),
) -> Verdict:
    """Return what the replies to a function's questions show.

    Args:
        asked: the questions.
        replies: one per question, in order.
        source: the student's file, for slips that show in it.
        names: of the function's arguments, for sentences.

    Raises:
        ValueError: not one reply per question.
    """
    if len(replies) != len(asked.questions):
        raise ValueError(f"{len(replies)} replies to {len(asked.questions)} questions")
    count = len(asked.main)
    S = answers.read(replies[:count], asked.ask, source)
    if isinstance(S, Finding):
        return Verdict("wrong", *S)
    if state := answers.kept_state(replies[: count + len(asked.fresh)]):
        return Verdict("wrong", *state)
    with np.errstate(all="ignore"):  # whatever the student's numbers lead to
        if asked.ask.accept:
            return _judge_accepted(asked, replies, S, names)
        return _judge_values(asked, replies, S, names)


def _judge_values(
    asked: Round, replies: Sequence[Reply], S: Parts, names: Sequence[str]
) -> Verdict:
    ask, count = asked.ask, len(asked.main)
    T = right_answers(ask, asked.main)
    case = _case(asked, replies, S, T, names)
    measured = _measured(case, S, T)
    off = off_by(ask, S, T)
    if off > ask.near:
        return Verdict("wrong", *diagnose(case, S, T), measured)
    if off > ask.tolerance:
        return Verdict("close", *_near_miss(case, replies[:count], S, T, off), measured)
    return _second_look(asked, replies, measured)


def _near_miss(
    case: Case, replies: Sequence[Reply], S: Parts, T: Parts, off: float
) -> Finding:
    if off <= near_miss.SINGLE and answers.single_precision(replies, S):
        says = f"Right, but in float32: off by {off:.0e}. The labs use float64."
        return Finding("float32", says)
    i = worst_part(case.ask, S, T)
    found = case.ask.near_miss(case) if case.ask.near_miss else None
    return found or near_miss.explain(S[i], T[i])


def _second_look(
    asked: Round, replies: Sequence[Reply], measured: tuple[str, ...]
) -> Verdict:
    """Return the verdict on right answers: how did they come about?"""
    ask, at, note = asked.ask, len(asked.main), ""
    if shared := answers.shared_memory(replies[: at + len(asked.fresh)]):
        return Verdict("wrong", *shared, measured)
    if asked.fresh and ask.truth:
        S = answers.read(replies[at : at + len(asked.fresh)], ask, "")
        off = np.inf
        if not isinstance(S, Finding):
            off = off_by(ask, S, right_answers(ask, asked.fresh))
        if off > ask.near:
            says = (
                "Right for the inputs that are always asked, but off by "
                f"{off:.3g} for fresh ones: some inputs take another way through your "
                "function, or the answers are not computed from them."
            )
            return Verdict("wrong", "looked-up", says, measured)
    at += len(asked.fresh)
    for held, questions in zip(ask.held_out, asked.held_out, strict=True):
        some = replies[at : at + len(questions)]
        at += len(questions)
        if _found(held, ask, questions, some):
            if held.status != "passed":
                return Verdict(held.status, held.slug, held.says, measured)
            note = f"{note} {held.says}".strip()
    return Verdict("passed", "", note, measured)


def _found(held: HeldOut, ask: Ask, questions: Any, replies: Sequence[Reply]) -> bool:
    """Return whether answers to held-out questions give the mistake away."""
    S = answers.read(replies, ask, "")
    if isinstance(S, Finding):
        return held.mistaken is None  # no answer is no sign of one certain mistake
    off = off_by(ask, S, held_out_answers(held, ask, questions))
    return off <= ask.near if held.mistaken else off > ask.near


def _judge_accepted(
    asked: Round, replies: Sequence[Reply], S: Parts, names: Sequence[str]
) -> Verdict:
    """Return the verdict of a function to which many answers are right."""
    ask = asked.ask
    assert ask.accept is not None
    fresh = answers.read(
        replies[len(asked.main) : len(asked.main) + len(asked.fresh)], ask, ""
    )
    if isinstance(fresh, Finding):
        return Verdict("wrong", *fresh)
    questions = [*asked.main, *asked.fresh]
    columns = [np.concatenate(pair) for pair in zip(S, fresh, strict=True)]
    rows = list(zip(*columns, strict=True))
    wrong: list[tuple[int, Finding]] = []
    for i, (question, row) in enumerate(zip(questions, rows, strict=True)):
        answer = row[0] if len(row) == 1 else row
        args = [a.copy() if isinstance(a, np.ndarray) else a for a in question.args]
        if why := ask.accept(*args, answer):
            found = why if isinstance(why, Finding) else Finding("not-accepted", why)
            wrong.append((i, found))
    if not wrong:
        return _second_look(asked, replies, ())
    if named := redone(ask, stacked(asked.main), S, None):
        return Verdict("wrong", *named)
    i, found = wrong[0]
    given = in_words(questions[i], names)
    often = sum(other.slug == found.slug for _, other in wrong)
    where = f" (For {often} of {len(questions)} inputs"
    where += f", first for {given}.)" if 0 < len(given) <= 90 else ".)"
    return Verdict("wrong", found.slug, found.message + where)


def _case(
    asked: Round, replies: Sequence[Reply], S: Parts, T: Parts, names: Sequence[str]
) -> Case:
    def plain(some: Parts) -> Any:
        return some[0] if len(some) == 1 else some

    probed = replies[len(replies) - len(asked.probes) :] if asked.probes else []
    probes = [
        (question.args, None if reply.kind else reply.value)
        for question, reply in zip(asked.probes, probed, strict=True)
    ]
    given = [in_words(question, names) for question in asked.main]
    return Case(asked.ask, stacked(asked.main), plain(S), plain(T), given, probes)


def _measured(case: Case, S: Parts, T: Parts) -> tuple[str, ...]:
    ask = case.ask
    gap = gaps(ask, S, T)
    lines = [
        f"largest difference of an entry: {gap.max():.2g} (call {np.argmax(gap) + 1} "
        f"of {len(gap)}; passes up to {ask.tolerance:.0e})",
        f"calls that are right: {np.sum(gap <= ask.tolerance)} of {len(gap)}",
    ]
    for kind, s, t in zip(ask.kinds, S, T, strict=True):
        lines += kind.measured(s, t)
    return (*lines, *(ask.measured(case) if ask.measured else ()))
