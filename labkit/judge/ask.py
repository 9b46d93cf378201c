"""A function's row (inputs, truth, kind, mistakes) and the questions made of it.

A day's function files make them (`labkit.judge.row`), one row per
function of the manifest. Inputs are drawn from a `Draw`, or from `Edges`.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import chain, starmap
from pathlib import Path as File
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from labkit.base.exchange import Exchange, Path, Question, Reply
from labkit.judge import fits
from labkit.judge.answers import InTurn, Parts, Several, content, gaps, own, parts
from labkit.judge.draw import Draw, Edges
from labkit.judge.guard import guarded
from labkit.judge.kinds import Kind
from labkit.judge.mistake import Finding, Mistake
from labkit.judge.mutant import Body
from labkit.judge.results import Kinds, flat_kinds, numbers
from robo47 import panda
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.paths import shown

Inputs = Callable[["Draw"], Iterable[tuple[Any, ...]]]
SEED = 47  # of the questions that are the same at every check
# How many inputs are drawn anew, and as many edge values: a rare bug is found sooner.
FRESH, CHEAP_FRESH, CHEAP = 8, 32, 16  # few numbers cost little
SECONDS = 10.0  # for all calls of a function, where its task does not say
# What a row says of wrong answers, and what counts where that stops: it says nothing.
HOOKS: dict[str, Any] = {"unnamed": None, "near_miss": None, "measured": (),
                         "valid": False}  # fmt: skip
SHARE = 1e-6  # of its largest entry an answer may be off where that is what counts
TINY = 1e-4  # and of this, in units of its kind's scale, where it is smaller
KNOWN = 20  # right answers of a function's that are kept: a class is asked the same


@dataclass(frozen=True)
class Robot:
    """A model as an argument: student code gets data that reads like an MjModel."""

    # As `panda.load` names it, or the path of any MJCF file.
    entry: str | File = "panda_nohand"
    # Is given the compiled model to alter, such as longer links.
    change: Callable[[mujoco.MjModel], None] | None = None

    @cached_property
    def model(self) -> mujoco.MjModel:
        """The compiled model; do not change it."""
        model = model_of(self.entry)
        if self.change:
            self.change(model)
        return model


def model_of(entry: str | File) -> mujoco.MjModel:
    """Return a Panda by its entry, or the model of an MJCF file.

    Raises:
        Robo47Error: the file is not there, or MuJoCo cannot read it.
    """
    if isinstance(entry, str):
        return panda.load(entry)
    try:
        return mujoco.MjModel.from_xml_path(str(entry))
    except ValueError as error:
        says = " ".join(str(error).split())
        raise Robo47Error(f"{shown(entry)}: MuJoCo cannot load it: {says}") from None


@dataclass(frozen=True)
class HeldOut:
    """Further questions to a right function: how did its answers come about?"""

    slug: str  # what is found where an answer is not right
    says: str  # what to say then, a sentence or two
    inputs: Inputs  # as those of `Ask`
    # What is found are the answers of this function of one question; None: whatever is
    # not right.
    mistaken: Callable[..., Any] | None = None
    status: str = "wrong"  # or "close"
    near: float | None = None  # how well `mistaken` has to fit; None is the row's
    # Whether what an answer is off is measured in its own size, however small or large.
    relative: bool = False
    # Whether a function with few digits is judged by them, too: not where the row's
    # `near_miss` says more.
    of_close: bool = True
    # What to say in the place of `says` of the calls that are not right, with those
    # that are always asked, and the right ones, beside them; None says the same of all.
    told: Callable[[Sequence[Exchange], Sequence[Exchange]], str] | None = None

    def __post_init__(self) -> None:
        """Refuse another status: one that passes would hide what is found next."""
        if self.status not in ("wrong", "close"):
            raise Robo47Error(f'status is {self.status!r}; expected "wrong" or "close"')


@dataclass(frozen=True)
class Slip:
    """A slip that ends in an exception whose own text does not help, or never ends."""

    # Regular expression that the "Type: text" of the exception matches, or the word
    # "stopped", of a call without an end.
    error: str
    source: str  # one that the student's file matches; of "stopped" the function alone
    slug: str  # its name
    says: str  # what to say, a sentence or two


@dataclass(frozen=True)
class Case:
    """What a hook is given: all that was asked of one function, and what came back."""

    ask: "Ask"  # the row of the function
    # Of the main questions, stacked, (n, ...) each; a Robot as its model.
    arguments: tuple[Any, ...]
    S: Any  # the student's answers, (n, ...)
    T: Any  # the right ones
    given: Sequence[str]  # the inputs in words, one per question
    # Per question of `Ask.probe` its arguments and the answer, or None.
    probes: Sequence[tuple[tuple[Any, ...], Any]] = ()
    further: "Further | None" = None  # what a sentence must hold for as well
    # Which question is the failing call that is shown, (n,) of bool; None is unknown.
    failing: NDArray[np.bool_] | None = None
    names: Sequence[str] = ()  # of the arguments, for sentences
    source: str = ""  # the student's file


@dataclass(frozen=True)
class Further:
    """Fresh inputs with an answer: a sentence about the main ones is held against them.

    They were asked in the same round, so that costs a check nothing.
    """

    arguments: tuple[Any, ...]  # stacked, as in a `Case`
    S: Parts  # the student's answers
    T: Parts  # the right ones


@dataclass(frozen=True)
class Ask:
    """One function of a day."""

    # From a seeded generator to the arguments of every call: the case of the docstring
    # first, drawn ones last. What is random is an argument: noise is drawn here. Round
    # what is drawn (`rounded`), so that a student can type it. Arrays of bools and
    # of whole numbers stay what they are.
    inputs: Inputs
    # Of the answer; a tuple of kinds where the function returns a tuple.
    kind: Kinds
    # The right answers to all calls, from stacked arguments as `Mistake.redo` takes
    # them; an oracle, never the lab script.
    truth: Callable[..., Any] | None = None
    # Instead of `truth` where many answers are right: takes one call's arguments and
    # the answer, and returns what is wrong with it, or None.
    accept: Callable[..., Finding | str | None] | None = None
    # Beside `truth`: takes the same, and returns whether the answer has the property
    # that the docstring names; None if that cannot be said. One that has is right,
    # though it is another ...
    valid: Callable[..., bool | None] | None = None
    # ... unless these words are there: the docstring asks for a method, and they say
    # which, to a function whose answers are valid by another.
    method: str = ""
    copies: bool = True  # whether an answer may not be (a part of) an argument itself
    # The named ones, the more general first; a function that returns them where making
    # them costs something.
    mistakes: Sequence[Mistake] | Callable[[], Sequence[Mistake]] = ()
    # An answer is right up to this, in units of its kind's scale.
    tolerance: float = 1e-8
    near: float = 1e-4  # and nearly right up to this
    # What share of the right answer's largest entry is allowed besides: 0.01 is 1 %.
    rtol: float = 0.0
    held_out: Sequence[HeldOut] = ()  # further questions to a right function
    # Inputs of further questions, whose replies only help to say where a wrong answer
    # goes wrong; they may be errors.
    probe: Inputs | None = None
    # Says where an answer that no named mistake gives goes wrong, of another size too:
    # S and T of the case are filled up with zeros then.
    unnamed: Callable[[Case], Finding | None] | None = None
    before_slips: bool = True  # whether `unnamed` is told before a slip, too
    # Whether what it finds is a name, as complete as any: then no slip follows it.
    unnamed_names: bool = False
    # Says why an answer is right to some digits only.
    near_miss: Callable[[Case], Finding | None] | None = None
    measured: Callable[[Case], Sequence[str]] | None = None  # adds lines for --explain
    slips: Sequence[Slip] = ()  # exceptions that have better words than their own
    # What a wrong function may turn out to be right for, in words that follow
    # "whenever", each with a function of a call's arguments that says whether it is so.
    conditions: Sequence[tuple[str, Callable[..., bool]]] = ()
    # Cases of calls, in lists: by a phrase, such as "parallel segments", a function of
    # a call's arguments that says whether a call is of that case.
    cases: Sequence[Mapping[str, Callable[..., bool]]] = ()
    rare: Sequence[Inputs] = ()  # draw calls of cases that `inputs` draws seldom
    # Fresh calls of a case at which a sentence about it is tested, if its inputs allow
    # it; fewer where a call takes long, but more than the 50 that a sentence needs.
    each_case: int = 200
    # Whether a call with edge values has one right answer; None is yes.
    at_edge: Callable[..., bool] | None = None
    seconds: float = 0.0  # that a call of the reference takes; 0: it is measured here
    # Returns the lab's own function, or None: a truth that is faster says too little.
    reference: Callable[[], Callable[..., Any] | None] = lambda: None
    # Returns right functions as they are written, the lab's own first, each with the
    # names that it may use.
    right_bodies: Callable[[], Sequence[Body]] = list

    def __post_init__(self) -> None:
        """Refuse a row that has neither or both of truth and accept.

        And one that would judge wrong answers, and stop at a right one: what a held-out
        question without `mistaken` asks is whether the answer is the truth's.
        """
        if (self.truth is None) == (self.accept is None):
            raise ValueError("an Ask has either truth or accept")
        for name, otherwise in HOOKS.items():
            if hook := getattr(self, name):
                object.__setattr__(self, name, guarded(hook, otherwise))
        for held in self.held_out if self.accept else ():
            if held.mistaken is None:
                raise Robo47Error(
                    f'the held-out question "{held.slug}" asks for the right answer, '
                    "and a row with accept= has none: give it mistaken=, the function "
                    "whose answers it looks for, or let accept say what is wrong"
                )

    @cached_property
    def known(self) -> dict[Any, Any]:
        """The last questions made, and right answers by whose questions they are."""
        return {}

    @cached_property
    def kinds(self) -> tuple[Kind, ...]:
        """The kinds of the answer's parts; one where it is no tuple."""
        return flat_kinds(self.kind)

    def in_turn(self, function: Callable[..., Any]) -> InTurn:
        """Return a function of one question as one of all, with its answers read."""
        return InTurn(function, partial(numbers, self.kind))

    @cached_property
    def named(self) -> list[Mistake]:
        """The named mistakes."""
        return list(self.mistakes() if callable(self.mistakes) else self.mistakes)

    @cached_property
    def bodies(self) -> Sequence[Body]:
        """Right functions, the lab's own first; mutants are made of them."""
        return self.right_bodies()

    @cached_property
    def main(self) -> list[tuple[Any, ...]]:
        """The calls that are the same at every check."""
        return [tuple(call) for call in self.inputs(Draw(SEED))]

    def gaps(self, S: Parts, T: Parts) -> Array:
        """Return per call how far an answer is off, beyond what `rtol` allows."""
        return gaps(self.kinds, S, T, self.rtol)

    def gaps_of(self, j: int, s: Array, t: Array) -> Array:
        """Return per call how far the j-th result is off, likewise."""
        return gaps(self.kinds[j : j + 1], (s,), (t,), self.rtol)

    def shares(self, S: Parts, T: Parts) -> Array:
        """Return per call how far an answer is off, in units of `SHARE` of its size."""
        found = []
        for j, (s, t, kind) in enumerate(zip(S, T, self.kinds, strict=True)):
            sizes = np.nan_to_num(np.abs(t / kind.scale), posinf=0.0)
            size = sizes.reshape(len(t), -1).max(axis=1, initial=TINY)
            found.append(self.gaps_of(j, s, t) / (SHARE * size))
        return np.max(found, axis=0)

    def too_far(self, held: HeldOut, S: Parts, T: Parts) -> list[bool]:
        """Return per held-out question whether its answer is not the right one."""
        near = self.near if held.near is None else held.near
        far = self.shares(S, T) > 1.0 if held.relative else self.gaps(S, T) > near
        return [bool(one) for one in far]

    @cached_property
    def cost(self) -> float:
        """Seconds of a call, as the row says, or as its truth takes here."""
        truth = self.truth
        if self.seconds or truth is None:
            return self.seconds
        last = stacked([Exchange(Question("", "", self.main[-1]))])
        return fits.measured(lambda: truth(*last))

    @cached_property
    def labs_cost(self) -> float:
        """Seconds of a call of the lab's own function here, unless the row says it."""
        lab = None if self.seconds else self.reference()
        if lab is None:
            return self.cost
        plain = [as_plain(arg) for arg in self.main[-1]]
        with suppress(NotImplementedError):  # a lab that is not written yet
            return max(self.cost, fits.measured(lambda: lab(*map(own, plain))))
        return self.cost

    def cost_in(self, seconds: float) -> float:
        """Return what a call costs; a task with more seconds asks the lab's own, too.

        Args:
            seconds: for all calls of the task.
        """
        return self.labs_cost if seconds > SECONDS else self.cost

    @cached_property
    def drawn(self) -> int:
        """How many inputs are drawn: from the first on that two draws do not share."""
        others = self.inputs(Draw(SEED + 1))
        pairs = zip(self.main, others, strict=False)
        alike = [all(starmap(_alike, zip(*pair, strict=True))) for pair in pairs]
        return len(alike) - [*alike, False].index(False)

    @cached_property
    def edges(self) -> list[tuple[Any, ...]]:
        """Calls with the edge values of every argument, where one answer is right."""
        calls = self.anew(SEED, Edges) if self.truth else []
        found = {repr(call): call for call in calls}
        return [c for c in found.values() if not self.at_edge or self.at_edge(*c)]

    def anew(self, seed: int, kind: type[Draw] = Draw) -> list[tuple[Any, ...]]:
        """Return calls drawn anew, by as many generators as that takes."""
        cheap = sum(map(np.size, self.main[-1])) <= CHEAP
        most = 2 if not self.truth else CHEAP_FRESH if cheap else FRESH
        draws = range(-(-most // self.drawn) if self.drawn else 0)
        generators = [kind([seed, i]) for i in draws]
        calls = [[*self.inputs(rng)][-self.drawn :] for rng in generators]
        return list(map(tuple, chain(*calls)))[-most:]


@dataclass(frozen=True)
class Asked:
    """All that one function is asked in one check, by role."""

    function: str  # its name
    ask: Ask  # its row
    main: list[Exchange]  # the questions that are the same at every check
    fresh: list[Exchange]  # edge values, and those that are drawn anew
    held_out: list[list[Exchange]]  # per entry of `ask.held_out`
    probes: list[Exchange]  # those of `ask.probe`
    source: str = ""  # the student's file

    @property
    def exchanges(self) -> list[Exchange]:
        """All of them, in the order in which they are asked."""
        return [*self.main, *self.fresh, *chain(*self.held_out), *self.probes]


def replies(exchanges: Iterable[Exchange]) -> list[Reply]:
    """Return the replies of exchanges; a ValueError where nobody asked the question."""
    found = []
    for exchange in exchanges:
        if exchange.reply is None:
            raise ValueError(f"no reply to {exchange.question}")
        found.append(exchange.reply)
    return found


def asked_of(
    task: str, function: str, ask: Ask, seed: int, seconds: float = SECONDS
) -> Asked:
    """Return the questions to a function, which the sandbox is to answer.

    Args:
        task: whose function it is.
        function: its name.
        ask: its row.
        seed: of the fresh inputs; nobody should know it beforehand.
        seconds: for all its calls; fewer are asked where they take long.
    """
    key = (task, function, seed, seconds)
    if key not in ask.known:
        ask.known.clear()
        more = [ask.probe or (lambda rng: []), *(held.inputs for held in ask.held_out)]
        further = [draw(Draw(SEED)) for draw in more]
        cost = ask.cost_in(seconds)
        beside = fits.fitting(ask.main, ask.edges, ask.anew(seed), cost, seconds)
        ask.known[key] = [
            [Question(task, function, tuple(args)) for args in calls]
            for calls in (ask.main, beside, *further)
        ]
    roles = ([Exchange(one) for one in some] for some in ask.known[key])
    main, fresh, probes, *held_out = roles
    return Asked(function, ask, main, fresh, held_out, probes)


def stacked(exchanges: Iterable[Exchange]) -> tuple[Any, ...]:
    """Return all questions' arguments, one array (n, ...) per argument.

    A robot or a path that all share is one, beside what they do not share. Several,
    and arrays of several sizes, are an array (n,) of them.
    """
    columns = list(zip(*(e.question.args for e in exchanges), strict=True))
    alone = all(isinstance(column[0], Robot | Path) for column in columns)
    return tuple(_column(column, alone) for column in columns)


def of_complex(question: Question) -> bool:
    """Return whether an argument is complex; such answers are read as pairs."""
    arrays = (arg for arg in question.args if isinstance(arg, np.ndarray))
    return any(map(np.iscomplexobj, arrays))


def _alike(one: Any, other: Any) -> bool:
    """Return whether two arguments are equal."""
    if isinstance(one, Several):
        return bool(content(one) == content(other))
    return np.array_equal(one, other)


def as_plain(arg: Any) -> Any:
    """Return an argument as a truth gets it: a Robot's model, a path's pairs."""
    if isinstance(arg, Robot):
        return arg.model
    return arg.pairs if isinstance(arg, Path) else arg


def _column(column: tuple[Any, ...], alone: bool) -> Any:
    plain = list(map(as_plain, column))
    special = isinstance(column[0], Robot | Path | Several)
    shared = special and not alone and not isinstance(column[0], Several)
    if shared and all(one == column[0] for one in column):
        return plain[0]
    apart = special or len({np.shape(one) for one in plain}) > 1  # of several sizes
    whole = None if apart else np.array(column)
    if whole is None or whole.dtype == object:  # a world is no number
        found = np.empty(len(column), dtype=object)
        for at, one in enumerate(plain):
            found[at] = one
        return found
    return whole if whole.dtype.kind in "biuc" else whole.astype(np.float64)


def right_answers(
    ask: Ask, exchanges: Sequence[Exchange], held: HeldOut | None = None
) -> Parts:
    """Return the right answers to questions: per part of the answer, (n, ...).

    Args:
        ask: the function's row.
        exchanges: the questions.
        held: whose these are; what its mistake gives, where it looks for one.
    """
    mistaken = held and held.mistaken
    function = ask.in_turn(mistaken) if mistaken else ask.truth
    assert function is not None
    asked = [exchange.question for exchange in exchanges]  # as long as its key is kept
    key = (held and held.slug, *map(id, asked))
    _, T = ask.known.get(key) or (asked, parts(function(*stacked(exchanges))))
    if len(ask.known) < KNOWN:
        ask.known[key] = asked, T
    return tuple(map(np.copy, T))
