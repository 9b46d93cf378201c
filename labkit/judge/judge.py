"""The judge: from a function's questions and replies to a verdict and its name."""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import compress
from typing import Any

import numpy as np

from labkit.base.exchange import Exchange
from labkit.judge import (
    near_miss,
    odd_answers,
    pairs,
    replies_read,
    sources,
    tried,
    valid,
)
from labkit.judge.answers import (
    ERROR,
    Parts,
    as_one,
    capitalised,
    difference,
    in_calls,
    is_or_are,
    listed,
    of_result,
    plain,
    say_error,
    worst_part,
)
from labkit.judge.ask import (
    Ask,
    Asked,
    Case,
    Further,
    HeldOut,
    replies,
    right_answers,
    stacked,
)
from labkit.judge.effort import Effort
from labkit.judge.failing_call import (
    Failing,
    failing_call,
    for_fresh,
    gives_away,
    shown_among,
)
from labkit.judge.guard import attempt, noting, quiet, told
from labkit.judge.in_part import by_results, in_some_calls
from labkit.judge.kinds import Kind
from labkit.judge.matcher import Matcher
from labkit.judge.mistake import Finding, Verdict
from labkit.judge.typed import in_words
from robo47.checks import Array

# What a kind says of answers with the number of calls in it.
COUNTED = ("too-often-true", "too-seldom-true", "both-ways")
PLACED = re.compile(r"\bfor |line \d|`")  # a change that has a place
NO_CALL = ("kept-between-calls", "draws-itself")  # the same call gives something else


def judge(asked: Asked, source: str = "", names: Sequence[str] = ()) -> Verdict:
    """Return what the replies to a function's questions show.

    Args:
        asked: the questions, with their replies.
        source: the student's file, for slips that show in it.
        names: of the function's arguments, for sentences.

    Raises:
        ValueError: a question has no reply.
    """
    asked = replace(asked, source=source)
    with quiet(), noting() as stopped:
        verdict = attempt(_judge, asked, source, names)
        verdict = verdict or attempt(_without_a_name, asked) or unjudged(stopped)
        if verdict.status != "passed" and verdict.mistake not in NO_CALL:
            failed = attempt(failing_call, asked, names, otherwise=Failing())
            measured = verdict.measured + failed.whole
            verdict = replace(
                verdict,
                measured=measured,
                call=failed.call,
                compared=failed.compared,
                example=failed.example,
            )
    if verdict.status in ("passed", "todo"):
        return verdict
    return replace(verdict, message=f"{verdict.message} {told(stopped)}".strip())


def unjudged(stopped: list[str]) -> Verdict:
    """Return the verdict on answers that the checker cannot compare."""
    return Verdict("todo", "unjudged", f"The task is not judged. {told(stopped)}")


def _without_a_name(asked: Asked) -> Verdict | None:
    """Return what is certain of wrong answers; None where they may be right."""
    S = replies_read.read(asked.main, asked.ask)
    if isinstance(S, Finding):
        return Verdict("wrong", *S)
    if asked.ask.accept:
        refused = (found for _, found in replies_read.not_accepted(asked))
        return next((Verdict("wrong", *found) for found in refused), None)
    if found := replies_read.of_another_size(asked):
        return Verdict("wrong", *found)
    S = valid.taken(asked.ask, asked.main, S)
    gap = asked.ask.gaps(S, right_answers(asked.ask, asked.main))
    if gap.max() <= asked.ask.tolerance:
        return None
    return Verdict("wrong", *_by_how_much(gap, asked.ask.tolerance))


def _by_how_much(gap: Array, tolerance: float) -> Finding:
    """Return how many answers are right, and how far the others are off at worst."""
    wrong = int(np.sum(gap > tolerance))
    right = f"The result is wrong {in_calls(wrong, len(gap))}."
    if not np.isfinite(worst := gap.max()):
        return Finding("off", right)
    return Finding("off", f"{right} {say_error(f'{worst:.2g}')}")


def _judge(asked: Asked, source: str, names: Sequence[str]) -> Verdict:
    S = replies_read.read(asked.main, asked.ask, source)
    if isinstance(S, Finding):
        if S.slug == "shape":
            S = attempt(_of_odd_shapes, asked, S, otherwise=S)
        return Verdict("wrong", *_beside(S, asked, names))
    if other := attempt(_by_another_method, asked, S, names):
        return Verdict("wrong", other.slug, other.message, valid=True)
    if found := replies_read.of_another_size(asked):
        return Verdict("wrong", *_of_another_size(asked, S, names, found))
    if found := replies_read.kept_state(asked, source):
        return Verdict("wrong", *found)
    S = valid.taken(asked.ask, asked.main, S)
    judge_these = _judge_accepted if asked.ask.accept else _judge_values
    return judge_these(asked, S, names)


def _by_another_method(asked: Asked, S: Parts, names: Sequence[str]) -> Finding | None:
    """Return that answers are valid, by another method than the one asked for."""
    ask = asked.ask
    if not valid.by_another_method(asked):
        return None
    named: Finding | None
    if sizes := replies_read.of_another_size(asked):
        named = _of_another_size(asked, S, names, sizes)
        named = None if named.slug == sizes.slug else named
    else:
        T = right_answers(ask, asked.main)
        if ask.gaps(S, T).max() <= ask.near:
            return None
        case = _case(asked, S, T, names)
        named = sources.named(ask, case.arguments, S, T) or _unnamed(case)
    if named:
        first = re.split(r"(?<=\.) (?=[A-Z])", ask.method)[0]  # it has a remedy, too
        return Finding(named.slug, f"{first} {named.message}")
    return Finding("another-method", ask.method)


def _judge_values(asked: Asked, S: Parts, names: Sequence[str]) -> Verdict:
    ask = asked.ask
    T = right_answers(ask, asked.main)
    case = _case(asked, S, T, names)
    gap = ask.gaps(S, T)
    measured = attempt(_measured, case, S, T, gap, otherwise=())
    if (off := gap.max()) > ask.near:
        whole = any(kind.whole for kind in ask.kinds)
        failing = attempt(shown_among, asked) if whole else None
        case = replace(case, further=attempt(_further, asked), failing=failing)
        case, S, T = _with_answers(case, S, T)
        m = Matcher(case, S, T)
        named: Finding | None = attempt(_explained, m)
        located: Finding | None = None if named else attempt(_located, m)
        if told_all := named or (None if ask.cases else located):
            return Verdict("wrong", *told_all, measured, by_output=told_all.by_output)
        wrong = tuple(np.flatnonzero(gap > ask.near).tolist())
        plainly = _by_how_much(gap, ask.tolerance)
        found: Finding = located or attempt(
            what_is_wrong, case, S, T, otherwise=plainly
        )
        return Verdict("wrong", *found, measured, wrong_calls=wrong)
    if off > ask.tolerance:
        found = _near_miss(asked, case, S, T, off)
        if held := _far_off(asked):
            says = f"{held.message} {found.message}"
            return Verdict("wrong", held.slug, says, measured)
        return Verdict("close", *found, measured)
    return _judge_right(asked, S, measured)


def _of_another_size(
    asked: Asked, S: Parts, names: Sequence[str], found: Finding
) -> Finding:
    """Return what answers of wrong sizes come from; the row may know more of them."""
    named = attempt(_of_odd_shapes, asked, found, otherwise=found)
    telling = asked.ask.unnamed and replies_read.of_another_length(asked)
    if named is not found or not asked.ask.unnamed or not telling:
        return named
    T = right_answers(asked.ask, asked.main)
    return asked.ask.unnamed(_case(asked, S, T, names)) or found


def _of_odd_shapes(asked: Asked, found: Finding) -> Finding:
    """Return what arrays of wrong shapes come from, or what was found."""
    named = odd_answers.named(asked, found)
    return odd_answers.in_another_order(asked, found) if named is found else named


def _beside(found: Finding, asked: Asked, names: Sequence[str]) -> Finding:
    """Return why some answers cannot be judged, and what is wrong with the others."""
    good = [e for e in asked.main if e.reply and e.reply.value is not None]
    S = replies_read.read(good, asked.ask) if good else found
    if isinstance(S, Finding) or asked.ask.accept:
        return found
    named = attempt(odd_answers.stops_alike, asked, found, otherwise=found)
    if named is not found:
        return named
    rest = replace(asked, main=good, probes=[])
    if sizes := replies_read.of_another_size(rest, other=True):
        other = _of_another_size(rest, S, names, sizes)
        return Finding(found.slug, f"{found.message} {other.message}")
    T = right_answers(asked.ask, good)
    case = replace(_case(rest, S, T, names), further=attempt(_further, asked))
    return attempt(_both, found, case, S, T, otherwise=found)


def _both(
    found: Finding, case: Case, S: Parts, T: Parts, effort: Effort | None = None
) -> Finding:
    wrong = case.ask.gaps(S, T) > case.ask.near
    if not wrong.any():
        return found
    # One answer alone may be that of many mistakes.
    named = attempt(diagnose, case, S, T, effort) if wrong.sum() > 1 else None
    other = named or what_is_wrong(case, S, T, counted=False)
    often = in_calls(int(wrong.sum()), len(wrong), other=True)
    these = " in these calls" if len(wrong) > 1 else ""
    why = other.message.replace(" in every call", these)
    says = f"{found.message} The result is also wrong {often}. {why}"
    return Finding(named.slug if named else found.slug, says)


def _near_miss(asked: Asked, case: Case, S: Parts, T: Parts, off: float) -> Finding:
    if off <= near_miss.SINGLE and near_miss.single_precision(replies(asked.main), S):
        says = "The result has only 7 correct digits, because it is in float32. Use "
        says += "float64."
        return Finding("float32", says)
    i = worst_part(case.ask.kinds, S, T, case.ask.near)
    found = case.ask.near_miss(case) if case.ask.near_miss else None
    return found or near_miss.explain(S[i], T[i])


def _judge_right(asked: Asked, main: Parts, measured: tuple[str, ...]) -> Verdict:
    """Return the verdict on right answers: how did they come about?"""
    ask = asked.ask
    replied = replies([*asked.main, *asked.fresh])
    if shared := replies_read.shared_memory(replied, ask.copies):
        return Verdict("wrong", *shared, measured)
    if asked.fresh and ask.truth:
        S = replies_read.read(asked.fresh, ask)
        off = np.inf
        if not isinstance(S, Finding):
            S = valid.taken(ask, asked.fresh, S)
            gap = ask.gaps(S, right_answers(ask, asked.fresh))
            off = float(gap.max())
            lines = _counted(ask, gap, "with new random inputs")
            measured += lines[1:]
        if off > ask.near:
            if np.isfinite(off):  # of the others only that they are right
                measured = (measured[1], *lines)
            return Verdict("wrong", *for_fresh(asked, main, S), measured)
    for held, exchanges in zip(ask.held_out, asked.held_out, strict=True):
        if gives_away(held, ask, exchanges):
            return Verdict(held.status, *_of_held_out(held, asked, exchanges), measured)
    return Verdict("passed", measured=measured)


def _far_off(asked: Asked) -> Finding | None:
    """Return what held-out questions show, if answers with few digits are wrong there.

    Those that ask for more digits than the main questions are not asked.
    """
    ask = asked.ask
    for held, exchanges in zip(ask.held_out, asked.held_out, strict=True):
        stricter = held.relative or (held.near or ask.near) < ask.near
        loose = held.of_close and not (stricter or held.mistaken)
        if held.status == "wrong" and loose and gives_away(held, ask, exchanges):
            return _of_held_out(held, asked, exchanges)
    return None


def _of_held_out(held: HeldOut, asked: Asked, exchanges: Sequence[Exchange]) -> Finding:
    """Return what is said of held-out questions that gave a mistake away."""
    if held.told is None:
        return Finding(held.slug, held.says)
    wrong = [gives_away(held, asked.ask, [one]) for one in exchanges]
    failing = list(compress(exchanges, wrong))
    right = compress(exchanges, [not one for one in wrong])
    return Finding(held.slug, held.told(failing, [*asked.main, *right]))


def _further(asked: Asked) -> Further | None:
    """Return the fresh questions that have an answer, NaN where a kind has it; or None.

    A NaN confirms or refutes a mistake as a number does.
    """
    answered = [(one, replies_read.read([one], asked.ask)) for one in asked.fresh]
    good = [one for one, S in answered if not isinstance(S, Finding)]
    sizes = replies_read.sizes(asked.ask, good) if good else ()
    off = {i for i, _, got, right in sizes if got != right}
    good = [one for i, one in enumerate(good) if i not in off]
    if not good:
        return None
    S = replies_read.read(good, asked.ask)
    if isinstance(S, Finding):
        return None
    S = valid.taken(asked.ask, good, S)
    return Further(stacked(good), S, right_answers(asked.ask, good))


def _judge_accepted(asked: Asked, S: Parts, names: Sequence[str]) -> Verdict:
    """Return the verdict of a function to which many answers are right."""
    ask = asked.ask
    fresh = replies_read.read(asked.fresh, ask)
    if isinstance(fresh, Finding):
        return Verdict("wrong", *fresh)
    wrong = list(replies_read.not_accepted(asked))
    if not wrong:
        return _judge_right(asked, S, ())
    if named := sources.of_accepted(ask, stacked(asked.main), S):
        return Verdict("wrong", *named)
    _, found = wrong[0]
    often = sum(other.slug == found.slug for _, other in wrong)
    where = in_calls(often, len(asked.main) + len(asked.fresh))
    return Verdict("wrong", found.slug, f"{found.message} This happens {where}.")


def _case(asked: Asked, S: Parts, T: Parts, names: Sequence[str]) -> Case:
    answered = zip(asked.probes, replies(asked.probes), strict=True)
    probes = [
        (probe.question.args, None if reply.kind else reply.value)
        for probe, reply in answered
    ]
    given = [in_words(exchange.question, names) for exchange in asked.main]
    return Case(
        asked.ask,
        stacked(asked.main),
        plain(S),
        plain(T),
        given,
        probes,
        names=names,
        source=asked.source,
    )


def _measured(case: Case, S: Parts, T: Parts, gap: Array) -> tuple[str, ...]:
    ask = case.ask
    lines = list(_counted(ask, gap, "that every check makes"))
    for kind, s, t in zip(ask.kinds, S, T, strict=True):
        lines += kind.measured(s, t)
    return (*lines, *(ask.measured(case) if ask.measured else ()))


def _counted(ask: Ask, gap: Array, which: str) -> tuple[str, str]:
    """Return how far off calls are by their gaps, and how many are right."""
    more = f" + {ask.rtol:.3g} of the largest entry" if ask.rtol else ""
    right = int(np.sum(gap <= ask.tolerance))
    return (
        f"largest error of an entry: {gap.max():.2g} (call {np.argmax(gap) + 1} of "
        f"{len(gap)}; tolerance: {ask.tolerance:.0e}{more})",
        f"correct calls: {right} of {len(gap)} {which}",
    )


def diagnose(
    case: Case, S: Parts, T: Parts, effort: Effort | None = None
) -> Finding | None:
    """Return what explains the answers, all or some of them, or None.

    Args:
        case: what was asked.
        S: the student's answers.
        T: the right ones.
        effort: what is left of a larger search.
    """
    m = Matcher(case, S, T, effort=effort or Effort())
    return _explained(m) or _located(m)


def _explained(m: Matcher) -> Finding | None:
    """Return what the first source says that explains the answers, or None."""
    found = next(filter(None, (attempt(source, m) for source in SOURCES)), None)
    if found and found.slug.startswith("slip-"):
        return _with_its_place(m.case, found)
    i = worst_part(m.ask.kinds, m.S, m.T, m.ask.near)
    return found or near_miss.rounded(m.S[i], m.T[i])


def _located(m: Matcher) -> Finding | None:
    """Return what the row, or some of the answers, say of a mistake without a name."""
    return _with_its_size(m.case, m.S, m.T) or in_some_calls(m)


def _with_its_size(case: Case, S: Parts, T: Parts) -> Finding | None:
    """Return what the row says of answers without a name, and how far these are off."""
    found = _unnamed(case)
    kinds = case.ask.kinds
    if found is None or re.search(r"\d", found.message) or any(k.whole for k in kinds):
        return found
    k = worst_part(kinds, S, T, case.ask.near)
    error = say_error(kinds[k].apart(S[k], T[k]))
    return Finding(found.slug, f"{found.message} {error}")


def _unnamed(case: Case) -> Finding | None:
    """Return what the row says of answers that no named mistake gives."""
    try:
        return case.ask.unnamed(case) if case.ask.unnamed else None
    except np.linalg.LinAlgError:  # of a singular answer
        return None


def _with_its_place(case: Case, slip: Finding) -> Finding:
    """Return a slip, and before it where the row says that answers go wrong."""
    where = _unnamed(case) if case.ask.before_slips else None
    if where is None or case.ask.unnamed_names or not PLACED.search(slip.message):
        return where or slip
    return Finding(where.slug, f"{where.message} {slip.message}")


def _not_finite(m: Matcher) -> Finding | None:
    """Return that some answers are NaN, and what is wrong with the others."""
    case, S, T = m.case, m.S, m.T
    # An infinity may be right: only what is none of the right one is said to be odd.
    pairs = zip(S, T, strict=True)
    there = [(np.isfinite(s) | (s == t)).reshape(len(s), -1) for s, t in pairs]
    good = np.all([one.all(axis=1) for one in there], axis=0)
    if good.all():
        return None
    often = in_calls(int(np.sum(~good)), len(good))
    says = f"Your function returns {_odd(m)} {often}{_expected_infinity(m)}."
    found = Finding("not-finite", says)
    if not good.any():
        return found
    rest, S, T = _only(good, case, S, T)
    both = _both(found, rest, S, T, m.effort)
    if both is found and (slip := sources.in_own_line(m)):
        return Finding(found.slug, f"{found.message} {slip.message}")
    return both


def _odd(m: Matcher) -> str:
    """Return what is returned that is no number, and in which of several results."""
    pairs = zip(m.ask.kinds, m.S, m.T, strict=True)
    odd = [(kind, s[~np.isfinite(s) & (s != t)]) for kind, s, t in pairs]
    every = np.concatenate([some for _, some in odd])
    kinds = {"NaN": np.isnan(every), "infinity": every > 0, "-infinity": every < 0}
    says = " or ".join(word for word, there in kinds.items() if there.any())
    names = [kind.called for kind, some in odd if some.size]
    where = f" for {listed(names)}" if len(m.S) > 1 and all(names) else ""
    return f"{says}{where}"


def _expected_infinity(m: Matcher) -> str:
    """Return that an infinity is expected where there is none, or ""."""
    pairs = zip(m.S, m.T, strict=True)
    right = [t[~np.isfinite(s) & (s != t)] for s, t in pairs]
    some = set(np.concatenate(right).tolist())
    word = {(np.inf,): "infinity", (-np.inf,): "-infinity"}.get(tuple(some), "")
    return f"; expected {word}" if word else ""


def _only(good: Array, case: Case, S: Parts, T: Parts) -> tuple[Case, Parts, Parts]:
    """Return some of the questions alone, with their answers."""
    S, T = tuple(s[good] for s in S), tuple(t[good] for t in T)
    arguments = tuple(
        a[good] if isinstance(a, np.ndarray) else a for a in case.arguments
    )
    given = list(compress(case.given, good))
    failing = None if case.failing is None else case.failing[good]
    rest = replace(
        case, arguments=arguments, S=plain(S), T=plain(T), given=given, failing=failing
    )
    return rest, S, T


def _with_answers(case: Case, S: Parts, T: Parts) -> tuple[Case, Parts, Parts]:
    """Return the questions to which None is not both the answer and the right one."""
    pairs = zip(S, T, case.ask.kinds, strict=True)
    nones = [_none(s, kind) & _none(t, kind) for s, t, kind in pairs if kind.none]
    both = np.any(nones, axis=0) if nones else np.zeros(len(S[0]), bool)
    return _only(~both, case, S, T) if both.any() else (case, S, T)


def _none(some: Array, kind: Kind) -> Any:
    return np.array([kind.is_none(answer) for answer in some])


def _none_or_not(m: Matcher) -> Finding | None:
    """Return that it is None where there is an answer, or the other way round."""
    S = m.S
    for s, t, kind in zip(m.S, m.T, m.ask.kinds, strict=True):
        if not kind.none:
            continue
        lost, made = _none(s, kind) & ~_none(t, kind), _none(t, kind) & ~_none(s, kind)
        if not (lost.any() or made.any()):
            continue
        n, says = len(s), []
        if lost.any():
            often = in_calls(int(lost.sum()), n)
            says.append(f"Your function returns None {often}; expected an answer.")
        if made.any():
            often = in_calls(int(made.sum()), n)
            which = f"; expected None ({kind.none})."
            says.append(f"Your function returns an answer {often}{which}")
        called = kind.called if len(S) > 1 else ""
        return Finding("none-or-not", of_result(" ".join(says), called))
    return None


def what_is_wrong(case: Case, S: Parts, T: Parts, counted: bool = True) -> Finding:
    """Return which part of the answers is wrong, by how much, and in how many calls.

    Args:
        case: what was asked.
        S: the student's answers.
        T: the right ones.
        counted: whether the wrong calls are counted.
    """
    ask = case.ask
    i = worst_part(case.ask.kinds, S, T, case.ask.near)
    kind = ask.kinds[i]
    found = tried.what_is_wrong(case, S, T, i)
    if (says := kind.diverges(S[i], T[i])) and not kind.whole:
        found = Finding(found.slug, says)
    where = ""
    if found.slug != "one-factor-off":  # every entry, so where does not matter
        where = tried.in_common(case, S, T, i)
        wrong = difference(S[i], T[i], kind.scale, ask.rtol) > ask.tolerance
        some = not wrong.all() or found.message.startswith(ERROR)
        if counted and some and found.slug not in COUNTED:
            found = _in_some_calls(found, int(wrong.sum()), len(wrong))
    says = of_result(found.message, kind.called if len(S) > 1 else "")
    says = f"{_right_results(case, S, T)}{says}{where}{_wrong_too(case, S, T, i)}"
    return Finding(found.slug, says)


def _in_some_calls(found: Finding, wrong: int, calls: int) -> Finding:
    """Return a finding with the number of wrong calls, before how far they are off."""
    often = f"The result is wrong {in_calls(wrong, calls)}."
    says, error, off = found.message.partition(ERROR)
    parts = [says.strip(), often, error + off]
    return Finding(found.slug, " ".join(filter(None, parts)))


def _wrong_too(case: Case, S: Parts, T: Parts, i: int) -> str:
    """Return which results but the i-th are wrong, and in how many calls, or ""."""
    says = ""
    for j, kind in enumerate(case.ask.kinds):
        n = int(np.sum(case.ask.gaps_of(j, S[j], T[j]) > case.ask.near))
        if j != i and n and kind.called:
            many = in_calls(n, len(S[j]))
            verb = is_or_are([kind.called])
            says += f" {capitalised(kind.called)} {verb} wrong {many}, too."
    return says


def _right_results(case: Case, S: Parts, T: Parts) -> str:
    """Return which results of several are right, of fresh inputs as well, or ""."""
    sets = [(S, T)]
    if case.further:
        sets.append((case.further.S, case.further.T))
    names = [
        kind.called
        for j, kind in enumerate(case.ask.kinds)
        if kind.called
        and all(case.ask.gaps_of(j, s[j], t[j]).max() <= case.ask.near for s, t in sets)
    ]
    if len(S) < 2 or not names:
        return ""
    return f"{capitalised(listed(names))} {is_or_are(names)} correct. "


def _nothing_there(m: Matcher) -> Finding | None:
    every = (*m.S, *m.fresh.S) if m.fresh else m.S
    if any(part.any() or not part.size for part in every):
        return None  # of no entry nobody says that it is 0
    if not all(kind.empty for kind in m.ask.kinds):
        return None
    if all(part[0].size == 1 for part in m.S):
        return Finding("all-zeros", "Your result is 0 for every input.")
    says = "Every entry of your output is 0 for every input. Did you create the array "
    says += "but never fill it?"
    if {"model", "data"} & set(m.case.names):
        says += " If you copied the values from `data`, note that they are 0 until "
        says += "`mj_forward` is called."
    return Finding("all-zeros", says)


def _all_the_same(m: Matcher) -> Finding | None:
    """Return that the answer does not depend on the input, though it should."""
    i = worst_part(m.ask.kinds, m.S, m.T, m.ask.near)
    kind, S = m.ask.kinds[i], m.S[i]
    every = (S, m.fresh.S[i]) if m.fresh else (S,)
    whole = as_one([answer for some in every for answer in some])
    if len(S) < 2 or difference(whole, whole[0]).max() > 1e-8:
        return None
    off = kind.largest_error(S, m.T[i])
    square = S.ndim == 3 and S.shape[1] == S.shape[2]
    if square and np.array_equal(S[0], np.eye(S.shape[1])):
        says = f"Your function returns the identity matrix for every input. {off}"
        return Finding("always-the-identity", says)
    says = "Your result is the same for every input, but it should depend on the input."
    return Finding("ignores-its-input", f"{says} {off}")


# What may explain answers, in the order in which it is asked. What shows in the answers
# themselves stands before two mistakes at once, which are less simple.
SOURCES: Sequence[Callable[[Matcher], Finding | None]] = (
    sources.authors,
    sources.in_another_order,
    sources.of_the_kind,
    _nothing_there,
    _none_or_not,
    _not_finite,
    _all_the_same,
    sources.likely_mutants,
    sources.of_arguments,
    pairs.two_at_once,
    sources.of_answers,
    sources.other_mutants,
    sources.nearly,
    pairs.beside,
    by_results,
    pairs.second,
)
