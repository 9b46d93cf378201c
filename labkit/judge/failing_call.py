"""The call that failed, as a student can type it; what is wrong at fresh inputs."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from labkit.base.exchange import Exchange, Question
from labkit.judge import replies_read
from labkit.judge.answers import (
    Parts,
    Several,
    difference,
    gap,
    in_calls,
    worst_part,
)
from labkit.judge.ask import Ask, Asked, HeldOut, of_complex, right_answers
from labkit.judge.kinds import Kind
from labkit.judge.mistake import Compared, Example, Finding
from labkit.judge.replies_read import not_accepted, read
from labkit.judge.results import not_split, places, split
from labkit.judge.typed import shown, typed, typed_one
from labkit.judge.valid import taken
from robo47.checks import Array

# A call whose answer is not right: in a line, "Rz(2.9)[0, 0] is -1, and -0.971 is
# right.", and in lines with every argument and entry; "" and none without one.
LONG = 80  # characters; a longer argument goes by its name, and --explain has all of it
LARGEST = 8  # rows and columns of a matrix that is shown


class Failing(NamedTuple):
    """A call that failed."""

    call: str = ""
    whole: tuple[str, ...] = ()  # every argument and entry, a line each
    compared: Compared | None = None
    example: Example | None = None


AS_FAR = 0.999  # of the furthest: as far off, so that rounding does not choose
CLEARLY = 0.1  # of the furthest: far enough off that the difference is seen
SHOWN = ("not-an-array", "not-an-index", "another-word")  # a word, or one number
MISFITS = ("shape", "parts", *SHOWN)  # answers that cannot be compared
DUST = 1e-12  # of an entry's scale: rounding, whose digits are the processor's


def failing_call(asked: Asked, names: Sequence[str] = ()) -> Failing:
    """Return a wrong call that is easy to work out, one of those always asked if any.

    Among the calls that are clearly wrong it has the shortest arguments: zeros, round
    numbers and small matrices, where such a call is wrong.
    """
    held_out = zip(asked.held_out, asked.ask.held_out, strict=True)
    for some, held in [(asked.main, None), (asked.fresh, None), *held_out]:
        if held and any(of_complex(one.question) for one in some):
            continue  # pairs of numbers, which nobody types
        if held and held.mistaken and not _is_wrong(held, asked.ask, some):
            continue
        found = _broken(some, names) or _misfit(asked, some, names)
        if found := found or _wrong(asked, some, held, names):
            return found
    failing = [one for one, _ in not_accepted(asked)]
    for one in failing[:1]:
        assert one.reply
        yours = (f"returned: {shown(one.reply.value)}",)
        which = "One" if len(failing) > 1 else "The"
        says = f"{which} failing call: {typed(one.question, names)}."
        whole = _given(one.question, names) + yours
        return Failing(says, whole, None, Example(one.question, one.reply.value))
    return Failing()


def gives_away(held: HeldOut, ask: Ask, exchanges: Sequence[Exchange]) -> bool:
    """Return whether answers to held-out questions give the mistake away."""
    S = read(exchanges, ask)
    if isinstance(S, Finding):
        return held.mistaken is None  # no answer is no sign of one certain mistake
    S = S if held.mistaken else taken(ask, exchanges, S)
    off = any(ask.too_far(held, S, right_answers(ask, exchanges, held)))
    return off != bool(held.mistaken)


def _is_wrong(held: HeldOut, ask: Ask, exchanges: Sequence[Exchange]) -> bool:
    """Return whether answers are those of a mistake; a close one needs no example."""
    return held.status == "wrong" and gives_away(held, ask, exchanges)


def _broken(exchanges: Sequence[Exchange], names: Sequence[str]) -> Failing | None:
    for one in exchanges:
        if one.reply and (one.reply.kind or one.reply.value is None):
            what = "stopped with an error" if one.reply.kind else "returned None"
            says = f"{typed(one.question, names)} {what}."
            whole = _given(one.question, names)
            return Failing(says, whole, None, Example(one.question))
    return None


def _misfit(
    asked: Asked, exchanges: Sequence[Exchange], names: Sequence[str]
) -> Failing | None:
    """Return the first call whose answer is not of the kind that is expected.

    Like the message, it is about the first result that does not fit in some call.
    """
    misfits = []
    for one in exchanges:
        found = read([one], asked.ask)
        if isinstance(found, Finding) and found.slug in MISFITS and one.reply:
            misfits.append((one, *_misfitting(asked.ask, one.reply.value)))
    if not misfits:
        return None
    one, _, place, what = min(misfits, key=lambda misfit: misfit[1])
    call = typed(one.question, names, LONG)
    whole = _given(one.question, names)
    return Failing(
        f"{call}{place} returned {what}.", whole, None, Example(one.question)
    )


def _misfitting(ask: Ask, value: Any) -> tuple[int, str, str]:
    """Return which result does not fit first, its place, and what it is.

    An answer without its results is no result: -1.
    """
    if unsplit := not_split(ask.kind, value):
        return -1, *unsplit
    parts = split(ask.kind, value)
    assert not isinstance(parts, Finding)  # it was read before
    rows = zip(places(ask.kind), ask.kinds, parts, strict=True)
    for j, (place, kind, part) in enumerate(rows):
        if isinstance(found := kind.read([part]), Finding):
            return j, place, _briefly(part) if found.slug in SHOWN else _shape(part)
    return len(ask.kinds), "", _shape(value)


def _briefly(value: Any) -> str:
    text = shown(value)
    return text if len(text) <= LONG else f"{text[:LONG]}..."


def _shape(value: Any) -> str:
    try:
        return f"shape {np.shape(value)}" if np.shape(value) else "a single number"
    except ValueError:
        return "parts of different shapes"


def _wrong(
    asked: Asked,
    exchanges: Sequence[Exchange],
    held: HeldOut | None,
    names: Sequence[str],
) -> Failing | None:
    ask = asked.ask
    one = _chosen(ask, exchanges, held)
    if one is None:
        return None
    given = read([one], ask)  # alone, in their own shapes
    assert one.reply
    assert not isinstance(given, Finding)
    right = right_answers(ask, [one])
    part = _wrong_part(ask, exchanges, given, right)
    place, entries = _entry(ask.kinds[part], given[part][0], right[part][0])
    says = f"{typed(one.question, names, LONG)}{places(ask.kind)[part]}{place}"
    whole = [*_given(one.question, names)]
    mine = split(ask.kind, one.reply.value)
    assert not isinstance(mine, Finding)
    whole += [f"returned: {shown(value)}" for value in mine]
    pairs = zip(ask.kinds, right, strict=True)
    whole += [f"expected: {shown(kind.sent(values[0]))}" for kind, values in pairs]
    compared = _compared(ask, part, given[part][0], right[part][0])
    example = Example(one.question, one.reply.value, tuple(x[0] for x in right))
    return Failing(f"{says} {entries}.", tuple(whole), compared, example)


def shown_among(asked: Asked) -> NDArray[np.bool_]:
    """Return which of the main calls is the failing call that is shown, (n,)."""
    one = _chosen(asked.ask, asked.main, None)
    return np.array([other is one for other in asked.main])


def _chosen(
    ask: Ask, exchanges: Sequence[Exchange], held: HeldOut | None
) -> Exchange | None:
    """Return the wrong call that is easy to work out; None if no answer is wrong."""
    if not exchanges or not ask.truth:
        return None
    S = read(exchanges, ask)
    if isinstance(S, Finding):
        return None
    S = taken(ask, exchanges, S)
    T = right_answers(ask, exchanges)
    relative = held is not None and held.relative
    gap = ask.shares(S, T) if relative else ask.gaps(S, T)
    limit = 1.0 if relative else ask.tolerance
    if held and held.mistaken:  # its answers may be nearly right
        limit = 0.0
    off = {i for i, *_ in replies_read.wrong_sizes(ask, exchanges)}
    if off:  # which the message is about; zeros that fill an answer up may be right
        gap = np.where([i in off for i in range(len(gap))], np.inf, 0.0)
    if not (gap > limit).any():
        return None
    # What is said is of the first result that is wrong in some call: one of these.
    first = worst_part(ask.kinds, S, T, ask.tolerance)
    of_it = ask.gaps_of(first, S[first], T[first])
    if of_it.max() > ask.tolerance and not relative and not off:
        gap = of_it
    return _easiest(exchanges, gap, limit)


def _wrong_part(
    ask: Ask, exchanges: Sequence[Exchange], given: Parts, right: Parts
) -> int:
    """Return the result of a wrong shape that the message names, else the wrong one."""
    off = [k for k in range(len(given)) if given[k].shape != right[k].shape]
    named = [k for _, k, *_ in replies_read.wrong_sizes(ask, exchanges)]
    for k in [k for k in named if k in off] + off:
        return k
    return worst_part(ask.kinds, given, right, ask.tolerance)


def _compared(ask: Ask, part: int, mine: Array, its: Array) -> Compared | None:
    """Return a matrix with some right entries beside the right one, else None."""
    if mine.shape != its.shape or mine.ndim != 2 or max(mine.shape) > LARGEST:
        return None
    scale = np.broadcast_to(ask.kinds[part].scale, its.shape)
    wrong = ~(gap(mine, its) <= ask.tolerance * scale)
    return Compared(mine, its, wrong) if wrong.any() and not wrong.all() else None


def _entry(kind: Kind, mine: Array, its: Array) -> tuple[str, str]:
    """Return the place of the largest error, and "returned 1; expected 2" of it."""
    if kind.is_none(mine) or kind.is_none(its):
        return "", f"returned {_part(kind, mine)}; expected {_part(kind, its)}"
    if mine.shape != its.shape:
        return "", f"returned shape {mine.shape}; expected shape {its.shape}"
    apart = gap(mine, its) / kind.scale
    at = np.unravel_index(_furthest(apart), mine.shape)
    place = str([int(x) for x in at]) if at else ""
    if kind.whole:
        yours, right = (shown(kind.sent(x[at])) for x in (mine, its))
        return place, f"returned {yours}; expected {right}"
    dust = DUST * np.broadcast_to(kind.scale, its.shape)[at]
    pair = (0.0 if abs(x[at]) < dust else x[at] for x in (mine, its))
    return place, f"returned {_apart(*pair)}"


def _easiest(exchanges: Sequence[Exchange], off: Array, limit: float) -> Exchange:
    """Return the call with the shortest arguments among those that are clearly off.

    A call with an argument of zeros is a special case, which stands for itself.
    """
    clearly = np.flatnonzero((off > limit) & (off >= CLEARLY * np.max(off)))
    some = [exchanges[int(i)] for i in clearly]
    return min(some, key=lambda one: (_zeros(one.question), _length(one.question)))


def _zeros(question: Question) -> int:
    """Return how many arguments have numbers, all of them 0."""
    columns = [[*_numbers(arg)] for arg in question.args]
    return sum(bool(column) and not any(column) for column in columns)


def _length(question: Question) -> int:
    """Return how many characters the arguments take, each number in six digits."""
    numbers = [x for arg in question.args for x in _numbers(arg)]
    return sum(len(f"{x:.6g}") for x in numbers)


def _numbers(arg: Any) -> Iterator[float]:
    """Yield the numbers of an argument; other things have none."""
    if isinstance(arg, tuple | list):
        for one in arg:
            yield from _numbers(one)
    elif np.asarray(arg).dtype.kind in "biuf":
        yield from np.ravel(arg).astype(float)


def _furthest(off: Array) -> int:
    """Return the place of the first that is as far off as any; infinity is, too."""
    return int(np.argmax(off >= AS_FAR * np.max(off)))


def _part(kind: Kind, answer: Array) -> str:
    return "None" if kind.is_none(answer) else "an answer"


def for_fresh(asked: Asked, main: Parts, S: Parts | Finding) -> Finding:
    """Return what is wrong with answers to inputs that are not always asked.

    That answers were looked up is said only where all are wrong, and each is one that
    another input has got.
    """
    right = "The result is correct in the calls that every check makes, but"
    if isinstance(S, Finding):
        says = f"{right} not in calls with new random inputs. {S.message}"
        return Finding("some-inputs", says)
    S = taken(asked.ask, asked.fresh, S)
    T = right_answers(asked.ask, asked.fresh)
    wrong = asked.ask.gaps(S, T) > asked.ask.near
    often = in_calls(int(wrong.sum()), len(wrong))
    says = f"{right} it is wrong {often} with new random inputs."
    if wrong.all() and _only_known(main, S):
        return Finding("looked-up", f"{says} The results do not depend on the inputs.")
    some = "Do some inputs take another branch of your function?"
    return Finding("some-inputs", says if wrong.all() else f"{says} {some}")


def _only_known(main: Parts, S: Parts) -> bool:
    """Return whether each answer is the same as one to another input."""
    rows, known = (np.hstack([p.reshape(len(p), -1) for p in x]) for x in (S, main))
    others = [np.vstack([known, np.delete(rows, i, 0)]) for i in range(len(rows))]
    pairs = zip(others, rows, strict=True)
    return all(difference(rest, row).min() < 1e-9 for rest, row in pairs)


def _given(question: Question, names: Sequence[str]) -> tuple[str, ...]:
    """Return the call, and each argument that is too long for it."""
    found = [f"call: {typed(question, names, LONG)}"]
    for i, arg in enumerate(question.args):
        several = isinstance(arg, Several)
        array = isinstance(arg, np.ndarray)
        if several or (array and (arg.ndim > 1 or len(typed_one(arg)) > LONG)):
            name = names[i] if len(names) >= len(question.args) else f"argument {i + 1}"
            found.append(f"{name} = {shown(arg)}")
    return tuple(found)


def _apart(mine: float, its: float) -> str:
    """Return two numbers with as many digits as tell them apart."""
    for digits in (6, 10, 17):
        one, other = (f"{x + 0.0:.{digits}g}" for x in (mine, its))
        if one != other:
            break
    return f"{one}; expected {other}"
