"""Sensitivity of a guide's numbers: each constant is doubled, measured, explained.

A day's `constants.py` is a table of them. A number is a function, and below its name
are all the constants that it could depend on, one per line. A constant is an argument
of the function, whose default is the lab's value, or a constant of the lab, written in
capitals, which the table itself changes for a while:

    numbers = Numbers(LAB, KP="the springs have {} N m/rad", step="a step of {} s")

    @numbers.add("joint 4 hangs low by", "{:.1f} mrad",
        KP=times(0.5, "twice the stiffness holds the same torque at half the angle"),
        step=same("the arm is at rest"))
    def sag(step=0.002):
        return ...

Each constant is doubled alone. `to=` is another value for a constant that cannot be
doubled. A number that does not change as its effect states is a fault.
"""

import inspect
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import cache, wraps
from types import ModuleType
from typing import Any, TypeVar

import mujoco
import numpy as np

from labkit.lesson.day import Day
from robo47.errors import Robo47Error
from robo47.paths import shown

# A guide shows the table of a day with this command.
TABLE_OF = "python scripts/constants.py {} | table"
FACTOR = "× {}"  # in the words of a constant that is multiplied
ROUNDING = 1e-8  # a smaller number is a rounding error
Computed = TypeVar("Computed", bound=Callable[..., float])


@dataclass(frozen=True)
class Effect:
    """The expected effect of a doubled constant on a number, and its reason."""

    least: float  # the smallest ratio of the new number to the old
    most: float
    says: str  # the words in the table; "" if the new number is enough
    why: str
    to: Any = None  # the constant's other value; None is twice the one it has

    @property
    def moves(self) -> bool:
        """The number must change."""
        return not self.least <= 1.0 <= self.most

    @property
    def expected(self) -> str:
        """The expected effect in words."""
        if self.least == self.most == 1.0:
            return "it stays"
        return self.says or f"× {self.least:g} to × {self.most:g}"


def same(why: str, *, to: Any = None) -> Effect:
    """Say that a number stays as it is printed.

    Args:
        why: it stays, in one sentence without a capital or a full stop.
        to: what the constant is turned to, where it is not doubled.
    """
    return Effect(1.0, 1.0, "", why, to)


def times(factor: float, why: str, *, within: float = 0.02, to: Any = None) -> Effect:
    """Say that a number is multiplied by a factor, which the sentence derives.

    Args:
        factor: 0.25 is a quarter; 0 where the number is gone.
        why: as in `same`.
        within: how exact that is, as a share of the factor (of the number at 0).
        to: as in `same`.
    """
    off = within * (abs(factor) or 1.0)
    says = "about the same" if factor == 1.0 else f"× {factor:.3g}"
    return Effect(factor - off, factor + off, says, why, to)


def between(least: float, most: float, why: str, *, to: Any = None) -> Effect:
    """Say that a number moves, to so many times what it was: known from a run only.

    A range with 1 inside is a number that may move: another draw of the same kind.

    Args:
        least: of the new number over the old.
        most: of the same.
        why: as in `same`.
        to: as in `same`.
    """
    return Effect(least, most, "", why, to)


@dataclass(frozen=True)
class Turn:
    """One constant turned: what the number is then."""

    name: str  # the name of the argument
    constant: str  # the constant in words, with both values
    then: float
    effect: Effect


@dataclass(frozen=True)
class Number:
    """One number of a guide."""

    name: str  # the name in words
    form: str  # the format in which it is printed: "{:.1f} mm"
    compute: Callable[..., float]
    effects: dict[str, Effect]

    def printed(self, value: float) -> str:
        """Return a value as it is printed, in few enough digits for any processor."""
        value = float(value)
        return "rounding" if 0.0 < abs(value) < ROUNDING else self.form.format(value)

    def as_told(self, turn: Turn, now: float) -> bool:
        """Return whether a constant did what its effect says."""
        if turn.effect.least == turn.effect.most == 1.0:
            return self.printed(turn.then) == self.printed(now)
        if not now:  # every multiple of 0 is 0
            return not turn.effect.moves
        low, high = sorted([turn.effect.least * now, turn.effect.most * now])
        return bool(low <= turn.then <= high)


@dataclass(frozen=True)
class Measured:
    """A number as it is, and as it becomes."""

    number: Number
    now: float
    turns: tuple[Turn, ...]


class Numbers:
    """The numbers of a day, in the order of its guide."""

    def __init__(self, *modules: ModuleType, **constants: str) -> None:
        """Begin a table.

        Args:
            modules: the lab and the modules whose constants in capitals are changed.
            constants: each constant in words, with {} for its value; with × {} for the
                factor by which a constant of the modules is changed.
        """
        self.modules = modules
        self.constants = constants
        self._changed = ""  # the module's constant that is changed, and its value
        self.all: list[Number] = []

    def add(
        self, name: str, form: str, **effects: Effect
    ) -> Callable[[Computed], Computed]:
        """Return a decorator that adds a number.

        Args:
            name: what it is, in words that a reader of the guide understands.
            form: how it is printed, with its unit: "{:.1f} mm".
            effects: of each argument of the function that computes it, and of each
                constant of the modules that it uses.

        Raises:
            Robo47Error: an argument has no effect or no words, or the other way round.
        """

        def added(compute: Computed) -> Computed:
            arguments = inspect.signature(compute).parameters
            for what, asked, known in (
                ("effect", arguments, effects),
                ("words", {**arguments, **effects}, self.constants),
            ):
                if missing := [one for one in asked if one not in known]:
                    raise Robo47Error(f"{name!r}: no {what} of {missing[0]}")
            own = [one for one in effects if one not in arguments]
            if unknown := [one for one in own if not self._with(one)]:
                raise Robo47Error(f"{name!r}: nothing of it is called {unknown[0]}")
            self.all.append(Number(name, form, compute, effects))
            return compute

        return added

    def cached(self, compute: Callable[..., Any]) -> Callable[..., Any]:
        """Return a helper that computes nothing twice, as `functools.cache` does.

        A module's constant that is changed counts as an argument.
        """
        results = cache(lambda changed, *args, **more: compute(*args, **more))
        return wraps(compute)(
            lambda *args, **more: results(self._changed, *args, **more)
        )

    def measured(self) -> Iterator[Measured]:
        """Yield each number, computed once as it is and once for each constant."""
        for number in self.all:
            now = number.compute()
            turns = (self._turned(number, name) for name in number.effects)
            yield Measured(number, now, tuple(turns))

    def _with(self, name: str) -> list[ModuleType]:
        """Return the modules that have a constant in capitals of this name."""
        found = [one for one in self.modules if name.isupper() and hasattr(one, name)]
        # Two modules may give one name to different constants: the first one counts.
        return [one for one in found if getattr(one, name) is getattr(found[0], name)]

    def _turned(self, number: Number, name: str) -> Turn:
        effect, words = number.effects[name], self.constants[name]
        if argument := inspect.signature(number.compute).parameters.get(name):
            old = argument.default
            new = 2 * old if effect.to is None else effect.to
            then = number.compute(**{name: new})
        else:
            value = getattr(self._with(name)[0], name)
            old = 1.0 if FACTOR in words else value
            new = 2 * old if effect.to is None else effect.to
            by = np.multiply(new, value) if FACTOR in words else new
            with self._changing(name, by):
                then = number.compute()
        return Turn(name, words.format(f"{_short(old)} → {_short(new)}"), then, effect)

    @contextmanager
    def _changing(self, name: str, value: Any) -> Iterator[None]:
        with ExitStack() as until:
            for module in self._with(name):
                until.enter_context(turned(module, **{name: value}))
            self._changed = f"{name} = {value}"
            until.callback(setattr, self, "_changed", "")
            yield


def _short(value: Any) -> str:
    """Return a constant as one reads it: 0.002, 1e-10, RK4."""
    return f"{value:g}" if isinstance(value, float) else str(value)


def numbers_of(day: Day) -> Numbers:
    """Return the list of a day.

    Raises:
        Robo47Error: it has none, or one that does not load.
    """
    found = getattr(day.module("constants"), "numbers", None)
    if not isinstance(found, Numbers) or not found.all:
        raise Robo47Error(f"{shown(day.own / 'constants.py')} lists no numbers")
    return found


def faults(found: Iterable[Measured]) -> Iterator[str]:
    """Yield each constant that does not do to a number what the list says."""
    for one in found:
        number = one.number
        for turn in one.turns:
            if number.as_told(turn, one.now):
                continue
            ratio = f" (× {turn.then / one.now:.3g})" if one.now else ""
            yield (
                f"{number.name!r} is {number.printed(one.now)}, and "
                f"{number.printed(turn.then)}{ratio} with {turn.constant}; the list "
                f"says {turn.effect.expected}, since {turn.effect.why}"
            )


def table(found: Iterable[Measured]) -> str:
    """Return what was measured as a table of a guide."""
    lines = ["| number | constant | then | why |", "|---|---|---|---|"]
    for one in found:
        number = one.number
        now = f"{number.name}: **{number.printed(one.now)}**"
        if {number.printed(turn.then) for turn in one.turns} == {
            number.printed(one.now)
        }:
            now += " (depends on none of these)"
        for turn in one.turns:
            then = number.printed(turn.then)
            if then == number.printed(one.now):
                then = "the same"
            elif turn.effect.says:
                then += f", {turn.effect.says}"
            cells = now, turn.constant, then, turn.effect.why
            lines.append("| " + " | ".join(c.replace("|", r"\|") for c in cells) + " |")
            now = ""
    return "\n".join(lines) + "\n"


def unprinted(found: Iterable[Measured], day: Day) -> Iterator[str]:
    """Yield each number that the guide does not print, outside its table, as it is."""
    block = re.escape(f"<!-- run: {TABLE_OF.format(day.number)} -->")
    guide = (day.folder / day.guide).read_text("utf-8")
    text = re.sub(f"{block}.*?<!-- end -->", "", guide, flags=re.DOTALL)
    for one in found:
        printed = one.number.printed(one.now)
        digits = re.search(r"\d[\d,]*(\.\d+)?", printed)  # rounding has none
        if digits and not re.search(rf"(?<![\d.,]){re.escape(digits[0])}(?!\d)", text):
            yield f"{one.number.name!r} is {printed}; {day.guide} does not print it"


@contextmanager
def turned(module: ModuleType, **values: Any) -> Iterator[None]:
    """Give a module's constants other values for a while.

    Args:
        module: a lab, or what it imports.
        values: by name; each must be there.
    """
    before = {name: getattr(module, name) for name in values}
    vars(module).update(values)
    try:
        yield
    finally:
        vars(module).update(before)


def altered(
    model: mujoco.MjModel,
    metre: float = 1.0,
    masses: float = 1.0,
    armature: float = 1.0,
    damping: float = 1.0,
    gravity: float = 1.0,
    step: float = 0.0,
) -> mujoco.MjModel:
    """Return a model with these of its numbers multiplied, as if its file had them.

    Args:
        model: which is changed.
        metre: all lengths; the inertias follow.
        masses: masses and inertias of the bodies.
        armature: inertias of the rotors.
        damping: damping of the joints.
        gravity: gravity.
        step: the new time step, s; 0 keeps the old one.
    """
    for lengths in (model.body_pos, model.body_ipos, model.site_pos):
        lengths[:] *= metre
    model.body_mass[:] *= masses
    model.body_inertia[:] *= masses * metre**2
    model.dof_armature[:] *= armature
    model.dof_damping[:] *= damping
    model.opt.gravity[:] *= gravity
    model.opt.timestep = step or model.opt.timestep
    mujoco.mj_setConst(model, mujoco.MjData(model))
    return model
