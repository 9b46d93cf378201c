"""A question to a student's function, and the reply that came of it."""

from dataclasses import dataclass
from typing import Any

MOST = 10  # entries of any list in a reply
CHANNEL = "it wrote into the checker's own channel"


@dataclass(frozen=True)
class Question:
    """One call to make."""

    task: str  # the task's id; a task that hangs is not asked again
    function: str  # a name in the student's file
    # Whatever travels (`labkit.sandbox.inside.wire`), a `Robot` or compiled MjModel, a
    # `Path`, a world (`labkit.judge.worlds`), which stays here and is asked.
    args: tuple[Any, ...]


@dataclass(frozen=True)
class Path:
    """A path in a question's arguments: pairs of a body and its joint or None.

    The function gets it as a list of tuples.
    """

    pairs: tuple[tuple[str, str | None], ...]


@dataclass(frozen=True)
class Reply:
    """The reply to a question, which is asked twice, the second time much later.

    All text in it is harmless: see `labkit.base.text.visible`.
    """

    value: Any = None  # the returned value, encoded by `labkit.sandbox.inside.wire`
    error: str = ""  # "" or what went wrong, in words
    # "" where the function returned; the exception's name where it raised one;
    # "missing", "unsendable", "stopped" (time, memory, ended, channel), or "waits" (not
    # asked: it needs a task that was stopped).
    kind: str = ""
    line: int | None = None  # the line in the student's file, or None
    callers: tuple[int, ...] = ()  # the lines of it that led there, the nearest first
    # Names of the arguments that are no longer what they were.
    changed: tuple[str, ...] = ()
    refused: tuple[str, ...] = ()  # the imports and calls that the guard refused
    printed: str = ""  # the output of the first call
    again: Any = None  # the value of the second time; None where it was not asked twice
    again_error: str = ""  # "" or what went wrong the second time alone
    # The answer shares its memory with these: "another answer", or an argument's name.
    shares: tuple[str, ...] = ()
    # The time that a stopped call was given, the number of calls of its task that came
    # back before it, and the time of the longest of these; seconds.
    given: float = 0.0
    came: int = 0
    longest: float = 0.0


@dataclass(eq=False)
class Exchange:
    """A question with its reply, which the sandbox fills in."""

    question: Question
    reply: Reply | None = None


class LoadError(Exception):
    """The student's file does not load; `reply` says why."""

    def __init__(self, reply: Reply) -> None:
        """Keep the reply."""
        super().__init__(reply.error)
        self.reply = reply


class EndedError(Exception):
    """The sandbox's process came to an end, or had to; `reply` says why."""

    def __init__(self, why: str) -> None:
        """Keep the reply that says so."""
        super().__init__(why)
        self.reply = stopped(why)


def stopped(why: str) -> Reply:
    """Return the reply of a call that never came back."""
    return Reply(error=why, kind="stopped")
