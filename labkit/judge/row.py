"""Rows of a day's folder: one file per function, `dayN/pd_torque.py`.

    row = Row(TORQUE)

    @row.inputs
    def _(rng):
        yield 0.1 * ONE, 0.0 * ONE, 100.0 * ONE, 20.0 * ONE  # the docstring's case
        ...

    @row.wrong
    def error_sign(e, ed, kp, kd):
        "the spring pushes away from the goal"
        return kd * ed - kp * e

The decorated function is the mistake as a student writes it. Made again case by case,
it names the mistake; in the lab's place, it is put before the checker and run as a lab,
which proves the name. Nothing else is written of a mistake.
"""

import importlib
import inspect
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property, partial, update_wrapper
from types import MappingProxyType, ModuleType
from typing import Any

from labkit.judge.answers import AtOnce, InTurn, entry_of, grouped, once
from labkit.judge.argument_mistakes import Change
from labkit.judge.ask import Ask, HeldOut, Inputs
from labkit.judge.draw import Draw
from labkit.judge.mistake import Mistake, told
from labkit.judge.mutant import Body, body_of, glosses
from labkit.judge.results import checked, numbers
from labkit.judge.unusual import beyond
from labkit.judge.written import Answered, stop, stops_with
from labkit.lesson.day import Day
from labkit.lesson.lab_module import definition, lab_of, read_script
from robo47.errors import Robo47Error
from robo47.paths import shown

Code = Callable[..., Any]
ANY_SIZE = "not-at-every-size"  # what a function is told that `spans` finds


@dataclass(frozen=True)
class Way:
    """One way to write a function: a mistake, or an unusual one that is right."""

    status: str  # "wrong", "close" or "right"
    slug: str  # what it must be told; "" where it must pass
    # As in a `Mistake`; "" where something else names it: a hook of the row, a held-out
    # question, its kind.
    says: str
    code: Code  # the function, as a student writes it
    hidden: str = ""  # why the lab cannot show it; "" where the lab, run with it, fails
    # Whether it is a mistake of a smaller function that this one calls.
    reached: bool = False
    both: bool = False  # as in a `Mistake`

    @property
    def named(self) -> bool:
        """Whether making it again is what names it."""
        return self.status == "wrong" and self.says != ""


@dataclass(frozen=True)
class Table:
    """The function of a `@row.wrongs`, and the names of its mistakes."""

    code: Code
    slugs: frozenset[str]
    silent: tuple[str, ...] = ()  # lines without a sentence


def inside(where: str, says: str) -> str:
    """Return a clause with its place in front: "in [p] of the adjoint, ...".

    Args:
        where: the place, such as "in the adjoint, ".
        says: a clause, which may begin with a smaller place, "in [p], ...". The name of
            a function is a place by itself, and it replaces "your function".
    """
    named = re.fullmatch(r"in (`\w+`), ", where)
    if named and says.startswith("your function "):
        return says.replace("your function", f"your {named[1]}", 1)
    inner = re.match(r"in ([^,]+), ", says)
    if not inner or not re.fullmatch(r"in [^,]+, ", where):
        return where + says
    if re.fullmatch(r"`\w+`", inner[1]):
        return says
    if inner[1] == "your code":
        own = where.replace("in `", "in your `", 1)
        return own + says[inner.end() :]
    link = "in" if " of " in inner[1] else "of"  # not a row of "of"
    return f"in {inner[1]} {link} {where[3:]}{says[inner.end() :]}"


class Row:
    """One function of a day: its questions, its right answer and the wrong ones."""

    def __init__(
        self,
        kind: Any,
        *,
        truth: Code | None = None,
        near: float = 1e-5,
        alike: Sequence[set[str]] = (),
        **more: Any,
    ) -> None:
        """Begin a row.

        Args:
            kind: of the answer, as in `Ask`.
            truth: the right answer to one question, never the lab's own function; by
                default the function of this name in the day's library.
            near: as in `Ask`.
            alike: slugs that are one thing with several names here, in sets.
            more: further fields of `Ask`: accept, held_out, unnamed and so on.
        """
        if unknown := set(more) - {one.name for one in fields(Ask)}:
            raise TypeError(f"a Row has no {min(unknown)}")
        self.more = {"kind": checked(kind), "near": near, **more}
        self.alike = list(alike)
        self._truth = truth
        self.positive: dict[str, str] = {}  # what is never negative, and why
        self.unnoticed: dict[str, str] = {}  # changes that make no difference, and why
        self._entries: list[Callable[[], Iterable[Way]]] = []
        self._spans: list[Inputs] = []
        self.tables: list[Table] = []

    # What a day's file says.

    def inputs(self, draw: Inputs) -> Any:
        """Take the generator of argument tuples, the docstring's case first."""
        self.more["inputs"] = draw
        return draw

    def spans(self, draw: Inputs | None = None, /, **values: Sequence[Any]) -> Any:
        """Take what the usual inputs do not reach, and the lab or a later task asks.

        It is asked of a function that is right so far. An answer is then measured in
        its own size, so that what is tiny is not taken for 0.

        Args:
            draw: a generator of calls, as that of `inputs`.
            values: of arguments, by name: the least, the greatest, what stands at a
                limit. Each is put into the last of the usual calls; a function is given
                the argument that is there.
        """

        def calls(rng: Draw) -> Iterator[tuple[Any, ...]]:
            *_, usual = self._inputs(rng)
            for name, some in values.items():
                at = self.arguments.index(name)
                for one in some:
                    value = one(usual[at]) if callable(one) else one
                    yield (*usual[:at], value, *usual[at + 1 :])

        self._spans.append(draw or calls)
        return draw

    def cases(
        self, some: Mapping[str, Code] = MappingProxyType({}), /, **named: Code
    ) -> None:
        """Take cases of calls, so that a student is told which of them are right.

        The cases of one list are told together: "The result is correct for parallel
        segments. It is wrong in every test for segments that cross." A row may have
        several lists; the one that leaves the fewest calls open is told. Each case
        needs inputs of `inputs` or of `rare`.

        Args:
            some: by phrase, a plural noun that a student understands, a function of a
                call's arguments that returns whether the call is of that case.
            named: the same; the phrase has underscores for spaces.
        """
        spaced = {name.replace("_", " "): holds for name, holds in named.items()}
        self.more["cases"] = (*self.more.get("cases", ()), {**some, **spaced})

    def rare(self, draw: Inputs) -> Inputs:
        """Take a generator of calls of cases that `inputs` draws seldom or never.

        A wrong function is asked them after a check, and only where its mistake has no
        name.
        """
        calls = partial(_calls, draw)
        self.more["rare"] = (*self.more.get("rare", ()), calls)
        return draw

    def wrong(
        self,
        slug: str | Code = "",
        says: str = "",
        hidden: str = "",
        both: bool = False,
    ) -> Any:
        """Take a mistake, bare or with arguments; these are those of a `Way`.

        Without them the function's name is the slug and its docstring the sentence.
        """
        if callable(slug):
            return self.wrong()(slug)

        def keep(code: Code) -> Code:
            name = slug or code.__name__.replace("_", "-")
            told = " ".join((code.__doc__ or "").split())
            return self._keep(Way("wrong", name, says or told, code, hidden, both=both))

        return keep

    def wrongs(
        self,
        code: Code | None = None,
        hidden: Mapping[str, str] = MappingProxyType({}),
    ) -> Any:
        """Take the mistakes of one function that returns {slug: answer}.

        Its docstring has a line of each, "slug: sentence";
        an indented line goes on with the one above; "slug 2" is another way to make the
        mistake. What costs much, or may stop, is a function without arguments.

        Args:
            code: the function; None to give the others.
            hidden: per slug why the lab cannot show it, as in a `Way`.
        """
        if code is None:
            return partial(self.wrongs, hidden=hidden)
        said = list(told(code.__doc__ or ""))
        known = {slug for slug, _, _ in said}
        table = once(code)
        names = (slug.partition(" ")[0] for slug in known)
        silent = tuple(slug.rstrip(":") for slug, says, _ in said if not says)
        self.tables.append(Table(code, frozenset(names), silent))
        for slug, says, both in said:
            one = entry_of(table, slug, known)
            update_wrapper(one, code, (), ())  # its arguments' names
            name = slug.partition(" ")[0]
            self.wrong(name, says, hidden.get(slug, ""), both)(one)
        return code

    def valid(self, method: str | Code = "") -> Any:
        """Take the property of an answer that the docstring names, bare or with words.

        The function takes a call's arguments and the answer, and returns True, False or
        None, where it cannot say. Bare, any answer that has the property is right.

        Args:
            method: where the docstring asks for a method as well, what is told if
                another method's answers have the property.
        """
        if callable(method):
            return self.valid()(method)

        def keep(has: Code) -> Code:
            self.more |= {"valid": has, "method": method}
            return has

        return keep

    def close(self, slug: str) -> Any:
        """Take a way that is right in its method, but not in all digits."""
        return lambda code: self._keep(Way("close", slug, "", code))

    def right(self, code: Code) -> Code:
        """Take an unusual way that is right."""
        return self._keep(Way("right", "", "", code))

    def of_argument(self, name: str, *changes: Change) -> None:
        """Take mistakes that are made with one argument before it is used.

        Args:
            name: of the argument, as in the docstring.
            changes: from `labkit.judge.argument_mistakes`, or of one's own.
        """

        def ways() -> Iterator[Way]:
            at = self.arguments.index(name)
            for one in changes:

                def code(*args: Any, change: Code = one.redo) -> Any:
                    return self.truth(*args[:at], change(args[at]), *args[at + 1 :])

                def given(*args: Any, change: Code = one.redo) -> tuple[Any, ...]:
                    return (*args[:at], change(args[at]), *args[at + 1 :])

                vars(code)["given"] = given
                slug, says = (text.format(name=name) for text in (one.slug, one.says))
                yield Way("wrong", slug, says, code, one.hidden)

        self._entries.append(ways)

    def of_answer(self, mistakes: Iterable[Mistake], but: Iterable[str] = ()) -> None:
        """Take mistakes that are made with the finished answer.

        Args:
            mistakes: whose `redo` takes the right answer.
            but: slugs that make no difference here.
        """
        for one in mistakes:
            if one.slug not in but:

                def code(*args: Any, redo: Code = one.redo) -> Any:
                    return redo(self.truth(*args))

                self._keep(Way("wrong", one.slug, one.says, code))

    def reached_by(
        self,
        small: str,
        where: str = "",
        but: Iterable[str] = (),
        called: Mapping[str, str] = MappingProxyType({}),
        hidden: Mapping[str, str] = MappingProxyType({}),
        given: Callable[..., tuple[Any, ...]] = lambda *args: args,
    ) -> None:
        """Take the mistakes of a small function that the lab's own one calls.

        They are made by the lab's function with the small one replaced.

        Args:
            small: its name; it has a file of its own.
            where: what to say first, such as "in each link's transform, ".
            but: slugs that make no difference here.
            called: words that are others here, such as {"the end effector": "link4"}.
            hidden: per slug why the lab cannot show it here, as in a `Way`.
            given: from the arguments to those that the lab's function is called with.
        """

        def ways() -> Iterator[Way]:
            for way in row_of(self._day, small).named:
                if way.slug not in but:
                    code = self._calling(small, way.code, given)
                    says = inside(where, way.says)
                    for there, here in called.items():
                        says = says.replace(there, here)
                    why = hidden.get(way.slug, way.hidden)
                    yield replace(way, says=says, code=code, hidden=why, reached=True)

        self._entries.append(ways)

    def same(self, change: str, why: str) -> None:
        """Take a change of the lab's body that no question can notice.

        Args:
            change: as `make gaps` prints it, "x < 1e-9 => x < 2e-09".
            why: the answers are right all the same, or nearly always.
        """
        self.unnoticed[change] = why

    def at_least_0(self, **why: str) -> None:
        """Take arguments, or the `answer`, that are never negative, and why.

        `make gaps` then does not take away their signs, as no question could show it.
        """
        self.positive |= why

    # What the machine makes of it.

    def bind(self, day: Day, function: str) -> "Row":
        """Return the row as that of a function, by the name of its file."""
        self._day, self.function = day, function
        return self

    @cached_property
    def truth(self) -> Code:
        """The right answer to one question."""
        if self._truth:
            return self._truth
        for name in self._day.library:
            module = importlib.import_module(f"robo47.{name}")
            if hasattr(module, self.function):
                return getattr(module, self.function)
        raise Robo47Error(
            f"day{self._day.number}/{self.function}.py: the day's library has no "
            f"{self.function}; say truth=... in its Row"
        )

    @cached_property
    def arguments(self) -> list[str]:
        """The names of the arguments, as in the lab."""
        return list(inspect.signature(getattr(self.lab, self.function)).parameters)

    @property
    def lab(self) -> ModuleType:
        """The day's complete lab."""
        return lab_of(self._day)

    @cached_property
    def ways(self) -> list[Way]:
        """All ways to write the function that the file holds."""
        return [way for entry in self._entries for way in entry()]

    @property
    def named(self) -> list[Way]:
        """The ways that are mistakes with a name."""
        return [way for way in self.ways if way.named]

    @cached_property
    def ask(self) -> Ask:
        """What the judge asks."""
        if "inputs" not in self.more:
            raise Robo47Error(f"{self.function}.py has no @row.inputs")
        more = {**self.more, "inputs": self._inputs, "reference": self._reference,
                "right_bodies": self._bodies}  # fmt: skip
        if self._spans:
            more["held_out"] = [*more.get("held_out", ()), self._of_any_size()]
        if "accept" in more:
            more["accept"] = self._accept
        else:
            kind = self.more["kind"]
            asked = (InTurn if self._truth else AtOnce)(self.truth)
            more["truth"] = Answered(
                self.truth,
                partial(numbers, kind),
                asked=asked,
                kind=kind,
                fault=self._fault,
            )
        try:
            return Ask(mistakes=self._mistakes, **more)
        except Robo47Error as error:
            raise self._fault(f"row cannot be asked: {error}") from None

    def _of_any_size(self) -> HeldOut:
        return HeldOut(
            ANY_SIZE,
            beyond(),
            lambda rng: [call for draw in self._spans for call in _calls(draw, rng)],
            relative=True,
            told=lambda failing, usual: beyond(failing, usual, self.arguments),
        )

    def _mistakes(self) -> list[Mistake]:
        read = self.ask.in_turn
        return [
            Mistake(w.slug, w.says, read(w.code), w.both, w.reached) for w in self.named
        ]

    def _inputs(self, rng: Draw) -> list[tuple[Any, ...]]:
        """Return what the file's generator yields; where it stops, say where."""
        try:
            return _calls(self.more["inputs"], rng)
        except Robo47Error:
            raise
        except Exception as error:
            raise self._fault(f"inputs function {stop(error)}") from None

    def _reference(self) -> Code | None:
        there = hasattr(self, "_day") and self._day.source.is_file()
        return getattr(self.lab, self.function, None) if there else None

    def _bodies(self) -> list[Body]:
        """Return right functions as they are written, the lab's own first."""
        if self._reference() is None:
            return []
        text = read_script(self._day.source)
        lab = definition(text, self.function)
        space, name = dict(vars(self.lab)), self.function
        found = [Body(lab, space, name=name, glosses=glosses(text))] if lab else []
        right = [way.code for way in self.ways if way.status == "right"]
        others = [] if "accept" in self.more else [body_of(self.truth, name)]
        others += [body_of(code, name, commented=True) for code in right]
        return [*found, *filter(None, others)]

    def _accept(self, *args: Any) -> Any:
        try:
            return self.more["accept"](*args)
        except Exception as error:
            says = f"accept {stops_with(error)}, and any answer"
            raise self._fault(says) from None

    def _fault(self, says: str) -> Robo47Error:
        file = shown(self._day.own / f"{self.function}.py")
        return Robo47Error(f"{file}: its {says}")

    def _keep(self, way: Way) -> Code:
        self._entries.append(lambda: [way])
        return way.code

    def _calling(self, small: str, wrong: Code, given: Code) -> Code:
        """Return the lab's own function with a small one replaced."""
        lab = self.lab
        large = getattr(lab, self.function)  # it may be replaced itself when called

        def code(*args: Any) -> Any:
            right = getattr(lab, small)
            setattr(lab, small, wrong)
            try:
                return large(*given(*args))
            finally:
                setattr(lab, small, right)

        return code


def _calls(draw: Inputs, rng: Draw) -> list[tuple[Any, ...]]:
    """Return the calls of a generator of the file's."""
    return [grouped(call) for call in draw(rng)]


def row_of(day: Day, function: str) -> Row:
    """Return the row of a function: what its file calls `row`.

    Raises:
        Robo47Error: the day has no such file, or it holds no row.
    """
    module = day.module(function)
    row = getattr(module, "row", None)
    if not isinstance(row, Row):
        raise Robo47Error(f"day{day.number}/{function}.py has no `row = Row(...)`")
    return row.bind(day, function)


def rows_of(day: Day) -> dict[str, Row]:
    """Return the rows of all of a day's functions, in the manifest's order."""
    names = [name for task in day.tasks for name in task.functions]
    return {name: row_of(day, name) for name in names}
