"""Controlled experiments on a wrong function: with which argument neutral it is right.

"The result is correct whenever `ed` is 0, and whenever `M` is the identity" says which
term is wrong where no named mistake fits. It is said only where it was tried: at the
calls that were answered wrongly, made neutral, and then at fifty inputs and more of
both signs and several sizes, and then at fresh calls. Each round is one batch of
questions.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import accumulate, chain, compress, islice
from typing import Any

import numpy as np

from labkit.base.exchange import Question, Reply
from labkit.judge.answers import InTurn, own, say_factor
from labkit.judge.ask import Ask, Asked, as_plain
from labkit.judge.cases import RIGHT, drawn, of_call, verdict
from labkit.judge.crossed import crossed
from labkit.judge.neutral import SIZES, Neutral, neutrals, scaled
from labkit.judge.ranges import Span, spans
from labkit.judge.replies_read import flat
from labkit.judge.resized import has_one, one_of_them, sizes_by_axis, with_one
from robo47.checks import Array

QUESTIONS = 6  # per experiment; five of them at least must agree
AGREE = 5
FEW = 8  # fresh calls in which another argument is made neutral, too
ALIKE = 3  # answers that grow by one factor, at least
TRIED = 50  # inputs at which a sentence is tried, at least
NOTHING = 1e-12  # a right answer as small as this says nothing
ROUNDING = 1e-9  # what sums of larger numbers may leave of a small answer
COMMON = 0.5  # the share of other wrong functions that may be right there as well
OTHERS = 12  # of them are asked
LISTED = 1 / 3  # the share of calls that have a list so, where that is worth saying
Call = tuple[Any, ...]  # its arguments
# From calls to the answers of a function, None where there is none, which says nothing.
AGREES = 1e-3  # by which part of itself an answer may miss a factor
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
    seen = experiments(asked, wrong, names, reply_to)
    if any(len(names) != len(call) for call in seen.calls):
        return ""
    if any(kind.whole for kind in ask.kinds):
        return seen.neutral(_others(ask))  # a count or a truth value does not grow
    return seen.told(_others(ask))


def experiments(
    asked: Asked,
    wrong: Sequence[int],
    names: Sequence[str],
    reply_to: Callable[[Sequence[Question]], Sequence[Reply]],
) -> "Experiments":
    """Return the experiments on a wrong function, from what `right_when` takes."""
    ask = asked.ask
    task = asked.main[0].question.task
    known = [*asked.main, *asked.fresh]
    right = [verdict(ask, one) == RIGHT for one in known]
    calls = [asked.main[i].question.args for i in wrong]
    shapes = [np.shape(x) for x in calls[-1]]
    fresh_right = right[len(asked.main) :]
    fresh = compress(asked.fresh, [not good for good in fresh_right])
    more = [one.question.args for one in fresh]
    more = [call for call in more if [np.shape(x) for x in call] == shapes]

    def mine(some: Sequence[Call]) -> list[Any]:
        questions = [Question(task, asked.function, call) for call in some]
        return [None if r.kind else r.value for r in reply_to(questions)]

    assert isinstance(ask.truth, InTurn)
    return Experiments(
        [*more, *calls][-QUESTIONS:],
        names,
        mine,
        _answers_of(ask.truth),
        max(ask.tolerance, ask.rtol),
        [one.question.args for one in known],
        right,
        ask.conditions,
        ask.at_edge,
        partial(_drawn, ask, calls),
    )


def _drawn(ask: Ask, known: Sequence[Call]) -> list[Call]:
    """Return fresh calls with as many arguments as one that is known, rare ones too."""
    alike = (call for call in drawn(ask, known) if len(call) == len(known[0]))
    return list(islice(alike, 4 * TRIED))


def _others(ask: Ask) -> list[Answers]:
    """Return the row's named mistakes: what is true of most of them says nothing."""
    return [_answers_of(m.redo) for m in ask.named if isinstance(m.redo, InTurn)]


@dataclass(frozen=True)
class Claim:
    """A sentence about a call, mostly of one argument, and inputs that satisfy it."""

    k: int  # which argument; -1 of several
    says: str  # "whenever ed is 0", "for `0 < theta < pi`"
    calls: Sequence[Call]  # at which it is first tried
    holds: Callable[[Call], bool]  # whether a call satisfies it
    more: Callable[[], Sequence[Call]]  # those at which it is tried then
    changed: float = 0.0  # how many numbers of a call that changes
    # Of any call, those that satisfy it and differ from it in this argument alone.
    made: Callable[[Call], Sequence[Call]] = lambda call: ()


@dataclass(frozen=True)
class Experiments:
    """A wrong function beside the right one."""

    calls: Sequence[Call]  # answered wrongly; their arguments have the same shapes
    names: Sequence[str]  # of the arguments
    mine: Answers  # the function
    truth: Answers  # the right answers
    near: float  # how far off a right answer may be, relative to its largest entry
    known: Sequence[Call] = ()  # all that it was asked
    right: Sequence[bool] = ()  # of each of those whether it was answered rightly
    conditions: Sequence[tuple[str, Callable[..., bool]]] = ()  # as in an `Ask`
    at_edge: Callable[..., bool] | None = None  # as in an `Ask`
    drawn: Callable[[], Sequence[Call]] = list  # fresh calls, those of rare cases too

    def told(self, others: Sequence[Answers] = ()) -> str:
        """Return what all experiments show, in words."""
        return f"{self.neutral(others)} {self.doubled()}".strip()

    def neutral(self, others: Sequence[Answers] = ()) -> str:
        """Return which arguments, neutral, make the answers right, in words, or "".

        Args:
            others: other wrong functions. What is true of most of them says nothing.
        """
        says = [claim.says for claim in self.tested(others)]
        return f"The result is correct {', and '.join(says)}." if says else ""

    def tested(self, others: Sequence[Answers] = ()) -> list[Claim]:
        """Return what holds, the most telling first: two claims at most."""
        claims = [*self._stated(), *self._sizes(), *self._ranges(), *self._claims()]
        claims = [one for one in claims if not self._refuted(one)]
        first = self._each([one.calls for one in claims])
        telling = []
        for i, (claim, given) in enumerate(zip(claims, first, strict=True)):
            if self._right(given, claim.calls):
                right = [self._right(f(claim.calls), claim.calls)
                         for f in others[:OTHERS]]  # fmt: skip
                share = sum(right) / max(1, len(right))
                if share <= COMMON or not claim.changed:
                    order = (claim.k >= 0, share, claim.changed, i)
                    telling.append((order, claim))
        telling.sort(key=lambda one: one[0])
        tried = [(claim, list(claim.more())) for _, claim in telling]
        found: dict[int, Claim] = {}  # of each argument the most telling
        answers = self._each([some for _, some in tried])
        for (claim, some), given in zip(tried, answers, strict=True):
            if self._right(given, some, TRIED // 2, TRIED):
                found.setdefault(claim.k, claim)
        return [claim for claim in [*found.values()][:2] if self._holds_fresh(claim)]

    def _holds_fresh(self, claim: Claim) -> bool:
        """Return whether no fresh call that satisfies a claim is answered wrongly."""
        made = [
            one
            for call in self.drawn()
            for one in ([call] if claim.holds(call) else claim.made(call)[:1])
        ]
        made += [two for one in made[:FEW] for two in _with_another_neutral(claim, one)]
        some = list(filter(self._definite, made))
        pairs = zip(self.mine(some), self.truth(some), strict=True)
        return all(self._is_right(answer, its) is not False for answer, its in pairs)

    def doubled(self) -> str:
        """Return that answers do not grow with an argument as the right ones, or ""."""
        for k, grew, its in self._that_grow():
            name = f"`{self.names[k]}`{_sized(self.calls[0][k])}"
            if np.isclose(grew, 1.0, rtol=self.near):
                if not self._grows_fresh(k, grew):
                    continue
                says = f"If {name} is doubled, your result stays the same"
                return f"{says}, but it should change."
            if its is not None and self._grows_fresh(k, grew, its):
                should = f"become {say_factor(its)} times as large"
                if np.isclose(its, 1.0, rtol=self.near):
                    should = "stay the same"
                return (
                    f"If {name} is doubled, your result becomes {say_factor(grew)} "
                    f"times as large, but it should {should}."
                )
        return ""

    def _that_grow(self) -> Iterator[tuple[int, float, float | None]]:
        """Yield the arguments with which answers do not grow as the right ones.

        With each stand the factor of the student's answers and that of the right ones.
        The first calls are asked alone: of most functions nothing is to be tried then.
        """
        some = [*self.calls, *self._others()]
        doubled = {
            k: _doubled(self.calls, k)
            for k in range(len(self.names))
            if all(_may_be_doubled(call[k]) for call in self.calls)
            and not any(np.any(self._fixed(k, call[k])) for call in self.calls)
            and all(isinstance(call[k], float | np.ndarray) for call in some)
        }
        before, *after = self._each([self.calls, *doubled.values()])
        base = list(self.truth(self.calls))
        for (k, twice), given in zip(doubled.items(), after, strict=True):
            right = list(self.truth(twice))
            if any(answer is None for answer in right):
                continue
            grew, its = self._growth(before, given), self._growth(base, right)
            if grew is None or (its is not None and np.isclose(grew, its, rtol=1e-3)):
                continue
            always = self._growth(*self._each([some, _doubled(some, k)]))
            if always is not None and np.isclose(always, grew, rtol=1e-3):
                yield k, grew, its

    def _grows_fresh(self, k: int, grew: float, its: float | None = None) -> bool:
        """Return whether the fresh answers grow by these factors, too.

        Args:
            k: which argument is doubled.
            grew: the factor of the student's answers.
            its: that of the right ones; None where they need not have one.
        """
        first = self.calls[0][k]
        some = [
            call
            for call in self.drawn()
            if isinstance(call[k], float | np.ndarray)
            and _may_be_doubled(call[k])
            and _sized(call[k]) == _sized(first)
        ]
        twice = _doubled(some, k)
        before, after = self._each([some, twice])
        if not _all_grew(before, after, grew):
            return False
        return its is None or _all_grew(self.truth(some), self.truth(twice), its)

    def _refuted(self, claim: Claim) -> bool:
        """Return whether a call that was answered wrongly satisfies a claim."""
        wrong = [c for c, ok in zip(self.known, self.right, strict=False) if not ok]
        return any(map(claim.holds, (*self.calls, *wrong)))

    def _each(self, rounds: Sequence[Sequence[Call]]) -> list[list[Any]]:
        """Return the function's answers to several rounds, asked at once."""
        if not (whole := list(chain(*rounds))):
            return [[] for _ in rounds]
        given = list(self.mine(whole))
        ends = list(accumulate(map(len, rounds)))
        pairs = zip([0, *ends], ends, strict=False)
        return [given[begin:end] for begin, end in pairs]

    def _others(self) -> list[Call]:
        """Return further calls to try, of other inputs and other sizes."""
        shapes = [np.shape(x) for x in self.calls[0]]
        known = [c for c in self.known if [np.shape(x) for x in c] == shapes][-TRIED:]
        some = [*known, *self.calls]
        resized = [
            tuple(scaled(x, size, self._fixed(k, x)) for k, x in enumerate(call))
            for size in SIZES
            for call in some[-(TRIED // len(SIZES) + 1) :]
        ]
        return [*known, *resized]

    def _of_other_sizes(self) -> list[Call]:
        """Return what was asked with arguments of other shapes: it must hold there."""
        shapes = [np.shape(x) for x in self.calls[0]]
        other = [c for c in self.known if [np.shape(x) for x in c] != shapes]
        return [c for c in other if len(c) == len(shapes)][:TRIED]

    def _fixed(self, k: int, x: Any) -> Any:
        """Return which entries of a matrix no question changes, such as K's last 1.

        They say what kind of matrix it is; with another one there it is none.
        """
        shape = np.shape(x)
        if len(shape) != 2:
            return False
        alike = [c[k] for c in (*self.known, *self.calls) if np.shape(c[k]) == shape]
        stacked = np.array(alike, dtype=float)
        same = (stacked == stacked[0]).all(axis=0) & (stacked[0] != 0)
        return same if len(alike) >= ALIKE and not same.all() else False

    def _claims(self) -> Iterator[Claim]:
        """Yield that an argument is neutral, in every way that all calls have."""
        for k, column in enumerate(zip(*self.calls, strict=True)):
            for choices in zip(*map(neutrals, column), strict=False):
                first = choices[0]
                if len({one.says for one in choices}) > 1 or self._idle(k, first):
                    continue
                values = [one.value for one in choices]
                pairs = zip(column, values, strict=True)
                changed = float(np.mean([np.sum(np.not_equal(x, v)) for x, v in pairs]))
                if changed:
                    says = f"whenever {first.says.format(self.names[k])}"
                    calls = _with(self.calls, k, values)
                    more = self._more(k, first)
                    holds = partial(_of_argument, k, first.holds)
                    made = partial(_neutral_in, k, first)
                    yield Claim(k, says, calls, holds, more, changed, made)

    def _idle(self, k: int, neutral: Neutral) -> bool:
        """Return whether a list of rows is neutral in a way that hardly a call has it.

        Worlds of discs and trees of nodes have any number of rows. One of as many rows
        as columns is no square matrix, and it is never asked with all of them 0.
        """
        alike = [c[k] for c in self.known if k < len(c) and np.ndim(c[k]) == 2]
        if len({len(x) for x in alike}) < 2 or len({x.shape[1] for x in alike}) > 1:
            return False
        return sum(map(neutral.holds, alike)) < LISTED * len(alike)

    def _more(self, k: int, neutral: Neutral) -> Callable[[], list[Call]]:
        def more() -> list[Call]:
            found = []
            for n, call in enumerate([*self._others(), *self._of_other_sizes()]):
                again = [one for one in neutrals(call[k]) if one.says == neutral.says]
                for one in again:
                    values = [*one.others, one.value]
                    found.append((*call[:k], values[n % len(values)], *call[k + 1 :]))
                    if n < TRIED:  # another of its values, of the same call
                        m = (7 * n + 3) % len(values)
                        found.append((*call[:k], values[m], *call[k + 1 :]))
            return found

        return more

    def _stated(self) -> Iterator[Claim]:
        """Yield the row's own conditions, of several arguments, as asked."""
        mixed = self._crossed() if self.conditions else []
        some = [*self.known, *filter(self._definite, mixed)]
        for says, holds in self.conditions:
            of = partial(of_call, holds)
            kept = [call for call in some if of(call)]
            first = kept[: QUESTIONS + 2]
            yield Claim(-1, f"whenever {says}", first, of, partial(list, kept))

    def _ranges(self) -> Iterator[Claim]:
        """Yield in which range of a number, or of entries, it is right, as asked."""
        for k, x in enumerate(self.calls[0]):
            column = [call[k] for call in self.known]
            for one in spans(x, column, self.right):
                says = one.says.format(self.names[k])
                calls = self._spanned(k, one, self.calls, QUESTIONS + 2)
                holds = partial(_of_argument, k, one.holds)
                yield Claim(k, says, calls, holds, partial(self._in_span, k, one))

    def _sizes(self) -> Iterator[Claim]:
        """Yield that an array has one entry, with which it is right, as asked."""
        for axes in sizes_by_axis(self.known).values():
            k, what = one_of_them(self.known[0], axes)
            holds, made = partial(has_one, axes), partial(with_one, axes)
            some = [one for call in self.known for one in made(call)]
            first = [*filter(holds, self.known), *some][: QUESTIONS + 2]
            says = f"whenever `{self.names[k]}` has one {what}"
            yield Claim(k, says, first, holds, partial(self._made, made), 0.0, made)

    def _made(self, made: Callable[[Call], Sequence[Call]]) -> list[Call]:
        """Return what is made of calls that were asked, and of fresh ones."""
        return [one for call in (*self.known, *self.drawn()) for one in made(call)]

    def _in_span(self, k: int, one: Span) -> list[Call]:
        """Return calls in a range, with the others as asked, resized, and crossed.

        None where too few of those that are crossed have one right answer.
        """
        usual = self._spanned(k, one, self._others(), 2 * TRIED)
        if not (others := self._crossed(k)):
            return usual
        parts = [others[i : i + QUESTIONS] for i in range(0, len(others), QUESTIONS)]
        # Of each four, two are near the range's ends.
        near = chain(*(self._spanned(k, one, part, QUESTIONS) for part in parts))
        found = list(filter(self._definite, near))
        return [*usual, *found] if len(found) >= TRIED else []

    def _spanned(self, k: int, one: Span, some: Sequence[Call], n: int) -> list[Call]:
        """Return n calls with argument k in a range, and near its ends."""
        again = [some[i % len(some)] for i in range(n)]
        values = one.values([call[k] for call in again])
        return _with(again, k, values)

    def _crossed(self, k: int = -1) -> list[Call]:
        """Return calls with all arguments but k at their ends, also jointly."""
        shapes = [np.shape(x) for x in self.calls[0]]
        known = [c for c in self.known if [np.shape(x) for x in c] == shapes]
        return crossed([*known, *self.calls], k)

    def _definite(self, call: Call) -> bool:
        return self.at_edge is None or of_call(self.at_edge, call)

    def _right(
        self,
        given: Iterable[Any],
        calls: Sequence[Call],
        least: int = AGREE,
        tried: int = AGREE,
    ) -> bool:
        """Return whether all answers are right and enough of them say something.

        Zeros say nothing, and neither do right answers that are all the same, nor calls
        with more than one right answer.

        Args:
            given: the function's answers.
            calls: to which.
            least: answers that have to say something.
            tried: calls that have to have an answer.
        """
        agree = answered = 0
        different = False
        first: Array | None = None
        for call, answer, its in zip(calls, given, self.truth(calls), strict=True):
            if not self._definite(call):
                continue
            if (ok := self._is_right(answer, its)) is None:
                continue  # the question has no answer: it says nothing
            if not ok:
                return False
            answered += 1
            right = flat(its)
            assert right is not None
            agree += np.abs(right[np.isfinite(right)]).max(initial=0.0) > NOTHING
            first = right if first is None else first
            alike = right.shape == first.shape and np.allclose(right, first)
            different = different or not alike
        return agree >= least and answered >= tried and different

    def _is_right(self, answer: Any, its: Any) -> bool | None:
        """Return whether an answer is the right one, None where there is none."""
        right, mine = flat(its), flat(answer)
        if right is None or np.isnan(right).any():
            return None
        if mine is None or mine.shape != right.shape:
            return False
        there = np.isfinite(right)
        if not np.array_equal(mine[~there], right[~there]):
            return False
        size = float(np.abs(right[there]).max(initial=0.0))
        off = np.abs(mine[there] - right[there]).max(initial=0.0)
        return bool(off <= max(self.near * size, ROUNDING))

    def _growth(self, before: Iterable[Any], after: Iterable[Any]) -> float | None:
        """Return by which one factor all answers grew, None where there is none.

        Args:
            before: answers; None where there was none, which says nothing.
            after: the same calls' with an argument doubled.
        """
        pairs = [(flat(b), flat(a)) for b, a in zip(before, after, strict=True)]
        kept = [(b, a) for b, a in pairs if b is not None and a is not None and b.any()]
        if len(kept) < ALIKE or any(b.shape != a.shape for b, a in kept):
            return None
        one, two = (np.concatenate(some) for some in zip(*kept, strict=True))
        factor = float(one @ two / (one @ one))
        off = np.abs(two - factor * one).max()
        return factor if off <= self.near * max(1.0, float(np.abs(two).max())) else None


def _all_grew(before: Iterable[Any], after: Iterable[Any], factor: float) -> bool:
    """Return whether each answer grew by a factor, those that were 0 included."""
    pairs = [(flat(b), flat(a)) for b, a in zip(before, after, strict=True)]
    return all(
        b.shape == a.shape
        and np.abs(a - factor * b).max(initial=0.0)
        <= AGREES * max(1.0, float(np.abs(a).max(initial=0.0)))
        for b, a in pairs
        if b is not None and a is not None
    )


def _of_argument(k: int, holds: Callable[[Any], bool], call: Call) -> bool:
    """Return whether a call's argument satisfies a condition; False without the entry.

    A vector of two entries has no `x[2]`, of which a condition may be.
    """
    try:
        return holds(call[k])
    except IndexError:
        return False


def _neutral_in(k: int, neutral: Neutral, call: Call) -> list[Call]:
    """Return a call with argument k neutral in one way; none if it cannot be."""
    same = (one for one in neutrals(call[k]) if one.says == neutral.says)
    return [(*call[:k], one.value, *call[k + 1 :]) for one in same]


def _with_another_neutral(claim: Claim, call: Call) -> Iterator[Call]:
    """Yield calls in which another argument is neutral as well: a bound is 0, as x is.

    They only contradict.
    """
    for k, x in enumerate(call):
        for one in neutrals(x) if k != claim.k else ():
            made = (*call[:k], one.value, *call[k + 1 :])
            if claim.holds(made):
                yield made


def _doubled(calls: Sequence[Call], k: int) -> list[Call]:
    """Return calls with the k-th argument doubled."""
    return _with(calls, k, [2.0 * call[k] for call in calls])


def _with(calls: Sequence[Call], k: int, values: Sequence[Any]) -> list[Call]:
    """Return calls with other values of argument k."""
    pairs = zip(calls, values, strict=True)
    return [(*call[:k], value, *call[k + 1 :]) for call, value in pairs]


def _sized(x: Any) -> str:
    """Return the size of a matrix that is not square, for what depends on it, or ""."""
    if not isinstance(x, np.ndarray) or x.ndim != 2 or x.shape[0] == x.shape[1]:
        return ""
    return f" ({x.shape[0]}x{x.shape[1]})"


def _may_be_doubled(x: Any) -> bool:
    if isinstance(x, np.ndarray):
        return bool(x.any()) and scaled(x, 2.0) is not x
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
