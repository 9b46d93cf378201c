"""The sandbox's place taken by this process: for files of ours, in milliseconds.

Questions, replies and judging are the real ones; only the walls are missing.
"""

import contextlib
import copy
import functools
import inspect
import io
import itertools
import signal
import sys
import time
import types
from dataclasses import replace
from pathlib import Path as File

import mujoco
import numpy as np
import pytest

from labkit.base.exchange import LoadError, Path, Reply
from labkit.check import tasks
from labkit.judge import Robot
from labkit.judge.answers import InTurn
from labkit.lesson.day import NUMBERS
from labkit.sandbox.inside import wire
from labkit.sandbox.sandbox import twice
from robo47 import panda


class InProcess:
    """Runs a file as `Sandbox.run` does; robo47 and MuJoCo are the real ones."""

    alive = True

    def __init__(self, instead=None):
        """Take functions that stand in the file instead of its own, by name."""
        self.instead = instead or {}
        self.added = ""
        self.most = NUMBERS

    def run(
        self, script, exchanges, library, needs=None, added="", limits=None, _=None
    ):
        """Ask every question, load the file anew, and ask again from the end.

        A way is a function of this process, which is not loaded anew: of what it might
        keep, every third question tells.
        """
        self.added = added
        self.most = limits.numbers if limits else NUMBERS
        first = self._load(script)
        kept = []
        for exchange in exchanges:
            exchange.reply = self._ask(first, exchange.question, kept)
        second = self._load(script)
        for i, exchange in reversed(list(enumerate(exchanges))):
            again = exchange.reply
            if i % 3 == 0 or not self.instead:
                again = self._ask(second, exchange.question, [])
            exchange.reply = twice(exchange.reply, again)

    def session(self, script, robots, library, added="", limits=None, **_):
        """Return something to ask, as `Sandbox.session` does."""
        self.added = added
        self.module = self._load(script)
        self.began = time.process_time()
        return self

    def ask(self, questions, seconds=0.0):
        """Ask each question once; a call that takes longer is stopped."""
        return [self._within(seconds, question) for question in questions]

    def _within(self, seconds, question):
        before = signal.signal(signal.SIGALRM, _late)
        signal.setitimer(signal.ITIMER_REAL, seconds)
        try:
            return self._ask(self.module, question, [])
        except TimeoutError as error:  # of an answer that is as large as it is late
            return _describe(error, self.script)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, before)

    def used(self):
        """Return for how many seconds it had a processor; it did not wait."""
        return time.process_time() - self.began, 0.0

    def close(self):
        """End it."""

    def _load(self, script):
        module = types.ModuleType(script.stem)
        module.__file__ = str(script)
        before = sys.modules.get(script.stem)
        sys.modules[script.stem] = module  # a dataclass of the file looks for it
        try:
            code = _compiled(script.read_bytes(), str(script))
            with contextlib.redirect_stdout(io.StringIO()):
                exec(code, vars(module))
                vars(module).update(self.instead)
                exec(self.added, vars(module))
        except BaseException as error:
            raise LoadError(_describe(error, script)) from None
        finally:
            sys.modules.pop(script.stem)
            if before:
                sys.modules[script.stem] = before
        self.script = script
        return module

    def _ask(self, module, question, kept):
        function = getattr(module, question.function, None)
        if not callable(function):
            return Reply(kind="missing")
        args = [self._argument(arg) for arg in question.args]
        printed = io.StringIO()
        try:
            with contextlib.redirect_stdout(printed), np.errstate(all="ignore"):
                value = function(*args)
        except BaseException as error:
            return _describe(error, self.script)
        try:
            sent = wire.unpack_value(wire.pack_value(value, self.most))
        except wire.UnsendableError as error:
            return Reply(error=f"it returned {error}", kind="unsendable")
        changed = [
            i
            for i, (arg, was) in enumerate(zip(args, question.args, strict=True))
            if not _same(arg, was)
        ]
        shares, handed = _shares(value, kept, args)
        names = list(inspect.signature(function).parameters) if changed + handed else ()
        return Reply(
            value=sent,
            changed=tuple(names[i] for i in changed),
            printed=printed.getvalue(),
            shares=(*shares, *(names[i] for i in handed)),
        )

    def _argument(self, arg):
        if isinstance(arg, Robot):
            return arg.model
        if isinstance(arg, Path):
            return list(arg.pairs)
        if isinstance(arg, tuple | list):  # plain ones, as they come in the sandbox
            form = tuple if isinstance(arg, tuple) else list
            return form(map(self._argument, arg))
        return arg.copy() if isinstance(arg, np.ndarray) else arg


def _late(*_):
    raise TimeoutError


def _same(arg, was):
    """Return whether the arrays of an argument are what they were, NaN included."""
    now, before = _arrays_of(arg), _arrays_of(was)
    pairs = zip(now, before, strict=False)
    return len(now) == len(before) and all(
        np.array_equal(a, b, equal_nan=b.dtype.kind == "f") for a, b in pairs
    )


def _arrays_of(value):
    """Return the arrays that a value is or holds."""
    if isinstance(value, np.ndarray):
        return [value]
    some = value if isinstance(value, tuple | list) else ()
    return list(itertools.chain.from_iterable(map(_arrays_of, some)))


@functools.cache
def _compiled(source, name):
    return compile(source.replace(b"\nimport kit ", b"\n# "), name, "exec")


def _shares(value, kept, args):
    """Return what an answer is a part of: other answers, and arguments' places."""
    own = _arrays_of(value)
    another = _overlap(own, kept)
    kept.extend(own)
    handed = [i for i, arg in enumerate(args) if _overlap(own, _arrays_of(arg))]
    return ["another answer"] * another, handed


def _overlap(some, others):
    """Return whether an array of some is a part of one of the others."""
    return any(itertools.starmap(np.may_share_memory, itertools.product(some, others)))


def _describe(error, script):
    lines, trace = [], error.__traceback__
    while trace:
        if trace.tb_frame.f_code.co_filename == str(script):
            lines.append(trace.tb_lineno)
        trace = trace.tb_next
    line = lines[-1] if lines else getattr(error, "lineno", None)
    callers = [number for number in dict.fromkeys(reversed(lines)) if number != line]
    kind = type(error).__name__
    return Reply(error=str(error), kind=kind, line=line, callers=tuple(callers[:3]))


@contextlib.contextmanager
def worked_out_once():
    """Let all files of a day share each mistake's answers and the arms."""
    each, make_arm = InTurn.each, panda.arm
    answers, arms = {}, {}

    def remembered(self, columns):
        key = (self, *map(_content, columns))
        if key not in answers:
            try:
                found = each(self, columns)
            except ValueError as error:
                found = str(error)
            answers[key] = columns, found  # an id stays that of an object
        found = answers[key][1]
        if isinstance(found, str):
            raise ValueError(found)
        return found

    def arm(model):
        key = np.empty(mujoco.mj_sizeModel(model), np.uint8)
        mujoco.mj_saveModel(model, None, key)
        if key.tobytes() not in arms:
            arms[key.tobytes()] = make_arm(model)
        return copy.deepcopy(arms[key.tobytes()])

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(panda, "arm", arm)
        patch.setattr(tasks, "library_of", functools.cache(tasks.library_of))
        patch.setattr(InTurn, "each", remembered)
        yield


def _content(column):
    if not isinstance(column, np.ndarray):
        return id(column)
    if column.dtype == object:
        return tuple(map(_content, column))
    return column.shape, column.dtype.str, column.tobytes()


def verdicts(day, script: File, only=None, seed=1, instead=None, fresh=1):
    """Return {task: verdict} of a file of ours, some of its functions replaced.

    Of the questions that are drawn anew every `fresh`-th is asked.
    """
    asked_of = tasks.asked_of

    def fewer(*row):
        asked = asked_of(*row)
        return replace(asked, fresh=asked.fresh[::fresh])

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tasks, "asked_of", fewer)
        results = tasks.check_tasks(day, script, InProcess(instead), only, seed)
    return {result.task.id: result.verdict for result in results}
