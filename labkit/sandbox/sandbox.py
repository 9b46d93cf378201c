"""Run a student's functions in a process of their own and bring back plain arrays.

The process stands behind the wall that this machine has (`labkit.sandbox.wall`), with
no file of the kit or the student in sight, within limits of time and memory. Replies
come on a private channel, each behind a secret made for that run. A function that hangs
or ends the interpreter costs its own task, and those that build on it; the rest is
asked again in a fresh process.

What this machine does is nobody's mistake. A process that a signal ended is tried once
more, and only the same again is the student's doing; where Linux says that it killed
for want of memory, and the process held little of it, a FaultError says so. The limits
of time do not count what a process waits for a processor.
"""

import contextlib
import time
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from labkit.judge.exchange import LoadError, Question, Reply, stopped, twice
from labkit.sandbox.messages import pack
from labkit.sandbox.process import EndedError, Process
from labkit.sandbox.session import CALL_SECONDS, Session
from labkit.sandbox.source import code_of
from robo47.errors import FaultError

TASK_SECONDS = 10.0  # for all calls of a task
RUN_SECONDS = 100.0  # for the whole file: all tasks together, however often begun anew
TOO_LONG = "all tasks together take far too long"
CPU_SECONDS, SESSION_CPU_SECONDS = 120, 7200


class Sandbox:
    """Processes for one student's file after the other; the first is warm."""

    def __init__(self) -> None:
        """Start the first process, so that it loads while the caller prepares."""
        self._warm: Process | None = Process()
        self._sessions: list[Session] = []

    def __enter__(self) -> "Sandbox":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """End what is left."""
        for session in self._sessions:
            session.close()
        if self._warm:
            self._warm.close()
            self._warm = None

    def run(
        self,
        script: Path,
        questions: Sequence[Question],
        models: Sequence[dict[str, Any]],
        facts: dict[str, Any],
        library: Mapping[str, str] | None = None,
        needs: Mapping[str, Iterable[str]] | None = None,
    ) -> list[Reply]:
        """Ask a student's file, each question twice: in order, then in reverse order.

        Args:
            script: the file; the other `.py` files beside it may be imported by it.
            questions: what to call.
            models: as `model_copy.copy_model` makes them, by `Model.index`.
            facts: `model_copy.facts()`.
            library: modules of the kit that it may import, with all that those import:
                source by name, {"robo47.se3": "..."}. Other modules of the kit are
                fakes.
            needs: the tasks that each task builds on. What builds on a task that was
                stopped is not asked: its replies are of the kind "waits".

        Returns:
            One reply per question.

        Raises:
            LoadError: the file does not load.
            FaultError: no process starts, or this machine ended it.
            Robo47Error: there is no such file, or it is no script.
        """
        replies: dict[int, Reply] = {}
        request = _request(
            script, models, facts, library, keep=True, cpu_seconds=CPU_SECONDS
        )
        deadline, killed = time.monotonic() + RUN_SECONDS, False
        while left := [i for i in range(len(questions)) if i not in replies]:
            if time.monotonic() > deadline:
                replies |= dict.fromkeys(left, stopped(TOO_LONG))
                break
            with contextlib.closing(self._take()) as process:
                rounds = _Rounds(process, questions, left, deadline)
                try:
                    process.load(request)
                    ended = rounds.ask()
                except LoadError:
                    if killed or not process.killed:
                        raise
                    ended = None
                deadline += process.waited
                if process.killed and not killed:  # by whom? The same again tells
                    killed = True
                    continue
            replies |= rounds.whole()
            if ended:
                replies |= rounds.without(*ended, needs or {})
        return [replies[i] for i in range(len(questions))]

    def session(
        self,
        script: Path,
        models: Sequence[dict[str, Any]],
        facts: dict[str, Any],
        library: Mapping[str, str] | None = None,
    ) -> Session:
        """Return the student's file, loaded, for many rounds of questions.

        Args:
            script: the file.
            models: see `run`.
            facts: see `run`.
            library: see `run`.

        Raises:
            LoadError: the file does not load.
            Robo47Error: there is no such file, it is no script, or no process starts.
        """
        request = _request(
            script,
            models,
            facts,
            library,
            keep=False,
            cpu_seconds=SESSION_CPU_SECONDS,
        )
        process = self._take()
        try:
            process.load(request)
        except BaseException:
            process.close()
            raise
        alive = [session for session in self._sessions if session.alive]
        self._sessions = [*alive, Session(process)]
        with contextlib.suppress(FaultError):  # a spare, for the next save
            self._warm = Process()
        return self._sessions[-1]

    def _take(self) -> Process:
        process, self._warm = self._warm or Process(), None
        return process


class _Rounds:
    """Some questions asked in order, then in reverse order of the file loaded anew."""

    def __init__(
        self,
        process: Process,
        questions: Sequence[Question],
        left: list[int],
        deadline: float,
    ) -> None:
        self.process, self.questions, self.left = process, questions, left
        self.deadline = deadline
        self.first: dict[int, Reply] = {}
        self.second: dict[int, Reply] = {}

    def ask(self) -> tuple[int, Reply] | None:
        """Fill both rounds; return where it ended early, and why, or None."""
        order = [*self.left, *reversed(self.left)]
        spare: defaultdict[str, float] = defaultdict(lambda: TASK_SECONDS)
        packed = {i: pack(self.questions[i]) for i in self.left}
        calls = [packed[i] for i in order]
        anew = len(self.left)  # from here on, what the file kept so far is gone
        calls[anew] = {**calls[anew], "anew": True}
        self.process.ask(calls)
        for position, i in enumerate(order):
            task = self.questions[i].task
            started, waited = time.monotonic(), self.process.waited
            left = self.deadline + waited - started
            try:
                reply = self.process.next(min(CALL_SECONDS, spare[task], left))
            except EndedError as error:
                late = time.monotonic() > self.deadline + self.process.waited
                return i, stopped(TOO_LONG) if late else error.reply
            spare[task] -= time.monotonic() - started - (self.process.waited - waited)
            (self.first if position < len(self.left) else self.second)[i] = reply
        return None

    def whole(self) -> dict[int, Reply]:
        """Return what was answered twice."""
        return {i: twice(self.first[i], again) for i, again in self.second.items()}

    def without(
        self, at: int, reply: Reply, needs: Mapping[str, Iterable[str]]
    ) -> dict[int, Reply]:
        """Return what is not asked again, since a question's reply ended it."""
        culprit = self.questions[at].task
        waiting = _dependents(culprit, needs)
        found = {}
        for i in self.left:
            task = self.questions[i].task
            if i == at:
                found[i] = reply
            elif i not in self.second and task == culprit:
                once = self.first.get(i)
                found[i] = twice(once, once) if once else reply
            elif i not in self.second and task in waiting:
                found[i] = Reply(error=f"task {culprit}", kind="waits")
        return found


def _request(
    script: Path,
    models: Sequence[dict[str, Any]],
    facts: dict[str, Any],
    library: Mapping[str, str] | None,
    **others: Any,
) -> dict[str, Any]:
    """Return what a process is told before the first question."""
    known = {"models": list(models), "facts": facts, "library": dict(library or {})}
    return {**known, **code_of(script), **others}


def _dependents(task: str, needs: Mapping[str, Iterable[str]]) -> set[str]:
    """Return the tasks that build on a task, however indirectly."""
    found = {task}
    while more := {t for t in needs if found & set(needs[t])} - found:
        found |= more
    return found - {task}
