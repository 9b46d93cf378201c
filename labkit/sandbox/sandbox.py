"""Run a student's functions in a process of their own and bring back plain arrays.

The process stands behind the wall that this machine has (`labkit.sandbox.process`),
with no file of the kit or the student in sight, within limits of time and memory.
Replies come on a private channel, each behind a secret made for that run. A function
that hangs or ends the interpreter costs its own task, and those that build on it; the
rest is asked again in a fresh process.

What this machine does is nobody's mistake. A process that a signal ended is tried once
more, and only the same again is the student's doing; where Linux says that it killed
for want of memory, and the process held little of it, a FaultError says so. The limits
of time do not count what a process waits for a processor.
"""

import contextlib
import math
import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from operator import methodcaller
from pathlib import Path
from typing import Any

from labkit.base import processes
from labkit.base.deadline import Deadline
from labkit.base.exchange import (
    CHANNEL,
    MOST,
    EndedError,
    Exchange,
    LoadError,
    Question,
    Reply,
    stopped,
)
from labkit.lesson.day import Day, Limits
from labkit.sandbox import messages
from labkit.sandbox.messages import USUAL, Robots
from labkit.sandbox.process import ENDLESS, LOAD_SECONDS, Process
from robo47.errors import FaultError

# limits for one call and for all calls of a task
CALL_SECONDS, TASK_SECONDS = 3.0, 10.0
RUN_SECONDS = 100.0  # the limit of a submission with all its restarts and its lab
TOO_LONG = "all of its calls together take far too long"
CPU, SESSION_CPU = 120, 7200  # seconds of a processor
# Fields of a request.
_SAME = ("file", "code", "beside", "library", "memory", "numbers")


def deadline_of(day: Day) -> Deadline:
    """Return what a submission has for a day: one clock, from its tasks to its lab."""
    return Deadline(RUN_SECONDS + _more(day.limits) + day.lab_seconds)


def _more(limits: Limits) -> float:
    """Return for how many seconds tasks ask beyond the usual."""
    return sum(max(0.0, s - TASK_SECONDS) for s in limits.seconds.values())


class Sandbox:
    """Processes for one student's file after the other; the first is warm."""

    def __init__(self, warm: Process | None = None) -> None:
        """Take the first process, or start it: it loads while the caller prepares."""
        self._warm: Process | None = warm or Process()
        self._kept: Process | None = None  # a process whose file may be asked more
        self._odd = False  # a file that could be loaded before, and once more not
        self._sessions: list[Session] = []

    def __enter__(self) -> "Sandbox":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """End what is left."""
        for session in self._sessions:
            session.close()
        for process in filter(None, (self._warm, self._kept)):
            process.close()
        self._warm = self._kept = None

    def run(
        self,
        script: Path,
        exchanges: Sequence[Exchange],
        library: Mapping[str, str] | None = None,
        needs: Mapping[str, Iterable[str]] | None = None,
        added: str = "",
        limits: Limits = USUAL,
        deadline: Deadline | None = None,
    ) -> None:
        """Ask a student's file, each question twice: in order, then in reverse order.

        Args:
            script: the file; the other `.py` files beside it may be imported by it.
            exchanges: what to call; their replies are filled in.
            library: modules of the kit that it may import, with all that those import:
                source by name, {"robo47.se3": "..."}. Other modules of the kit are
                fakes.
            needs: the tasks that each task builds on, however indirectly. What builds
                on one that was stopped is not asked: its replies are of the kind
                "waits".
            added: code of the kit's, as if it stood at the end of the file.
            limits: what it may take.
            deadline: of the submission; None is one for this run alone.

        Raises:
            LoadError: the file does not load.
            FaultError: no process starts, or this machine ended it.
            Robo47Error: there is no such file, or it is no script.
        """
        robots = messages.robots_of([exchange.question for exchange in exchanges])
        more = _more(limits)
        request = messages.request(
            script, robots, library, added, limits, keep=True, cpu_seconds=CPU + more
        )
        deadline = deadline or Deadline(RUN_SECONDS + more)
        killed = False
        while left := [exchange for exchange in exchanges if exchange.reply is None]:
            rounds = _Rounds(left, deadline, limits)
            if deadline.over:
                for exchange in left:
                    exchange.reply = stopped(TOO_LONG)
                break
            process = self._again(request) or self._take(limits.extras)
            deadline.watch(process)
            with contextlib.ExitStack() as ends:
                ends.callback(process.close)
                try:
                    if not process.told:
                        process.load(request)
                    rounds.ask(process)
                except LoadError:
                    if killed or not process.killed:
                        raise
                # the second attempt shows who killed it
                if process.killed and not killed:
                    killed = True
                    continue
                if not rounds.ended:
                    ends.pop_all()
                    self._keep(process)
            rounds.fill(needs or {})

    def session(
        self,
        script: Path,
        robots: Robots = (),
        library: Mapping[str, str] | None = None,
        added: str = "",
        limits: Limits = USUAL,
        *,
        brief: bool = False,
        deadline: Deadline | None = None,
    ) -> "Session":
        """Return a student's file, loaded, for many rounds of questions.

        Args:
            script, library, added, limits: see `run`.
            robots: those that questions will hold.
            brief: it takes a process that has the file where there is one. One that is
                not has a new one, and the next is made ready for the next save.
            deadline: of the submission; None is none, for a page.

        Raises:
            LoadError: the file does not load.
        """
        request = messages.request(
            script, robots, library, added, limits, keep=False, cpu_seconds=SESSION_CPU
        )
        process = (brief and self._again(request)) or self._take(limits.extras)
        try:
            if not process.told:
                process.load(request)
        except BaseException:
            process.close()
            raise
        alive = [session for session in self._sessions if session.alive]
        back = self._keep if brief else methodcaller("close")
        session = Session(process, limits, back, deadline or Deadline(math.inf))
        self._sessions = [*alive, session]
        if not brief:
            with contextlib.suppress(FaultError):
                self._warm = Process(limits.extras)
        return session

    def _keep(self, process: Process) -> None:
        """Take a process whose file may be asked more."""
        if self._kept or self._odd:
            process.close()
        else:
            self._kept = process

    def _again(self, request: dict[str, Any]) -> Process | None:
        """Return the process that was kept with its file loaded anew, if it is that."""
        process = self._kept
        self._kept = None
        if process is None:
            return None
        had = process.told
        same = all(had[name] == request[name] for name in _SAME)
        if same and request["added"].startswith(had["added"]):  # it forgets no code
            more = [model for model in request["models"] if model not in had["models"]]
            process.ask([_anew(request["added"], request["keep"], more)])
            with contextlib.suppress(EndedError, FaultError):
                process.next(LOAD_SECONDS)
                process.told = {**request, "models": had["models"] + more}
                return process
            self._odd = True
        process.close()
        return None

    def _take(self, extras: tuple[str, ...]) -> Process:
        """Return the warm process, or a new one where that lacks what is asked for."""
        process = self._warm
        self._warm = None
        if process and extras and process.extras != extras:
            process.close()
            process = None
        return process or Process(extras)


class Session:
    """A student's file that stays loaded and answers again and again, until it hangs.

    A page asks it many times a second.
    """

    def __init__(
        self,
        process: Process,
        limits: Limits,
        back: Callable[[Process], None],
        deadline: Deadline,
    ) -> None:
        """Take a process that has loaded the file, and who gets it back at the end."""
        self._process, self._limits, self._back = process, limits, back
        self._deadline = deadline
        deadline.watch(process)
        self._ended: Reply | None = None

    @property
    def alive(self) -> bool:
        """The session still answers; if not, open another one."""
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
        came: list[dict[str, Any]] = []
        if self._ended is None:
            self._process.ask(
                messages.pack(
                    questions, self._process.told["models"], self._process.worlds
                )
            )
        while len(came) < len(questions) and self._ended is None:
            try:
                came.append(_next(self._process, seconds, self._deadline))
            except (EndedError, FaultError) as error:
                self._end(str(error))
        replies = messages.read(came, self._limits.numbers)
        if len(replies) < len(came):
            self._end(CHANNEL)
        missing = len(questions) - len(replies)
        return replies + [self._ended] * missing if self._ended else replies

    def used(self) -> tuple[float, float]:
        """Return for how many seconds it had a processor, and waited for one."""
        return self._process.used()

    def halt(self) -> None:
        """End the process from another thread: who waits for an answer hears so."""
        processes.end(self._process.process)

    def close(self) -> None:
        """End it."""
        if self._ended is None:
            self._ended = stopped("the session was closed")
            self._back(self._process)

    def _end(self, why: str) -> None:
        self._ended = stopped(why)
        self._process.close()


class _Rounds:
    """Questions asked in order, then in reverse order of the file loaded anew."""

    def __init__(
        self, left: list[Exchange], deadline: Deadline, limits: Limits
    ) -> None:
        self.left = left
        self.deadline = deadline
        self.numbers = limits.numbers
        self.first: dict[Exchange, Reply] = {}
        self.second: dict[Exchange, Reply] = {}
        # the exchange at which it ended, and the reply
        self.ended: tuple[Exchange, Reply] | None = None
        self.call: defaultdict[str, float] = defaultdict(lambda: CALL_SECONDS)
        # seconds per call so far, by function
        self.took: defaultdict[str, list[float]] = defaultdict(list)
        self.spare: defaultdict[str, float] = defaultdict(lambda: TASK_SECONDS)
        for task, seconds in limits.seconds.items():
            if seconds > TASK_SECONDS:
                self.call[task] = seconds / 3.0
                self.spare[task] = seconds

    def ask(self, process: Process) -> None:
        """Ask all of them in both rounds, or until the process ends."""
        questions = [exchange.question for exchange in self.left]
        calls = messages.pack(questions, process.told["models"], process.worlds)
        process.ask([*calls, _anew(process.told["added"]), *reversed(calls)])
        self._listen(process, self.left, self.first)
        if not self.ended:
            self._reload(process)
        if not self.ended:
            self._listen(process, self.left[::-1], self.second)

    def _reload(self, process: Process) -> None:
        """Wait until the file is loaded once more, as long as for the first time."""
        try:
            _next(process, LOAD_SECONDS, self.deadline)
        except EndedError as error:
            says = f"the file, loaded once more: {error}"
            self.ended = self.left[-1], stopped(says)

    def _listen(
        self, process: Process, asked: list[Exchange], into: dict[Exchange, Reply]
    ) -> None:
        """Take the replies of one round."""
        came: list[dict[str, Any]] = []
        for exchange in asked:
            task = exchange.question.task
            started = time.monotonic()
            waited = process.waited
            seconds = min(self.call[task], self.spare[task])
            try:
                came.append(_next(process, seconds, self.deadline))
            except EndedError as error:
                self.ended = exchange, self._timed(task, error.reply)
                break
            took = time.monotonic() - started - (process.waited - waited)
            self.spare[task] -= took
            self.took[task].append(took)
        found = messages.read(came, self.numbers)
        into.update(zip(asked, found, strict=False))
        if len(found) < len(came):
            self.ended = asked[len(found)], stopped(CHANNEL)

    def _timed(self, task: str, reply: Reply) -> Reply:
        """Return the reply of a call that was stopped, with the time that it had."""
        if reply.error != ENDLESS:
            return reply
        took = self.took[task]
        whole = self.spare[task] < self.call[task]
        given = self.spare[task] + sum(took) if whole else self.call[task]
        came = len(took) if whole else 0
        return replace(reply, given=given, came=came, longest=max(took, default=0.0))

    def fill(self, needs: Mapping[str, Iterable[str]]) -> None:
        """Fill in what was answered twice, and what is not asked again."""
        for exchange, again in self.second.items():
            exchange.reply = twice(self.first[exchange], again)
        if not self.ended:
            return
        at, why = self.ended
        culprit = at.question.task
        at.reply = why
        waiting = {task for task in needs if culprit in needs[task]}
        for exchange in self.left:
            if exchange.reply is not None:
                continue
            if exchange.question.task == culprit:
                once = self.first.get(exchange)
                exchange.reply = twice(once, once) if once else why
            elif exchange.question.task in waiting:
                exchange.reply = Reply(error=f"task {culprit}", kind="waits")


def _anew(added: str, keep: bool = True, models: Sequence[Any] = ()) -> dict[str, Any]:
    """Return a call that loads the file anew: what it kept is gone, and its answers."""
    told = {"added": added, "keep": keep, "models": models}
    return {"function": "", "args": [], "anew": told}


def _next(process: Process, seconds: float, deadline: Deadline) -> dict[str, Any]:
    """Return a process's next reply.

    Raises:
        EndedError: none came within so many seconds, or before the deadline, or ever
            will: it says which.
        FaultError: this machine ended the process.
    """
    given = deadline.within(seconds)
    try:
        return process.next(given)
    except EndedError as error:
        cut = given < seconds and str(error) == ENDLESS
        raise EndedError(TOO_LONG if cut else str(error)) from None


def twice(first: Reply, second: Reply) -> Reply:
    """Return the first time's reply with what the second time adds to it."""
    error = ""
    if second.kind and not first.kind:
        error = ": ".join(filter(None, (second.kind, second.error)))
    return replace(
        first,
        again=second.value,
        again_error=error,
        changed=_union(first.changed, second.changed),
        refused=_union(first.refused, second.refused),
        shares=_union(first.shares, second.shares),
    )


def _union(*some: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(name for names in some for name in names))[:MOST]
