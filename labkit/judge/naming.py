"""What to call wrong answers: a named mistake, one place, or the part that is wrong."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from labkit.judge import near_miss
from labkit.judge.ask import Ask, Case
from labkit.judge.compare import difference, matches
from labkit.judge.mistake import Finding, InTurn, Mistake, capitalised
from labkit.judge.rounds import parts
from robo47.checks import Array

Parts = tuple[Array, ...]


def diagnose(case: Case, S: Parts, T: Parts) -> Finding:
    """Return the first of: a named mistake, one place, what is wrong."""
    ask = case.ask
    if found := redone(ask, case.arguments, S, T) or _nothing_there(S):
        return found
    if found := _not_finite(S, case.given):
        return found
    i = worst_part(ask, S, T)
    kind = ask.kinds[i]
    if found := _all_the_same(kind, S[i], T[i]) or near_miss.rounded(S[i], T[i]):
        return found
    if ask.unnamed and (found := ask.unnamed(case)):
        return found
    found = kind.what_is_wrong(S[i], T[i])
    called = f"{kind.called}: " if len(S) > 1 and kind.called else ""
    where = ""
    if found.slug != "one-factor-off":  # every entry, so where does not matter
        where = _where(kind, S[i], T[i], case.given, ask.near)
    return Finding(found.slug, f"{called}{found.message}{where}")


def named_mistake(
    mistakes: Sequence[Mistake], arguments: tuple[Any, ...], ask: Ask, S: Any, T: Any
) -> Finding | None:
    """Return the first mistake that, made on purpose, gives the student's answers.

    Args:
        mistakes: the candidates.
        arguments: all questions' arguments stacked.
        ask: the function's row.
        S: the student's answers: per part, (n, ...).
        T: the right ones, or None where many are right.
    """
    for mistake in mistakes:
        try:
            if not _may_be(mistake, arguments, ask, S):
                continue
            again = parts(mistake.redo(*arguments))
        except (ValueError, np.linalg.LinAlgError):  # it has no answer of its own here
            continue
        pairs = list(zip(S, again, ask.kinds, strict=False))
        if len(again) == len(S) and all(matches(s, a, k.scale) for s, a, k in pairs):
            says = capitalised(mistake.says)
            says += "" if says.endswith("?") else "."
            if T is not None:
                i = worst_part(ask, S, T)
                says += f" (Off by up to {ask.kinds[i].apart(S[i], T[i])}; "
                says += f"{mistake.redone} gives your numbers exactly.)"
            return Finding(mistake.slug, says)
    return None


def _may_be(mistake: Mistake, arguments: tuple[Any, ...], ask: Ask, S: Any) -> bool:
    """Return whether a mistake gives the last answer: a quick look before all others.

    Raises:
        ValueError: it has no answer there.
    """
    if not isinstance(mistake.redo, InTurn):
        return True
    for s, a, kind in zip(
        S, parts(mistake.redo.nth(-1, arguments)), ask.kinds, strict=False
    ):
        largest = np.abs(s[np.isfinite(s)]).max(initial=kind.scale)
        if not matches(s[-1:], a[None], largest):
            return False
    return True


def redone(
    ask: Ask, arguments: tuple[Any, ...], S: Parts, T: Parts | None
) -> Finding | None:
    """Return a named mistake of the function, or a general one of its kind."""
    if found := named_mistake(ask.named, arguments, ask, S, T):
        return found
    if T is None:
        return None
    for i, kind in enumerate(ask.kinds):
        right = [part for j, part in enumerate(T) if j != i]
        others = [part for j, part in enumerate(S) if j != i]
        if not all(matches(s, t) for s, t in zip(others, right, strict=True)):
            continue
        one = Ask(ask.inputs, kind, truth=ask.truth)
        found = named_mistake(list(kind.general()), (T[i],), one, (S[i],), (T[i],))
        if found:
            called = f"{kind.called}: " if len(S) > 1 and kind.called else ""
            return Finding(found.slug, called + found.message)
    return None


def gaps(ask: Ask, S: Parts, T: Parts) -> Array:
    """Return per call the largest difference of an entry, in units of its scale."""
    gaps = [
        difference(s.reshape(len(s), -1), t.reshape(len(t), -1)) / kind.scale
        for s, t, kind in zip(S, T, ask.kinds, strict=True)
    ]
    return np.max(gaps, axis=0)


def off_by(ask: Ask, S: Parts, T: Parts) -> float:
    """Return the largest difference of any entry, in units of its scale."""
    return float(gaps(ask, S, T).max())


def worst_part(ask: Ask, S: Parts, T: Parts) -> int:
    """Return the first part of an answer that is wrong, or the one furthest off."""
    off = [
        off_by(Ask(ask.inputs, kind, truth=ask.truth), (s,), (t,))
        for s, t, kind in zip(S, T, ask.kinds, strict=True)
    ]
    return next((i for i, x in enumerate(off) if x > ask.near), int(np.argmax(off)))


def _nothing_there(S: Parts) -> Finding | None:
    if any(part.any() for part in S):
        return None
    return Finding(
        "all-zeros",
        "Every entry is 0, whatever the input: was the array made, but never filled? "
        "(MuJoCo's own results look so before mj_forward.)",
    )


def _not_finite(S: Parts, given: Sequence[str]) -> Finding | None:
    finite = [np.isfinite(part).reshape(len(part), -1).all(axis=1) for part in S]
    bad = ~np.all(finite, axis=0)
    if not bad.any():
        return None
    says = f"NaN or infinity comes out for {bad.sum()} of {len(bad)} inputs"
    return Finding("not-finite", f"{says}{_first(bad, given, 'first for')}.")


def _all_the_same(kind: Any, S: Array, T: Array) -> Finding | None:
    """Return that the answer does not depend on the input, though it should."""
    if len(S) < 2 or difference(S, np.broadcast_to(S[0], S.shape)).max() > 1e-8:
        return None
    off = f"(Off by up to {kind.apart(S, T)}.)"
    square = S.ndim == 3 and S.shape[1] == S.shape[2]
    if square and np.array_equal(S[0], np.eye(S.shape[1])):
        says = f"It returns the identity, whatever it is given. {off}"
        return Finding("always-the-identity", says)
    says = (
        f"The answer is the same, whatever the input: it does not depend on it. {off}"
    )
    return Finding("ignores-its-input", says)


def _where(kind: Any, S: Array, T: Array, given: Sequence[str], near: float) -> str:
    flat = difference(S.reshape(len(S), -1), T.reshape(len(T), -1))
    wrong = flat > near * kind.scale
    if wrong.all():
        return ""
    right = f" It is right for {np.sum(~wrong)} of {len(S)} inputs"
    return f"{right}{_first(wrong, given, 'but not for')}."


def _first(which: Any, given: Sequence[str], word: str) -> str:
    words = given[int(np.argmax(which))]
    return f", {word} {words}" if 0 < len(words) <= 90 else ""
