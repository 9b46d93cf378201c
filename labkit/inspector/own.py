"""The student's functions, asked in the sandbox, beside the library's of the same name.

    own = page.own(dynamics)                   # the library's module of the day
    tau = own.gravity_torque(J, masses, coms, g)      # on a thread: it waits

Where there is no file yet, or the function is still to do, the library's value comes
back, and `says` names it as the library's. What stops, hangs, or is no number of the
right shape raises NoAnswerError: nothing else is passed off as the student's.
"""

import contextlib
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from labkit.base.exchange import LoadError, Question
from labkit.check.memory import passing
from labkit.check.own_functions import statuses
from labkit.inspector import words
from labkit.inspector.student import Student, describe
from labkit.lesson.day import all_days
from labkit.sandbox.messages import library_of
from labkit.sandbox.sandbox import Sandbox, Session

SAME = 1e-7  # equal numbers differ by less than this share of the largest
UNWRITTEN = ("missing", "NotImplementedError")
Call = tuple[Any, ...]  # a function's name, then its arguments


class NoAnswerError(Exception):
    """A function of the student's gave no answer; the message says why."""

    version = 0  # the version of the file that gave no answer


class Told(NamedTuple):
    """What one file's functions have shown."""

    apart: dict[str, float]  # how far from the library's, by function; 0 for the same
    lent: dict[str, str]  # functions that the library answered instead, and why
    none: dict[str, str]  # functions that gave no answer at the last call, and why
    other: dict[str, str]  # functions that the tab found to be wrong, and how


class Library:
    """The reference of the same names, asked in the same way as `Own`."""

    def __init__(self, library: Any) -> None:
        """Take a module, or {name: function}."""
        self._library = library if isinstance(library, Mapping) else vars(library)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """Return a function by its name."""
        return self._library[name]

    def many(self, *calls: Call) -> list[Any]:
        """Return the answers to several calls (name, argument, ...)."""
        return [self._library[name](*args) for name, *args in calls]


class Own:
    """The functions of one day's file, and how they compare with the library's."""

    def __init__(
        self,
        student: Student,
        library: Any,
        free: Collection[str] = (),
        any_rows: Collection[str] = (),
        units: Mapping[str, str] | None = None,
        first: Callable[[], object] = lambda: None,
    ) -> None:
        """Ask nobody yet, see `Page.own`; `first` is called, on the thread that asks,
        before a file is asked for a function for the first time.
        """
        self._first = first
        self._units = units or {}
        self._free = {*free, *any_rows}
        self._any_rows = any_rows
        self._student = student
        self._library = library if isinstance(library, Mapping) else vars(library)
        self._told: dict[int, Told] = {}  # by the version that gave the answers

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """Return a function of the student's by its name."""
        if name not in self._library:
            raise AttributeError(f"what page.own(...) was given has no {name}")
        return lambda *args: self.many((name, *args))[0]

    def many(self, *calls: Call) -> list[Any]:
        """Return the answers to several calls (name, argument, ...), asked at once.

        Where one of them gave none NoAnswerError is raised.
        """
        version = self.version  # a file that comes meanwhile is another one
        told = Told({}, {}, {}, {})
        if not {name for name, *_ in calls} <= self._heard(version):
            self._first()
        try:
            return self._answers(calls, version, told)
        except NoAnswerError as error:
            error.version = version
            raise
        finally:
            self._keep(version, told)

    def _heard(self, version: int) -> set[str]:
        """Return the functions that this file has been asked for."""
        apart, lent, none, _ = self._told.get(version, Told({}, {}, {}, {}))
        return {*apart, *lent, *none}

    @property
    def version(self) -> int:
        """Which file is there: another number after each save; -1 for none."""
        return self._student.version if self._student.there else -1

    def _answers(self, calls: Sequence[Call], version: int, told: Told) -> list[Any]:
        """Return the answers, having noted how they compare."""
        right = [self._right(name, args) for name, *args in calls]
        student = self._student
        if version < 0:
            looked = student.version
            why = "there is no file yet" if looked else "yours is being opened"
            told.lent.update({name: why for name, *_ in calls})
            return right
        questions = [Question("view", name, tuple(args)) for name, *args in calls]
        replies = student.ask(questions, version)
        if student.problem:
            says = f"YOUR {student.problem}"
            told.none[calls[0][0]] = says  # another job may end well after this
            raise NoAnswerError(says)
        answers = []
        for (name, *_), reply, truth in zip(calls, replies, right, strict=True):
            try:
                answers.append(self._answer(name, reply, truth, told))
            except NoAnswerError as error:
                told.none[name] = str(error)
                raise
        return answers

    def _right(self, name: str, args: Sequence[Any]) -> Any:
        """Return the library's answer; what it refuses another of theirs has given."""
        try:
            return self._library[name](*args)
        except Exception as error:
            says, kind = self.says()
            known = f"{says}. " if kind == "bad" else ""
            refused = f"The library's {name} refuses what it is given: {error}"
            raise NoAnswerError(f"{known}{refused}") from error

    def _keep(self, version: int, told: Told) -> None:
        """Keep what was noted of a file; another thread may ask another file."""
        before = self._told.setdefault(version, Told({}, {}, {}, {}))
        before.lent.update(told.lent)
        for name in {*told.apart, *told.lent}:
            before.none.pop(name, None)
        before.none.update(told.none)
        for name, off in told.apart.items():
            before.apart[name] = max(before.apart.get(name, 0.0), off)

    def _answer(self, name: str, reply: Any, right: Any, told: Told) -> Any:
        """Return one function's answer, having compared it."""
        if reply.kind in UNWRITTEN:
            told.lent[name] = "yours is not written yet"
            return right
        if problem := describe(self._student.day, name, reply):
            raise NoAnswerError(f"YOUR {problem}")
        ours = _parts(right)
        theirs = _parts(reply.value)
        leave = int(name in self._any_rows)  # the first size
        if [np.shape(x)[leave:] for x in ours] != [np.shape(x)[leave:] for x in theirs]:
            got = " and ".join(f"shape {np.shape(x)}" for x in theirs) or "nothing"
            raise NoAnswerError(f"YOUR {name} returned {got}")
        if not all(np.isfinite(x).all() for x in theirs):
            raise NoAnswerError(f"YOUR {name} returned NaN, or a number without end")
        for mine, truth in zip(theirs, ours, strict=True):
            apart = np.zeros(1) if leave else np.abs(mine - truth)
            off = float(apart.max(initial=0.0))
            scale = 1.0 + float(np.abs(truth).max(initial=0.0))
            judged = name not in self._free and off > SAME * scale
            told.apart[name] = max(told.apart.get(name, 0.0), off if judged else 0.0)
        return _as_drawn(reply.value)

    def tell(self, name: str, how: str) -> None:
        """Say how an answer is wrong, where the tab compares; "" for a right one."""
        if told := self._told.get(self.version):
            told.other[name] = how

    def fresh(self) -> bool:
        """Return whether the file that is there has been asked."""
        return self.version in self._told and not self._student.saved()

    def kind(self, names: Collection[str]) -> str:
        """Return whether functions agree with the library's: "good", "bad", or "".

        "" is said where the library answered for one of them, or none was asked.
        """
        told = self._told.get(self.version, Told({}, {}, {}, {}))
        if any(told.apart.get(n) or told.other.get(n) or n in told.none for n in names):
            return "bad"
        return "good" if set(names) <= {*told.apart} - {*told.lent} else ""

    def says(self) -> tuple[str, str]:
        """Return whose functions were at work, and how they compare; its kind."""
        units = self._units
        apart, lent, none, other = self._told.get(self.version, Told({}, {}, {}, {}))
        if none:
            return next(iter(none.values())), "bad"
        wrong = [
            f"{name} by {words.digits(x)} {units.get(name, '')}".rstrip()
            for name, x in apart.items()
            if x
        ] + [f"{name} ({how})" for name, how in other.items() if how]
        if wrong:
            return f"YOUR functions. Off the library's: {', '.join(wrong)}", "bad"
        why = next(iter(lent.values()), "")
        theirs = f"the library's {', '.join(lent)} ({why})" if lent else ""
        if not apart:
            return f"At work: {theirs}" if theirs else "", "quiet"
        free = ", ".join(name for name in apart if name in self._free)
        judged = ", ".join(name for name in apart if name not in self._free)
        text = f"YOUR {judged}: the same as the library's" if judged else ""
        if free:  # the tab itself says how far these are right
            text = f"{text}; at work: {free}" if text else f"YOUR {free} at work"
        return f"{text}; besides {theirs}" if theirs else text, "good"


def _parts(value: Any) -> Sequence[Any]:
    """Return an answer as arrays, one unless it is a tuple."""
    if value is None:
        return []
    some = value if isinstance(value, tuple) else (value,)
    plain = (list(map(ord, one)) if isinstance(one, str) else one for one in some)
    return [np.asarray(part, dtype=float) for part in plain]


def _as_drawn(value: Any) -> Any:
    """Return an answer with its lists as arrays; a truth value and an index stay."""
    if isinstance(value, tuple):
        return tuple(map(_as_drawn, value))
    rows = isinstance(value, list) or getattr(value, "ndim", 0) > 0
    return np.asarray(value, dtype=float) if rows else value


@contextlib.contextmanager
def week(library: Mapping[str, Callable[..., Any]]) -> Iterator[SimpleNamespace]:
    """Yield those functions, the student's of all days where they pass `make check`.

    `yours` counts them. `labkit.check.own_functions` does the same, but it loads the
    files into the process that asks; here each day's file is in a sandbox of its own.
    """
    fns = SimpleNamespace(**library)
    fns.yours = 0
    fns.total = len(library)
    with Sandbox() as sandbox:
        for day in all_days():
            if not (own := set(library).intersection(passing(day, statuses(day)))):
                continue
            with contextlib.suppress(LoadError):
                session = sandbox.session(day.work, [], library_of(day))
                vars(fns).update({f: partial(_ask_of, session, f) for f in own})
                fns.yours += len(own)
        yield fns


def _ask_of(session: Session, name: str, *args: Any) -> Any:
    """Return what a function returns, or raise NoAnswerError."""
    (reply,) = session.ask([Question("view", name, args)])
    if reply.kind:
        raise NoAnswerError(f"YOUR {name}: {reply.kind} {reply.error}")
    return reply.value
