"""In which cases a wrong function is right: "It is correct for parallel segments".

The author of a row names cases of its calls. They are counted among the calls that were
asked, and each is tried at fresh inputs: at fifty that are of the case, and at fifty
that are not where a sentence says "only". A case that one call contradicts is not
listed as right, nor as wrong. Further calls of a case can only contradict: calls with
sizes that its calls do not have, and calls of a right case that have arguments of a
call that was answered wrongly.
"""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np

from labkit.base.exchange import Exchange, Question, Reply
from labkit.judge import valid
from labkit.judge.answers import capitalised, listed
from labkit.judge.ask import Ask, Asked, as_plain, right_answers
from labkit.judge.carried import carried
from labkit.judge.crossed import crossed
from labkit.judge.draw import Draw
from labkit.judge.merged import merged
from labkit.judge.mistake import Finding
from labkit.judge.replies_read import read
from labkit.judge.resized import resized

ASKED = 5  # calls of a case, and others, that were asked before it is tried
TRIED = 50  # fresh calls of a case at which a sentence is tried, at least
EACH = 2  # calls of a case that one generator yields in a round, at most
ROUNDS = 100  # generators that draw them, at most
SECONDS = 1.5  # for drawing and comparing them, and as many for the replies
CARRIED = 120  # calls of a case with arguments of others, at most
BATCH = 40  # calls that are asked at once
LISTED = 4  # cases in one list, at most
ALWAYS = "wrong in every test"  # of some other call it may be right by chance
SEED = 5947  # of the fresh inputs: none of the asked ones
RIGHT, CLOSE, WRONG, NONE = "right", "close", "wrong", ""
Call = tuple[Any, ...]
Cases = Mapping[str, Callable[[Call], bool]]  # by phrase, "parallel segments"
Answered = Sequence[tuple[Call, str]]  # calls with their verdicts


def of_call(holds: Callable[..., bool], call: Call) -> bool:
    """Return whether a row's condition is true of a call; False where it stops."""
    try:
        with np.errstate(all="ignore"):
            return bool(holds(*map(as_plain, call)))
    except Exception:  # the condition divides by one that is 0, say
        return False


def verdict(ask: Ask, exchange: Exchange) -> str:
    """Return how an answer stands; one that is missing or not finite is wrong.

    It is NONE of a mixed call that has no right answer.
    """
    try:
        T = right_answers(ask, [exchange])
    except Exception:  # no path of no points, say
        return NONE
    if any(np.isnan(t).any() for t in T):
        return NONE
    S = read([exchange], ask)
    if isinstance(S, Finding):
        return WRONG
    S = valid.taken(ask, [exchange], S)
    if any(s.shape != t.shape for s, t in zip(S, T, strict=True)):
        return WRONG
    off = float(ask.gaps(S, T).max())
    if off <= ask.tolerance:
        return RIGHT
    return CLOSE if off <= ask.near else WRONG


@dataclass(frozen=True)
class Tally:
    """The calls of one case, and those of none: how they were answered."""

    asked: Sequence[str]  # verdicts
    fresh: Sequence[str]

    @property
    def enough(self) -> bool:
        """Whether there were calls enough for a sentence.

        Where few of a case are always asked, the first fresh ones stand in for them.
        """
        n = len(self.fresh)
        return n >= TRIED and len(self.asked) + n >= ASKED + TRIED

    def all(self, status: str) -> bool:
        """Return whether every call has this verdict, and there are enough."""
        return self.enough and set(self.asked) | set(self.fresh) == {status}

    @property
    def mixed(self) -> bool:
        """Whether some calls are right, and some are wrong."""
        every = [*self.asked, *self.fresh]
        return len(every) >= ASKED and {RIGHT, WRONG} <= set(every)


def in_cases(
    asked: Asked, reply_to: Callable[[Sequence[Question]], Sequence[Reply]]
) -> str:
    """Return in which of its row's cases a wrong function is right, or "".

    Args:
        asked: what it was asked.
        reply_to: asks it further questions.
    """
    ask = asked.ask
    if not ask.cases or ask.truth is None:
        return ""
    known = [*asked.main, *asked.fresh]
    lists = [{says: _kept(holds) for says, holds in some.items()} for some in ask.cases]
    old = [(e.question.args, verdict(ask, e)) for e in known]
    left: list[Cases] = [some for some in lists if _may_be_right(some, old)]
    new = list(_tried(asked, old, left, reply_to)) if left else []
    if told := _first_that_stays(asked, left, old, new, reply_to):
        return told
    return in_all_cases(lists[0], old, new)


def _may_be_right(cases: Cases, known: Answered) -> bool:
    """Return whether a case has no call that is known to be answered wrongly.

    Without one there is nothing to say of a list, and no fresh call changes that.
    """
    bad = [call for call, how in known if how != RIGHT]
    return any(not any(map(holds, bad)) for holds in cases.values())


def _tried(
    asked: Asked,
    old: Answered,
    lists: Sequence[Cases],
    reply_to: Callable[[Sequence[Question]], Sequence[Reply]],
) -> Iterator[tuple[Call, str]]:
    """Yield fresh calls with their verdicts, until these leave no case to be right."""
    calls = fresh_calls(asked.ask, [call for call, _ in old], lists)
    known = [*old]
    waited = 0.0
    while waited < SECONDS and any(_may_be_right(one, known) for one in lists):
        some = list(islice(calls, BATCH))
        if not some:
            return
        began = time.monotonic()
        replied = _answered(asked, some, reply_to)
        waited += time.monotonic() - began
        for one in replied:
            if how := verdict(asked.ask, one):
                known.append((one.question.args, how))
                yield known[-1]


def _first_that_stays(
    asked: Asked,
    lists: Sequence[Cases],
    old: Answered,
    new: Answered,
    reply_to: Callable[[Sequence[Question]], Sequence[Reply]],
) -> str:
    """Return the sentence that leaves the fewest calls open, or "".

    Before a list is told, calls are made that may contradict its cases.
    """
    against: dict[int, Set[str]] = {}
    while True:
        told = [
            (*found, i)
            for i, some in enumerate(lists)
            if (found := sentence(some, old, new, against.get(i, frozenset())))
        ]
        if not told:
            return ""
        _, says, i = min(told, key=lambda one: one[0])
        if i in against:
            return says
        against[i] = _contradicted(asked, lists[i], [*old, *new], reply_to)


def _contradicted(
    asked: Asked,
    cases: Cases,
    known: Answered,
    reply_to: Callable[[Sequence[Question]], Sequence[Reply]],
) -> Set[str]:
    """Return the cases with one verdict, which calls that are made do not repeat."""
    told = {p: {how for call, how in known if of(call)} for p, of in cases.items()}
    some = [phrase for phrase in cases if told[phrase] in ({RIGHT}, {WRONG})]
    return {
        phrase
        for phrase in some
        if any(
            how not in (NONE, *told[phrase]) and (how, told[phrase]) != (CLOSE, {WRONG})
            for how in _of_made(asked, cases[phrase], known, reply_to, len(some))
        )
    }


def _of_made(
    asked: Asked,
    holds: Callable[[Call], bool],
    known: Answered,
    reply_to: Callable[[Sequence[Question]], Sequence[Reply]],
    n: int,
) -> Iterator[str]:
    """Yield the verdicts on calls that are made of a case, which is one of n."""
    calls = _made(asked.ask, holds, known)
    waited = 0.0
    while waited < SECONDS / n and (some := list(islice(calls, BATCH))):
        began = time.monotonic()
        replied = _answered(asked, some, reply_to)
        waited += time.monotonic() - began
        yield from (verdict(asked.ask, one) for one in replied)


def _made(ask: Ask, holds: Callable[[Call], bool], known: Answered) -> Iterator[Call]:
    """Yield calls of a case that has one verdict: resized, and carried into it.

    Those of a wrong case have no entry twice: with equal ones, a wrong function may be
    right.
    """
    every = [call for call, _ in known]
    of_case = [call for call in every if holds(call)]
    right = all(how == RIGHT for call, how in known if holds(call))
    for call in resized(of_case, every, twice=right):
        if _asked_for(ask, holds, call):
            yield call
    if right:
        others = [call for call, how in known if how != RIGHT]
        more = carried(of_case, others, every)
        fitting = (call for call in more if _asked_for(ask, holds, call))
        yield from islice(fitting, min(CARRIED, ask.each_case // 2))


def _asked_for(ask: Ask, holds: Callable[[Call], bool], call: Call) -> bool:
    """Return whether a call is of a case, and one that the row allows."""
    return holds(call) and (ask.at_edge is None or of_call(ask.at_edge, call))


def _answered(
    asked: Asked,
    calls: Sequence[Call],
    reply_to: Callable[[Sequence[Question]], Sequence[Reply]],
) -> list[Exchange]:
    """Return calls with their replies."""
    task = asked.main[0].question.task
    some = [Question(task, asked.function, call) for call in calls]
    return list(map(Exchange, some, reply_to(some))) if some else []


def _kept(holds: Callable[..., bool]) -> Callable[[Call], bool]:
    """Return a condition of a call that is asked once of each call."""
    known: dict[int, tuple[Call, bool]] = {}  # an id stays that of a call

    def of(call: Call) -> bool:
        if id(call) not in known:
            known[id(call)] = call, of_call(holds, call)
        return known[id(call)][1]

    return of


def sentence(
    cases: Cases, old: Answered, new: Answered, contradicted: Set[str] = frozenset()
) -> tuple[int, str] | None:
    """Return what is said of one list of cases, and how many calls it leaves open.

    Args:
        cases: by phrase.
        old: the calls that were asked.
        new: the fresh ones.
        contradicted: the cases of which nothing is said; nor is "only" then.
    """
    tallies, others = {}, {}
    for phrase, holds in cases.items():
        tallies[phrase] = Tally(*(_of(some, holds, True) for some in (old, new)))
        others[phrase] = Tally(*(_of(some, holds, False) for some in (old, new)))
    asked = [p for p in cases if p not in contradicted]
    right = [p for p in asked if tallies[p].all(RIGHT)]
    wrong = [p for p in asked if tallies[p].all(WRONG)]
    mixed = [p for p in cases if tallies[p].mixed]
    left = sum(len(tallies[p].asked) for p in cases if p not in right + wrong)
    if not right or not wrong + mixed:
        return None
    if len(right) > LISTED and len(wrong + mixed) == 1 and not contradicted:
        (one,) = wrong + mixed
        if others[one].all(RIGHT) and tallies[one].enough:
            how = "sometimes wrong, but" if mixed else "wrong"
            return left, f"The result is {how} only for {one}."
    return left, _told(*(merged(some)[:LISTED] for some in (right, wrong, mixed)))


def _told(*lists: Sequence[str]) -> str:
    """Return the cases that are right, wrong and mixed: two sentences, or a list."""
    every = [phrase for some in lists for phrase in some]
    if len(every) > LISTED or any("," in phrase for phrase in every):
        hows = ("Correct", capitalised(ALWAYS), "Sometimes wrong")
        labels = zip(hows, lists, strict=True)
        return " ".join(f"{how}: {'; '.join(some)}." for how, some in labels if some)
    right, *others = lists
    pairs = zip((ALWAYS, "sometimes wrong"), others, strict=True)
    bad = [f"{how} for {listed(some)}" for how, some in pairs if some]
    return f"The result is correct for {listed(right)}. It is {', and '.join(bad)}."


def in_all_cases(cases: Cases, old: Answered, new: Answered) -> str:
    """Return that no case is right, where some call of each is wrong.

    Where every call that was asked is wrong, that was said before.
    """
    if all(told == WRONG for _, told in old):
        return ""
    wrong = [call for call, told in (*old, *new) if told == WRONG]
    if not all(any(of(call) for call in wrong) for of in cases.values()):
        return ""
    first = next(iter(cases))
    return f"Even for {first}, the result is sometimes wrong."


def _of(some: Answered, holds: Callable[[Call], bool], of: bool) -> list[str]:
    """Return the verdicts on the calls of a case, or on those that are not of it."""
    return [told for call, told in some if holds(call) is of]


def fresh_calls(
    ask: Ask, known: Sequence[Call], lists: Sequence[Cases]
) -> Iterator[Call]:
    """Yield fresh calls, enough of each case where the row's generators draw them."""
    wanted = [holds for some in lists for holds in some.values()]
    counts = [0] * len(wanted)
    for some, each in _rounds(ask, known):
        before = [*counts]
        for call in some:
            left = (i for i, n in enumerate(counts) if n < ask.each_case)
            of = [i for i in left if wanted[i](call)]
            if any(counts[i] < before[i] + each for i in of):
                for i in of:
                    counts[i] += 1
                yield call
        if min(counts) >= ask.each_case:
            return


def drawn(ask: Ask, known: Sequence[Call]) -> Iterator[Call]:
    """Yield fresh calls: of rare cases, mixed ones, and as the row draws them."""
    for some, _ in _rounds(ask, known):
        yield from some


def _rounds(ask: Ask, known: Sequence[Call]) -> Iterator[tuple[list[Call], int]]:
    """Yield fresh calls of rare cases, mixed and drawn ones, and how many of a case.

    The calls that a generator of rare cases yields at once may have numbers in common,
    so two of each case are taken at most.
    """
    end = time.process_time() + SECONDS
    mixed = _mixed(ask, known)
    lists = _lists(known)
    slow = False  # a generator that tries until a call fits may be
    for n in range(ROUNDS):
        if (begin := time.process_time()) > end:
            return
        seed = [SEED, n]
        some = [tuple(call) for draw in ask.rare for call in draw(Draw(seed))]
        drawing = np.random.default_rng(seed)
        some = [some[i] for i in drawing.permutation(len(some))]
        yield some, EACH
        yield list(_longer(ask, some, lists, drawing)), EACH
        yield mixed[4 * n : 4 * n + 4], 1
        if ask.drawn and not slow:
            some = [tuple(call) for call in ask.inputs(Draw(seed))][-ask.drawn :]
            yield [some[i] for i in drawing.permutation(len(some))], EACH
            slow = bool(ask.rare) and time.process_time() - begin > SECONDS / 10


def _mixed(ask: Ask, known: Sequence[Call]) -> list[Call]:
    """Return calls whose arguments are those of several others, at their ends too."""
    shapes: dict[Any, list[Call]] = {}
    for call in known:
        shapes.setdefault(tuple(np.shape(x) for x in call), []).append(call)
    alike = max(shapes.values(), key=len)
    return [c for c in crossed(alike) if _allowed(ask, c)]


def _allowed(ask: Ask, call: Call) -> bool:
    """Return whether a call that was put together may be asked."""
    return ask.at_edge is None or of_call(ask.at_edge, call)


def _lists(known: Sequence[Call]) -> dict[int, list[Any]]:
    """Return the arguments that are lists of any number of rows, each with its values.

    Such as the discs of a world. The rows of one whose number is that of another
    argument belong to the rows of this one, so they are no such list.
    """
    columns = list(zip(*known, strict=False))
    sizes = [[_rows(x, 2) for x in column] for column in columns]
    firsts = [[_rows(x) for x in column] for column in columns]
    return {
        k: [x for x in columns[k] if len(x)]
        for k, some in enumerate(sizes)
        if min(some) >= 0
        and len(set(some)) > 1
        and len({x.shape[1] for x in columns[k]}) == 1
        and not any(some == other for m, other in enumerate(firsts) if m != k)
    }


def _rows(x: Any, axes: int = 0) -> int:
    """Return how many rows an array of some axes has, of any without; else -1."""
    fits = isinstance(x, np.ndarray) and x.ndim and (not axes or x.ndim == axes)
    return len(x) if fits else -1


def _longer(
    ask: Ask,
    some: Sequence[Call],
    lists: Mapping[int, list[Any]],
    rng: np.random.Generator,
) -> Iterator[Call]:
    """Yield calls with the rows of another call's list before or after their own."""
    for call in some:
        for k, values in lists.items():
            if k >= len(call) or _rows(call[k], 2) < 0:
                continue
            more = values[int(rng.integers(len(values)))]
            if _allowed(ask, (*call[:k], more, *call[k + 1 :])):
                both = [call[k], more][:: int(rng.choice([-1, 1]))]
                yield (*call[:k], np.concatenate(both), *call[k + 1 :])
