"""Run a student's functions in a process of their own and bring back plain arrays.

The process stands behind the wall that this machine has (`robo47.checker.wall`), with
no file of the kit or the student in sight, within limits of time and memory. Replies
come on a private channel, each behind a secret made for that run. A function that hangs
or ends the interpreter costs its own task, and those that build on it; the rest is
asked again in a fresh process.
"""

import contextlib
import time
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from robo47.checker.process import EndedError, Process
from robo47.checker.replies import Question, Reply, pack, twice

CALL_SECONDS, TASK_SECONDS = 3.0, 10.0  # for one call, for all calls of a task
CPU_SECONDS, SESSION_CPU_SECONDS = 120, 7200


class Session:
    """A student's loaded file that answers again and again, until it hangs."""

    def __init__(self, process: Process) -> None:
        """Take a process that has loaded the file."""
        self._process = process
        self._ended: Reply | None = None

    @property
    def alive(self) -> bool:
        """Whether it still answers; where not, open another session."""
        return self._ended is None

    def ask(
        self, questions: Sequence[Question], seconds: float = CALL_SECONDS
    ) -> list[Reply]:
        """Ask each question once.

        Args:
            questions: what to call.
            seconds: for one call. Whoever takes longer ends the session.

        Returns:
            One reply per question; "stopped" from where the session ended.
        """
        replies: list[Reply] = []
        if self._ended is None:
            self._process.ask(map(pack, questions))
        while len(replies) < len(questions) and self._ended is None:
            try:
                replies.append(self._process.next(seconds))
            except EndedError as error:
                self._ended = error.reply
                self._process.close()
        missing = len(questions) - len(replies)
        return replies + [self._ended] * missing if self._ended else replies

    def close(self) -> None:
        """End it."""
        if self._ended is None:
            self._ended = Reply(error="the session was closed", kind="stopped")
            self._process.close()


class Sandbox:
    """Processes for one student's file after the other; the next is always warm."""

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
            Robo47Error: there is no such file, it is no script, or no process starts.
        """
        replies: dict[int, Reply] = {}
        request = _request(models, facts, library, keep=True, cpu_seconds=CPU_SECONDS)
        while left := [i for i in range(len(questions)) if i not in replies]:
            with contextlib.closing(self._take()) as process:
                process.load(script, request)
                rounds = _Rounds(process, questions, left)
                stopped = rounds.ask()
            replies |= rounds.whole()
            if stopped:
                at, reply = stopped
                culprit = questions[at].task
                waiting = _dependents(culprit, needs or {})
                replies |= {at: reply}
                for i in left:
                    if i not in replies and questions[i].task == culprit:
                        once = rounds.first.get(i)
                        replies[i] = twice(once, once) if once else reply
                    elif i not in replies and questions[i].task in waiting:
                        replies[i] = Reply(error=f"task {culprit}", kind="waits")
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
            models, facts, library, keep=False, cpu_seconds=SESSION_CPU_SECONDS
        )
        process = self._take()
        try:
            process.load(script, request)
        except BaseException:
            process.close()
            raise
        self._warm = Process()  # for the next one, which a person will wait for
        self._sessions = [session for session in self._sessions if session.alive]
        self._sessions.append(Session(process))
        return self._sessions[-1]

    def _take(self) -> Process:
        process, self._warm = self._warm or Process(), None
        return process


class _Rounds:
    """Some questions asked in order, then in reverse order of the file loaded anew."""

    def __init__(
        self, process: Process, questions: Sequence[Question], left: list[int]
    ) -> None:
        self.process, self.questions, self.left = process, questions, left
        self.first: dict[int, Reply] = {}
        self.second: dict[int, Reply] = {}

    def ask(self) -> tuple[int, Reply] | None:
        """Fill both rounds; return where it ended early, and why, or None."""
        order = [*self.left, *reversed(self.left)]
        spare: defaultdict[str, float] = defaultdict(lambda: TASK_SECONDS)
        calls = [pack(self.questions[i]) for i in order]
        calls[len(self.left)]["anew"] = True  # what the file kept so far is gone
        self.process.ask(calls)
        for position, i in enumerate(order):
            task = self.questions[i].task
            started = time.monotonic()
            try:
                reply = self.process.next(min(CALL_SECONDS, spare[task]))
            except EndedError as error:
                return i, error.reply
            spare[task] -= time.monotonic() - started
            (self.first if position < len(self.left) else self.second)[i] = reply
        return None

    def whole(self) -> dict[int, Reply]:
        """Return what was answered twice."""
        return {i: twice(self.first[i], again) for i, again in self.second.items()}


def _request(
    models: Sequence[dict[str, Any]],
    facts: dict[str, Any],
    library: Mapping[str, str] | None,
    **others: Any,
) -> dict[str, Any]:
    known = {"models": list(models), "facts": facts, "library": dict(library or {})}
    return {**known, **others}


def _dependents(task: str, needs: Mapping[str, Iterable[str]]) -> set[str]:
    """Return the tasks that build on a task, however indirectly."""
    found = {task}
    while more := {t for t in needs if found & set(needs[t])} - found:
        found |= more
    return found - {task}
