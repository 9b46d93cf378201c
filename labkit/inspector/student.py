"""The student's file behind the page: kept warm in the checker's sandbox, reloaded.

Its methods wait for the sandbox: call them on a thread. Nothing of the student's runs
in this process.
"""

import re
from collections.abc import Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from threading import RLock
from typing import Any

import numpy as np

from labkit.base.exchange import LoadError, Question, Reply
from labkit.inspector.arm import Arm
from labkit.inspector.ghost import Ghost, Seen, compare, no_pose, nothing
from labkit.judge.replies_read import no_answer, not_loaded, stops_with
from labkit.lesson.day import Day
from labkit.sandbox.messages import library_of
from labkit.sandbox.sandbox import Sandbox, Session
from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.paths import shown

AGAIN = " Save the file to have it asked again."


@dataclass
class Student:
    """The student's file of a day, for many questions; opened anew after a save."""

    day: Day  # the day of the functions
    arm: Arm  # the robot of the questions
    ghost: Ghost | None  # draws the arm's poses; None if only tabs ask
    sandbox: Sandbox  # runs the file
    script: Path  # the file, there or not; `look` opens it
    seconds: float = 1.5  # limit of a call; a slower one is asked again after a save
    version: int = 0  # a new number after each save of the file
    problem: str = ""  # why the file is not asked, in a sentence
    # A session answers one thread at a time.
    _lock: AbstractContextManager[Any] = field(default_factory=RLock)
    _asker: Session | None = None
    _stamp: tuple[int, ...] | None = ()  # never looked

    @property
    def there(self) -> bool:
        """Whether there is a file."""
        return bool(self._stamp)

    def saved(self) -> bool:
        """Return whether the file was saved since the last look; this never waits."""
        return self._now() != self._stamp

    def _now(self) -> tuple[int, ...] | None:
        """Return what another save would change; None where there is no file."""
        try:
            status = self.script.stat()
        except OSError:
            return None
        return status.st_mtime_ns, status.st_size

    def look(self) -> None:
        """Open the file anew where it was saved since the last look."""
        if (asker := self._asker) and self.saved():
            asker.halt()  # an old file that hangs keeps nobody waiting
        with self._lock:
            stamp = self._now()
            if stamp == self._stamp:
                return
            self.version += 1  # first: while it is opened, nothing told is true of it
            self._stamp = stamp
            self._shut()
            self.problem = self._open() if stamp else ""

    def _open(self) -> str:
        """Open the file with the model of the questions; return why it does not."""
        robots = [self.arm.model]
        library = library_of(self.day)
        try:
            self._asker = self.sandbox.session(
                self.script, robots, library, limits=self.day.limits
            )
        except LoadError as error:
            return not_loaded(self.script, error.reply)
        except (Robo47Error, OSError) as error:
            return str(error)
        return ""

    def _shut(self) -> None:
        if self._asker is not None:
            self._asker.close()
            self._asker = None

    def ask(self, questions: Sequence[Question], version: int = 0) -> list[Reply]:
        """Ask any functions, of that version of the file alone where one is named.

        See `problem` afterwards.
        """
        late = version and self.saved()  # the next look shall not wait for all of it
        with self._lock:
            if late or self._asker is None or version not in (0, self.version):
                ended = Reply(kind="stopped", error="it is not asked")
                return [ended] * len(questions)
            try:
                replies = self._asker.ask(questions, seconds=self.seconds)
            except Exception as error:  # ours, or the day's: the page goes on
                says = f"{type(error).__name__}: {error}"
                return [Reply(kind="unsendable", error=says)] * len(questions)
            if not self._asker.alive:
                kinds = [reply.kind for reply in replies]
                at = kinds.index("stopped") if "stopped" in kinds else -1
                why = describe(self.day, questions[at].function, replies[at])
                self._shut()
                self.problem = why + AGAIN
            return replies

    def see(self, q: Array) -> Seen:
        """Return what the ghost's function gives at q, (nq,), beside MuJoCo's."""
        if not self.there:
            says = f"No {shown(self.script)} yet: make start DAY={self.day.number}. "
            return Seen(says + "Shown is the kit's library.", "quiet")
        ghost = self.ghost
        if ghost is None or self._asker is None:
            return nothing(self.problem)
        try:
            poses, why = self._poses(ghost.frames, ghost.questions(self.arm.model, q))
            if not poses and ghost.whole is not None:
                end = ghost.frames[-1:]
                alone = ghost.whole(self.arm.model, q)
                several = f"Only {end[0]} is drawn: {why}"
                poses, why = self._poses(end, [alone])
                why = why or several
        except Exception as error:  # the day's: the page goes on
            return nothing(f"not asked: {type(error).__name__}: {error}")
        return compare(ghost, poses, self.problem or why, self.arm.poses_at(q))

    def _poses(
        self, frames: Sequence[str], some: Sequence[tuple[Any, ...]]
    ) -> tuple[dict[str, Array], str]:
        """Return the poses that the ghost's function gives, and "" or why not all."""
        assert self.ghost is not None
        name = self.ghost.function
        poses = {}
        problem = ""
        replies = self.ask([Question("ghost", name, tuple(args)) for args in some])
        for frame, reply in zip(frames, replies, strict=True):
            said = describe(self.day, name, reply) or no_pose(name, reply.value)
            if not said:
                poses[frame] = np.array(reply.value, dtype=np.float64)
            problem = problem or said
        return poses, problem


def describe(day: Day, function: str, reply: Reply) -> str:
    """Return in the checker's words what a reply that is no answer means, else ""."""
    if not reply.kind:
        return ""
    tasks = (task.id for task in day.tasks if function in task.functions)
    verdict = no_answer(reply, function, next(tasks, ""))
    says = verdict.message if verdict else stops_with(reply)
    named = re.search(rf"\b{re.escape(function)}\b", says)
    return says if named else f"{function}: {says}"
