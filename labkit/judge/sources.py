"""The sources of hypotheses: what may explain a student's answers, and in which order.

The author's entries come first, then what is common to a kind of answer, then what the
machine makes: mutants of every right body, one argument changed, the answer changed.
"""

import re
from collections.abc import Iterator
from functools import partial
from itertools import chain, count, islice, permutations
from typing import Any

import numpy as np

from labkit.judge import changes
from labkit.judge.answers import (
    MATCHES,
    Parts,
    all_match,
    as_clause,
    capitalised,
    content,
    of_result,
    own,
    parts,
    plain,
)
from labkit.judge.ask import Ask, Case
from labkit.judge.hypothesis import equals, evidence
from labkit.judge.kinds import one_factor
from labkit.judge.matcher import Calls, Code, Matcher
from labkit.judge.mistake import ALONE, REDONE, Finding, Mistake, as_sentence
from labkit.judge.mutant import FAR, Mutant
from labkit.judge.sentence import (
    has_its_kind,
    is_in_another_form,
    is_in_its_form,
    of_mutants,
    own_line,
    shows,
    tells_of,
)

NEAR, FURTHER = "near", "further"  # mutants
# What share of a search's effort is kept for the sources that come later.
KEEP = {NEAR: 0.45, FURTHER: 0.05}
KEEP_OF_ARGUMENTS = 0.25
SEVERAL = 20  # mutants that give one answer, of which some give all
APART = 4  # of them, in places of their own
KEPT = 8  # functions and calls whose mutants are kept with their answers
_MADE: dict[Any, tuple[Any, list[Any], Iterator[Any]]] = {}
SCREEN = 1e3 * MATCHES  # of one call: the largest of all may be as much larger
# What is said of how it is written, and not of its result.
OF_THE_CODE = re.compile(r"\byour (code|loop|function)\b", re.IGNORECASE)
AGREE = 3  # calls with a wrong answer that a mutant of whole numbers has to give


def authors(m: Matcher, digits: bool = True) -> Finding | None:
    """Return the first of the author's mistakes that explains all answers.

    Whole numbers that are equal prove little, so there it must be the only one.

    Args:
        m: the matcher.
        digits: whether it has to give every digit; two mistakes may be as alike as
            metres and millimetres beside a kilometre.
    """
    that_hold = (one for one in m.ask.named if m.holds(one.redo, digits))
    if not m.whole:
        return next((with_evidence(m, one) for one in that_hold), None)
    found: dict[str, Finding] = {}
    for one in that_hold:
        found.setdefault(one.slug, with_evidence(m, one))
    if len(found) == 2:
        either, other = found.values()
        says = "Each of two different mistakes explains your results."
        says += f" First possibility: {as_clause(either.message)}"
        says += f" Second possibility: {as_clause(other.message)}"
        return Finding(either.slug, says)
    return next(iter(found.values())) if len(found) == 1 else None


def of_accepted(ask: Ask, arguments: tuple[Any, ...], S: Parts) -> Finding | None:
    """Return the author's mistake that gives all answers where many are right."""
    calls = Calls(ask, arguments, S, S)

    def gives(code: Code) -> bool:
        """Return whether a mistake gives all answers; one call is asked before all."""
        its = tuple(s[-1:] for s in S)
        screened = tuple(x[None] for x in calls.answer(code, len(calls) - 1))
        alike = all_match(ask.kinds, its, screened, SCREEN)
        return alike and all_match(ask.kinds, S, calls.answers(code))

    found = (one for one in ask.named if gives(one.redo))
    return next((Finding(one.slug, _sentence(one)) for one in found), None)


def named(ask: Ask, arguments: tuple[Any, ...], S: Parts, T: Parts) -> Finding | None:
    """Return what is said of answers to the main questions that have a name."""
    m = Matcher(Case(ask, arguments, plain(S), plain(T), ()), S, T)
    return authors(m) or in_another_order(m) or of_the_kind(m)


def nearly(m: Matcher) -> Finding | None:
    """Return what explains all but a hundredth of the difference, and not all digits.

    Such as a named mistake in single precision, or beside a small one.
    """
    if m.whole:
        return None
    some = (authors, of_the_kind, of_arguments)
    return next(filter(None, (source(m, False) for source in some)), None)


def _sentence(one: Mistake) -> str:
    return as_sentence(capitalised(one.says))


def with_evidence(m: Matcher, one: Mistake, exact: bool | None = None) -> Finding:
    """Return what is said of a mistake, and how well it explains the answers."""
    exact = m.exact(one.redo) if exact is None else exact
    how = m.with_error(one.does(evidence(exact)))
    says = _sentence(one)
    if OF_THE_CODE.search(says) and is_in_another_form(m):
        says = f"{ALONE}{as_sentence(one.says)}"
    return Finding(one.slug, f"{says} {how}")


def in_another_order(m: Matcher) -> Finding | None:
    """Return that a function's results stand in another order, if so."""
    kinds = m.ask.kinds
    for order in list(permutations(range(len(kinds))))[1:]:
        if _as_made(m, lambda T, order=order: tuple(T[i] for i in order)):
            names = [kinds[i].called or f"result {i + 1}" for i in range(len(kinds))]
            says = "The results are in the wrong order. Expected: "
            return Finding("answers-swapped", f"{says}{', then '.join(names)}.")
    return None


def of_the_kind(m: Matcher, digits: bool = True) -> Finding | None:
    """Return what any answer of this kind may have: one result is changed."""
    for i, kind in enumerate(m.ask.kinds):
        for one in kind.general():
            made = partial(_with_result, i, one.redo)
            again = _as_made(m, made)
            exact = equals(m.ask.kinds, m.S, again)
            told = again and again[i].any()  # of zeros any mistake may be said
            if told and (exact or not digits):
                found = with_evidence(m, one, exact)
                called = kind.called if len(m.S) > 1 else ""
                return Finding(found.slug, of_result(found.message, called))
    return None


def of_answers(m: Matcher) -> Finding | None:
    """Return a change of the finished answer that gives the student's."""
    for says, change in () if m.whole else changes.of_answer():
        for i in [None, *range(len(m.T))] if len(m.T) > 1 else [0]:
            made = partial(_with_result, i, change)
            again = _as_made(m, made)
            if again and equals(m.ask.kinds, m.S, again):
                return _changed_answer(m, i, says)
    return None


def _changed_answer(m: Matcher, i: int | None, says: str) -> Finding:
    called = m.ask.kinds[i].called if i is not None and len(m.T) > 1 else ""
    how = m.with_error(f"{REDONE} {evidence(True)}")
    says = f"Your code returns {says.format('the correct result')}. {how}"
    return Finding("answer-changed", of_result(says, called))


def _with_result(i: int | None, change: Code, T: Parts) -> Parts:
    """Return answers with one result changed, or all."""
    if i is None:
        return tuple(np.asarray(change(t)) for t in T)
    return (*T[:i], np.asarray(change(T[i])), *T[i + 1 :])


def _as_made(m: Matcher, made: Any) -> Parts:
    """Return the main answers made of the right ones if they explain all; or ()."""
    found: Parts = ()
    for calls in filter(None, (m.fresh, m.main)):
        try:
            again = parts(made(calls.T))
        except (ValueError, IndexError, np.linalg.LinAlgError):  # it has no answer here
            return ()
        if not calls.difference.explained(again).all():
            return ()
        found = again
    return found if m.main.difference.differs(found) else ()


def of_arguments(m: Matcher, digits: bool = True) -> Finding | None:
    """Return that the answers are the right ones to other arguments.

    Such as two exchanged, or one of the other sign: it needs no name.
    """
    for one, code, answer in () if m.whole else with_other_arguments(m):
        if not digits and one.slug not in changes.LIKELY:
            continue  # a small number is nearly 0, whatever it is divided by
        if m.main.difference.fits(m.i, answer, digits) and m.holds(code, digits):
            if one.slug in changes.OF_UNITS and (unit := _in_another_unit(m)):
                return unit
            says = f"Your code {one.says}."
            redone = "the reference solution with this change"
            how = m.with_error(f"{redone} {evidence(m.exact(code))}")
            return Finding(f"argument-{one.slug}", f"{says} {how}")
    return None


def _in_another_unit(m: Matcher) -> Finding | None:
    """Return that the one result is 1000 times the right one, or a thousandth of it."""
    kind, *others = m.ask.kinds
    return None if others or not kind.unit else one_factor(kind, m.S[0], m.T[0])


def with_other_arguments(m: Matcher) -> Iterator[tuple[changes.Change, Code, Parts]]:
    """Yield changes of arguments, with what is right after each, at one call."""
    if m.right is None:
        return
    call, names = m.main.each[m.i], m.case.names
    known: list[Any] = m.known.setdefault("arguments", [])
    some = chain(changes.likely(call, names), changes.others(call, names))
    yield from known
    for one in islice(some, len(known), None):
        if m.effort.spent(KEEP_OF_ARGUMENTS):
            return
        code = partial(after, m.right, one.change)
        left = _leaves(one.change, call)
        answer = () if left else m.main.answer(code, m.i)
        known.append((one, code, answer))
        m.effort.spend(0 if left else m.lines)
        yield known[-1]


def _leaves(change: Code, call: tuple[Any, ...]) -> bool:
    """Return whether a change leaves a call's arguments as they are, or has none."""
    try:
        pairs = zip(change(*map(own, call)), call, strict=True)
        return all(one is it or np.array_equal(one, it) for one, it in pairs)
    except Exception:  # it is none of this call
        return True


def after(function: Code, change: Code, *args: Any) -> Any:
    """Return the answer to changed arguments."""
    return function(*change(*args))


def likely_mutants(m: Matcher) -> Finding | None:
    """Return a near mutant that gives all answers, where it can be shown.

    What is so of the answers themselves says more than a mutant without a place.
    """
    found = [one for one in _that_hold(m, NEAR) if shows(m, one)]
    named = of_mutants(m, found) if found else None
    return of_answers(m) or named if named and named.by_output else named


def in_own_line(m: Matcher) -> Finding | None:
    """Return a near mutant that gives all answers and is in the student's own line.

    Which answers are NaN is little evidence, and the line is the rest of it.
    """
    found = [one for one in _that_hold(m, NEAR) if own_line(m, one)]
    return of_mutants(m, found) if found else None


def other_mutants(m: Matcher) -> Finding | None:
    """Return any mutant that gives all answers and says enough without a place.

    The same numbers come from other algorithms, where "a condition is wrong" without
    the place of one names a part that the student's function may not have.
    """
    for which in (NEAR, FURTHER):
        some = _that_hold(m, which)
        if found := [one for one in some if shows(m, one) or tells_of(m, one)]:
            return of_mutants(m, found)
    return None


def _that_hold(m: Matcher, which: str) -> list[Mutant]:
    """Return a few mutants that give all answers; of whole numbers the only one.

    Args:
        m: the matcher.
        which: `NEAR`, one place that a hand may mistype; `FURTHER`, all others.
    """
    if which in m.known:
        return m.known[which]
    m.known[which] = found = list[Mutant]()
    if m.whole and _wrong_calls(m) < AGREE:
        return found
    screened = (one for one, answer in answered(m, which) if _fits(m, answer))
    for one in islice(screened, SEVERAL):
        told = m.whole or shows(m, one) or tells_of(m, one)
        apart = not any(one.overlaps(other) for other in found)
        code = one.code
        may_be = has_its_kind(m, one) and is_in_its_form(m, one)
        if code and told and apart and may_be and m.holds(code):
            found.append(one)
            if len(found) >= APART:
                break
    if m.whole and len(found) > 1:
        found.clear()
    return found


def _wrong_calls(m: Matcher) -> int:
    some = [m.main, m.fresh] if m.fresh else [m.main]
    return sum(
        int(np.sum(m.ask.gaps(one.S, one.T) > m.ask.near)) for one in some if one
    )


def _fits(m: Matcher, answer: Parts) -> bool:
    return m.main.difference.fits(m.i, answer, digits=True)


def answered(m: Matcher, which: str) -> Iterator[tuple[Mutant, Parts]]:
    """Yield the mutants with their answers to one call, as far as the effort goes."""
    mine = m.known.setdefault("answered", [])
    for one, answer, lines in _made(m, which):
        if m.effort.spent(KEEP[which]):
            return
        m.effort.spend(lines)
        mine.append((one, answer))
        yield one, answer


def _made(m: Matcher, which: str) -> Iterator[tuple[Mutant, Parts, int]]:
    """Yield the mutants, their answers and what these took, each made once.

    The calls are the same at every check, so a class, or a file that is watched, is
    compared with the same ones.
    """
    shapes = (t.shape[1:] for t in m.T)  # to which an answer is filled up
    key = (id(m.ask), which, *map(content, m.main.each[m.i]), *shapes)
    if key not in _MADE:
        while len(_MADE) >= KEPT:
            del _MADE[next(iter(_MADE))]
        some = (b.closest() if which == NEAR else b.further() for b in m.bodies)
        made = (
            (one, m.main.answer(code, m.i), one.body.steps.taken)
            for one, code in chain.from_iterable(some)
        )
        _MADE[key] = m.ask, [], made
    _, known, more = _MADE[key]
    for k in count():
        if k == len(known):
            if (one := next(more, None)) is None:
                return
            known.append(one)
        yield known[k]


def answered_near(m: Matcher) -> list[tuple[Mutant, Parts]]:
    """Return the near mutants of the lab's own body with their answers to one call."""
    known: list[tuple[Mutant, Parts]] = m.known.get("answered", [])
    own = [pair for pair in known if pair[0].body is m.bodies[0]]
    return [pair for pair in own if pair[0].rank < FAR and len(pair[0].edits) == 1]
