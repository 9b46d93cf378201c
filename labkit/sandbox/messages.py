"""Messages between the checker and the sandbox: questions out, replies back."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import mujoco

from labkit.base.text import visible, visible_lines
from labkit.judge.ask import Robot
from labkit.judge.exchange import MOST, Path, Question, Reply
from labkit.sandbox.inside import wire

Robots = Sequence[Robot | mujoco.MjModel]


def robots_of(questions: Iterable[Question]) -> Robots:
    """Return every robot that occurs in questions, once."""
    args = (arg for question in questions for arg in question.args)
    robots = {id(a): a for a in args if isinstance(a, Robot | mujoco.MjModel)}
    return list(robots.values())


def pack(questions: Sequence[Question], robots: Robots) -> list[dict[str, Any]]:
    """Return questions as JSON.

    Args:
        questions: what to call.
        robots: those that the process was given; a question names its own by place.
    """
    args = {id(arg): arg for question in questions for arg in question.args}
    packed: dict[int, Any] = {id(one): {"model": at} for at, one in enumerate(robots)}
    for key, arg in args.items():
        if isinstance(arg, Path):
            packed[key] = {"path": [list(pair) for pair in arg.pairs]}
        elif isinstance(arg, int | float):
            packed[key] = {"number": arg}
    plain = {key: arg for key, arg in args.items() if key not in packed}
    packed |= zip(plain, map(wire.pack_value, plain.values()), strict=True)
    return [
        {"function": one.function, "args": [packed[id(arg)] for arg in one.args]}
        for one in questions
    ]


def read(messages: Sequence[dict[str, Any]]) -> list[Reply]:
    """Return messages as replies, believing nothing in them, up to a forged one."""
    values = list(map(wire.read_value, [told.get("value") for told in messages]))
    found = []
    for told, value in zip(messages, values, strict=True):
        try:
            found.append(_reply(told, value))
        except Exception:  # a forged message can be anything
            break
    return found


def _reply(message: dict[str, Any], value: Any) -> Reply:
    if message.get("missing"):
        return Reply(kind="missing")
    if isinstance(value, ValueError):
        return Reply(error=f"it returned {visible(value)}", kind="unsendable")
    if isinstance(value, Exception):
        raise value
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
