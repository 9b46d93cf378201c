"""Messages between the checker and the sandbox: questions out, replies back."""

from collections.abc import Callable, Sequence
from typing import Any

from labkit.base.text import visible, visible_lines
from labkit.judge.exchange import MOST, Model, Path, Question, Reply
from labkit.sandbox.inside import wire


def pack(question: Question) -> dict[str, Any]:
    """Return a question as JSON."""
    return {
        "function": question.function,
        "args": [_pack_argument(arg) for arg in question.args],
    }


def _pack_argument(arg: Any) -> dict[str, Any]:
    if isinstance(arg, Model):
        return {"model": arg.index}
    if isinstance(arg, Path):
        return {"path": [list(pair) for pair in arg.pairs]}
    if isinstance(arg, (int, float)):
        return {"number": arg}
    packed = wire.pack_value(arg)
    assert isinstance(packed, dict), arg
    return packed


def read(message: dict[str, Any]) -> Reply:
    """Return a message as a reply, believing nothing in it.

    Raises:
        Exception: any, where somebody forged the message.
    """
    if message.get("missing"):
        return Reply(kind="missing")
    try:
        value = wire.unpack_value(message.get("value"))
    except ValueError as error:
        return Reply(error=f"it returned {visible(error)}", kind="unsendable")
    told = {
        name: read(message[name]) for name, read in _READ.items() if name in message
    }
    return Reply(value=value, **told)


def _kind(told: Any) -> str:
    return visible(told, 80)


def _texts(told: Any) -> tuple[str, ...]:
    return tuple(map(visible, told[:MOST])) if isinstance(told, list) else ()


def _lines(told: Any) -> tuple[int, ...]:
    """Return what may be numbers of lines in a file."""
    numbers: Sequence[Any] = told[:MOST] if isinstance(told, list) else []
    return tuple(n for n in numbers if type(n) is int and 0 < n < 10_000_000)


def _line(told: Any) -> int | None:
    return next(iter(_lines([told])), None)


# How to read each part of a reply; what the sandbox has nothing to say of is left out.
_READ: dict[str, Callable[[Any], Any]] = {
    "error": visible,
    "kind": _kind,
    "line": _line,
    "callers": _lines,
    "changed": _texts,
    "refused": _texts,
    "printed": visible_lines,
    "shares": _texts,
}
