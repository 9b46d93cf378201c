"""The student's file behind the page: kept warm in the checker's sandbox, reloaded.

A thread of its own looks at the file twenty times a second, opens it anew when it was
saved, and asks it for the newest configuration; what comes back is delivered on the
server's event loop. Nothing of the student's runs in this process.
"""

import contextlib
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from labkit.base.exchange import LoadError, Question, Reply
from labkit.inspector.ghost import Ghost, Seen, no_pose
from labkit.sandbox.sandbox import Session
from robo47.checks import Array
from robo47.errors import Robo47Error

POLL_SECONDS, ASK_SECONDS = 0.05, 2.0


@dataclass(frozen=True)
class Source:
    """The file, and how it is opened.

    Attributes:
        script: the student's file; it need not be there.
        open: opens it in the sandbox; raises LoadError.
        explain: says in a line why it does not load.
        describe: says in a line what a reply that is no answer means.
    """

    script: Path
    open: Callable[[Path], Session]
    explain: Callable[[Path, Reply], str]
    describe: Callable[[str, Reply], str]


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
            ghost: which function to ask for the arm's poses, and what; None where a
                day has none: then only its tabs ask.
            model: the robot.
            deliver: is given what the function said; None where there is no file.
            saved: called when the file was opened anew.
        """
        super().__init__(daemon=True, name="student")
        self.source, self.ghost, self.model = source, ghost, model
        self.deliver, self.saved = deliver, saved
        self.news = threading.Condition()
        self.q: Array | None = None
        self.ended = False
        self.version = 0  # of the file: another one after each save
        self._lock = threading.RLock()  # a session answers one thread at a time
        self._asker: Session | None = None
        self._stamp: tuple[int, ...] | None = ()  # never looked
        self._problem = ""

    def want(self, q: Array) -> None:
        """Ask for a configuration, instead of any that waits.

        Args:
            q: (nq,).
        """
        with self.news:
            self.q = q.copy()
            self.news.notify()

    @property
    def there(self) -> bool:
        """Whether there is a file."""
        return bool(self._stamp)

    @property
    def problem(self) -> str:
        """Why the file is not asked, in a sentence; "" where it is."""
        return self._problem

    def ask(self, questions: Sequence[Question]) -> list[Reply]:
        """Ask any functions, now, on the caller's thread; see `problem` afterwards.

        Args:
            questions: what to call.
        """
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
                function = questions[at].function
                self._give_up(self.source.describe(function, replies[at]))
            return replies

    def close(self) -> None:
        """End the thread and the sandbox."""
        with self.news:
            self.ended = True
            self.news.notify()

    def run(self) -> None:
        """Look, ask, deliver, until it is closed."""
        done: Array | None = None
        while not self.ended:
            with self._lock:
                if changed := self._look():
                    done = None
            with self.news:
                q = self.q
            if q is not None and q is not done:
                done = q
                self.deliver(self._seen(q))
            if changed:
                self.saved()  # the checks need both cores; first the ghost
            with self.news:
                if self.q is done and not self.ended:
                    self.news.wait(POLL_SECONDS)
        self._shut()

    def _look(self) -> bool:
        """Open the file anew where it changed; return whether it did."""
        stamp = stamp_of(self.source.script)
        if stamp == self._stamp:
            return False
        self._stamp = stamp
        self._shut()
        self._problem = self._open() if stamp else ""
        self.version += 1
        return True

    def _open(self) -> str:
        try:
            self._asker = self.source.open(self.source.script)
        except LoadError as error:
            return self.source.explain(self.source.script, error.reply)
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
            return Seen(q, problem=self._problem)
        with self._lock:
            asker = self._asker
            try:
                found = poses_of(asker, self.source, self.ghost, self.model, q)
            except Exception as error:  # ours, or the day's: the page goes on
                return Seen(q, problem=f"not asked: {type(error).__name__}: {error}")
            poses, problem = found
            if not asker.alive:
                problem = self._give_up(problem)
        return Seen(q, poses, problem)

    def _give_up(self, why: str) -> str:
        """Ask nothing more before the file is saved; return what to say meanwhile."""
        self._shut()
        self._problem = f"{why} Save the file to have it asked again."
        return self._problem


def poses_of(
    asker: Session, source: Source, ghost: Ghost, model: mujoco.MjModel, q: Array
) -> tuple[dict[str, Array], str]:
    """Return the poses that a student's function gives, and the first problem or "".

    Args:
        asker: the file, loaded.
        source: says what a reply that is no answer means.
        ghost: which function, and what to ask it.
        model: the robot.
        q: (nq,).
    """

    def asked(
        frames: Sequence[str], some: Sequence[tuple[Any, ...]]
    ) -> tuple[dict[str, Array], str]:
        questions = [Question("ghost", ghost.function, tuple(args)) for args in some]
        replies = asker.ask(questions, seconds=ASK_SECONDS)
        poses, problem = {}, ""
        for name, reply in zip(frames, replies, strict=True):
            said = source.describe(ghost.function, reply)
            if not said and not (said := no_pose(ghost.function, reply.value)):
                poses[name] = np.array(reply.value, dtype=np.float64)
            problem = problem or said
        return poses, problem

    poses, problem = asked(ghost.frames, ghost.questions(model, q))
    if not poses and ghost.whole is not None and asker.alive:
        end = ghost.frames[-1:]
        poses, why = asked(end, [ghost.whole(model, q)])
        problem = why or f"Only {end[0]} is drawn: {problem}"
    return poses, problem


def stamp_of(script: Path) -> tuple[int, ...] | None:
    """Return what changes when a file is saved; None where there is no file."""
    if not script.is_file():
        return None
    with contextlib.suppress(OSError):  # it went away just now
        return script.stat().st_mtime_ns, script.stat().st_size
    return None
