"""The student's file behind the page: kept warm in the checker's sandbox, reloaded.

A thread of its own looks at the file twenty times a second, opens it anew when it was
saved, and asks it for the newest configuration; what comes back is delivered on the
server's event loop. Nothing of the student's runs in this process.
"""

import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from labkit.base.exchange import LoadError, Question, Reply
from labkit.inspector.ghost import Ghost, Seen, no_pose
from labkit.judge.problems import no_answer, not_loaded, stops_with
from labkit.lesson.day import Day
from labkit.sandbox.messages import library_of
from labkit.sandbox.sandbox import Sandbox, Session
from robo47.checks import Array
from robo47.errors import Robo47Error

POLL_SECONDS, ASK_SECONDS = 0.05, 2.0
Ask = Callable[[Sequence[Question]], Sequence[Reply]]


@dataclass(frozen=True)
class Source:
    """The student's file, and how it is opened."""

    script: Path  # it need not be there
    open: Callable[[Path], Session]  # in the sandbox; raises LoadError
    describe: Callable[[str, Reply], str]  # what a reply that is no answer means


def source_of(day: Day, model: mujoco.MjModel, sandbox: Sandbox) -> Source:
    """Return a day's file, to be opened in a sandbox with the model of questions."""

    def opened(script: Path) -> Session:
        return sandbox.session(script, [model], library_of(day), limits=day.limits)

    tasks = {name: task.id for task in day.tasks for name in task.functions}
    return Source(day.work, opened, partial(describe, tasks))


def describe(tasks: Mapping[str, str], function: str, reply: Reply) -> str:
    """Return in the checker's words what a function's reply that is no answer means.

    "" where it is one. The tasks are {function: the task whose it is}.
    """
    if not reply.kind:
        return ""
    verdict = no_answer(reply, function, tasks.get(function, ""))
    says = verdict.message if verdict else stops_with(reply)
    return says if function in says else f"{function}: {says}"


class Student(threading.Thread):
    """Asks the student's function for every configuration, the newest first."""

    def __init__(
        self,
        source: Source,
        ghost: Ghost | None,
        model: mujoco.MjModel,
        deliver: Callable[[Seen | None], None],
        saved: Callable[[], None],
    ) -> None:
        """Prepare; `start` runs it.

        Args:
            source: the file.
            ghost: what to ask for the arm's poses; None where only the day's tabs ask.
            model: the robot.
            deliver: is given what the function said; None where there is no file.
            saved: called when the file was opened anew.
        """
        super().__init__(daemon=True, name="student")
        self.source, self.ghost, self.model = source, ghost, model
        self.deliver, self.saved = deliver, saved
        self.news = threading.Event()
        self.q: Array | None = None
        self.ended = False
        self.version = 0  # of the file: another one after each save
        self.problem = ""  # why the file is not asked, in a sentence
        self._lock = threading.RLock()  # a session answers one thread at a time
        self._asker: Session | None = None
        self._stamp: tuple[int, ...] | None = ()  # never looked

    def want(self, q: Array) -> None:
        """Ask for a configuration, (nq,), instead of any that waits."""
        self.q = q.copy()
        self.news.set()

    @property
    def there(self) -> bool:
        """Whether there is a file."""
        return bool(self._stamp)

    def ask(self, questions: Sequence[Question]) -> list[Reply]:
        """Ask any functions, now, on the caller's thread; see `problem` afterwards."""
        with self._lock:
            if self._asker is None:
                ended = Reply(kind="stopped", error="it is not asked")
                return [ended] * len(questions)
            try:
                replies = self._asker.ask(questions, seconds=ASK_SECONDS)
            except Exception as error:  # ours, or the day's: the page goes on
                says = f"{type(error).__name__}: {error}"
                return [Reply(kind="unsendable", error=says)] * len(questions)
            if not self._asker.alive:
                kinds = [reply.kind for reply in replies]
                at = kinds.index("stopped") if "stopped" in kinds else -1
                why = self.source.describe(questions[at].function, replies[at])
                self._shut()
                self.problem = f"{why} Save the file to have it asked again."
            return replies

    def close(self) -> None:
        """End the thread and the sandbox."""
        self.ended = True
        self.news.set()

    def run(self) -> None:
        """Look, ask, deliver, until it is closed."""
        done: Array | None = None
        while not self.ended:
            with self._lock:
                if changed := self._look():
                    done = None
            self.news.clear()
            if (q := self.q) is not None and q is not done:
                done = q
                self.deliver(self._seen(q))
            if changed:
                self.saved()  # the checks need both cores; first the ghost
            self.news.wait(POLL_SECONDS)
        self._shut()

    def _look(self) -> bool:
        """Open the file anew where it changed; return whether it did."""
        stamp = _stamp_of(self.source.script)
        if stamp == self._stamp:
            return False
        self._stamp = stamp
        self._shut()
        self.problem = self._open() if stamp else ""
        self.version += 1
        return True

    def _open(self) -> str:
        try:
            self._asker = self.source.open(self.source.script)
        except LoadError as error:
            return not_loaded(self.source.script, error.reply)
        except (Robo47Error, OSError) as error:
            return str(error)
        return ""

    def _shut(self) -> None:
        if self._asker is not None:
            self._asker.close()
            self._asker = None

    def _seen(self, q: Array) -> Seen | None:
        """Return the student's poses at a configuration."""
        if self._stamp is None:
            return None
        if self._asker is None or self.ghost is None:
            return Seen(q, problem=self.problem)
        try:
            poses, why = poses_of(self.ask, self.source, self.ghost, self.model, q)
        except Exception as error:  # the day's: the page goes on
            return Seen(q, problem=f"not asked: {type(error).__name__}: {error}")
        return Seen(q, poses, self.problem or why)


def poses_of(
    ask: Ask, source: Source, ghost: Ghost, model: mujoco.MjModel, q: Array
) -> tuple[dict[str, Array], str]:
    """Return the poses that the ghost's function gives at q, (nq,), and "" or why not.

    The file's session, or its student, is asked; the source says what replies mean.
    """

    def asked(
        frames: Sequence[str], some: Sequence[tuple[Any, ...]]
    ) -> tuple[dict[str, Array], str]:
        questions = [Question("ghost", ghost.function, tuple(args)) for args in some]
        poses, problem = {}, ""
        for name, reply in zip(frames, ask(questions), strict=True):
            said = source.describe(ghost.function, reply)
            if not said and not (said := no_pose(ghost.function, reply.value)):
                poses[name] = np.array(reply.value, dtype=np.float64)
            problem = problem or said
        return poses, problem

    poses, problem = asked(ghost.frames, ghost.questions(model, q))
    if not poses and ghost.whole is not None:
        end = ghost.frames[-1:]
        poses, why = asked(end, [ghost.whole(model, q)])
        problem = why or f"Only {end[0]} is drawn: {problem}"
    return poses, problem


def _stamp_of(script: Path) -> tuple[int, ...] | None:
    """Return what changes when a file is saved; None where there is no file."""
    try:
        status = script.stat()
    except OSError:
        return None
    return (status.st_mtime_ns, status.st_size) if script.is_file() else None
