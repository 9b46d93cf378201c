"""What is asked of the sandbox, and what comes back."""

from dataclasses import dataclass
from typing import Any

from robo47.checker.inside import wire


@dataclass(frozen=True)
class Question:
    """One call to make.

    Attributes:
        task: whose it is; a task that hangs is not asked again.
        function: a name in the student's file.
        args: float64 arrays, floats, a `Model` or a `Path`.
    """

    task: str
    function: str
    args: tuple[Any, ...]


@dataclass(frozen=True)
class Model:
    """Stands for a model in a question's arguments: its place in `run`'s list."""

    index: int


@dataclass(frozen=True)
class Path:
    """An argument that is a path: pairs of body and joint (None where none turns it)."""

    pairs: tuple[tuple[str, str | None], ...]


@dataclass(frozen=True)
class Reply:
    """What came of one call.

    Attributes:
        value: an array, a tuple of arrays, or None.
        error: "" or what went wrong, in words.
        kind: "" where the function returned; the exception's name where it raised one;
            "missing", "unsendable", "stopped" (time, memory, ended, channel).
        line: of the student's file, or None.
        callers: the lines of it that led there, the nearest first.
        changed: names of the arguments that are no longer what they were.
        refused: what the guard refused during the call.
        printed: what the function printed.
        again: the value when the question was asked a second time, apart.
        again_error: "" or what went wrong then.
        shares: what the answer shares its memory with: "another answer", or the name
            of an argument.
    """

    value: Any = None
    error: str = ""
    kind: str = ""
    line: int | None = None
    callers: tuple[int, ...] = ()
    changed: tuple[str, ...] = ()
    refused: tuple[str, ...] = ()
    printed: str = ""
    again: Any = None
    again_error: str = ""
    shares: tuple[str, ...] = ()


class LoadError(Exception):
    """The student's file does not load; `reply` says why."""

    def __init__(self, reply: Reply) -> None:
        """Keep the reply."""
        super().__init__(reply.error)
        self.reply = reply


def read(message: dict[str, Any]) -> Reply:
    """Return a message as a reply, believing nothing in it."""
    line = message.get("line")
    if message.get("missing"):
        return Reply(kind="missing")
    try:
        value = wire.unpack_value(message.get("value"))
    except ValueError as error:
        return Reply(error=f"it returned {error}", kind="unsendable")

    def texts(name: str) -> tuple[str, ...]:
        found = message.get(name)
        return tuple(map(str, found)) if isinstance(found, list) else ()

    callers = message.get("callers")
    callers = callers if isinstance(callers, list) else []
    return Reply(
        value=value,
        error=str(message.get("error", "")),
        kind=str(message.get("kind", "")),
        line=line if isinstance(line, int) else None,
        callers=tuple(n for n in callers if isinstance(n, int)),
        changed=texts("changed"),
        refused=texts("refused"),
        used=texts("used"),
        printed=str(message.get("printed", "")),
    )


def stopped(why: str) -> Reply:
    """Return the reply of a call that never came back."""
    return Reply(error=why, kind="stopped")


def pack(question: Question) -> dict[str, Any]:
    """Return a question as JSON."""
    args: list[dict[str, Any]] = []
    for arg in question.args:
        if isinstance(arg, Model):
            args.append({"model": arg.index})
        elif isinstance(arg, (int, float)):
            args.append({"number": arg})
        else:
            args.append(wire.pack_value(arg))
    return {"function": question.function, "args": args, "path": question.path}
