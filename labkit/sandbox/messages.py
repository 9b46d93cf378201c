"""Messages between the checker and the sandbox: request, questions, replies.

With a request travel the modules of `robo47` that a day's student code may import, as
source text: those of earlier days. Nothing else of the kit is there to find.
"""

import base64
import contextlib
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache, lru_cache
from pathlib import Path as File
from typing import Any

import mujoco
import numpy as np

from labkit.base.exchange import MOST, Path, Question, Reply
from labkit.base.text import visible, visible_lines
from labkit.judge.ask import Robot
from labkit.judge.worlds import is_world
from labkit.lesson import day_mujoco
from labkit.lesson.day import NUMBERS, Day, Limits, days_before
from labkit.lesson.slips import other_packages
from labkit.lesson.starter import function_lines
from labkit.lesson.untrusted_files import SCRIPT
from labkit.sandbox.inside import wire
from labkit.sandbox.inside.fake_model import KINDS
from robo47 import panda
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

USUAL = Limits()  # the limits of a task that names none
PANDA = Robot()  # the model for a file that may load the robot
MOST_BESIDE = 50  # files beside the script
HUGE = 1e30  # no number of a task comes near; squares and determinants stay finite
Robots = Sequence[Robot | mujoco.MjModel]
_GUARDED = re.compile(r"^if __name__ == .*\n(?:[ \t].*\n?|\n)*", re.M)
# Lines that import of the kit; to parse the whole would take a tenth of a check.
_IMPORTS = re.compile(
    r"^ *(?:from (robo47[\w.]*) import (\([^)]*\)|.*)|import (robo47[\w.]*))", re.M
)


def request(
    script: File,
    robots: Robots,
    library: Mapping[str, str] | None,
    added: str = "",
    limits: Limits = USUAL,
    **others: Any,
) -> dict[str, Any]:
    """Return what a process is told before the first question, as JSON.

    Args:
        script: the student's file.
        robots: that questions will hold.
        library: modules of the kit that it may import: source by name.
        added: code of the kit's, run as if it stood at the end of the file.
        limits: what it may take.
        others: settings for `inside/__main__.py`.

    Raises:
        Robo47Error: there is no such file, or it is no script.
    """
    others |= {"memory": limits.memory, "numbers": limits.numbers}
    told = {**_code_of(script, added), "library": dict(library or {}), **others}
    copies = [_copy_of(robot) for robot in robots]
    known = [copy["entry"] for copy in copies]
    if PANDA.entry not in known and _loads_panda(told):
        copies.append(_copy_of(PANDA))
    return {**told, "models": copies, "facts": _facts()}


def library_of(day: Day) -> dict[str, str]:
    """Return the sources of what days before this one brought, and what that imports.

    Returns:
        By module name: {"robo47.se3": "...", ...}.

    Raises:
        Robo47Error: a manifest names a module that is not there, or one that imports an
            answer of this day. (A test looks at later days.)
    """
    found = {"kit": ""}  # a lab's first import, which leads to the kit's own Python
    earlier = [name for one in days_before(day) for name in one.library]
    waiting = [f"robo47.{name}" for name in earlier]
    while waiting:
        name = waiting.pop()
        if name in found:
            continue
        if name.removeprefix("robo47.") in day.library:
            raise Robo47Error(
                f"{shown(file_of(name))} is an answer of day {day.number}, and the "
                "library of an earlier day imports it"
            )
        found[name], inner = _source_of(name)
        waiting += inner
    return found


def _loads_panda(told: dict[str, Any]) -> bool:
    """Return whether code that is sent may load the robot; a lab's `main` is not run.

    To compile it and send it takes longer than to ask a task's questions.
    """
    sent = map(base64.b64decode, [told["code"], *told["beside"].values()])
    own = [code.decode("utf-8", "replace") for code in sent if b"panda" in code]
    texts = [*map(_without_main, own), told["added"], *told["library"].values()]
    return any("panda" in it and re.search(r"\bload\b", it) for it in texts)


def _without_main(text: str) -> str:
    """Return a file without its `main`; whole, where loading it may call that."""
    start, end, _ = function_lines(text, "main")
    lines = text.splitlines(keepends=True)
    rest = "".join(lines[:start] + lines[end:]) if start >= 0 else text
    rest = _GUARDED.sub("", rest)
    return text if re.search(r"\bmain\b", rest) else rest


def robots_of(questions: Iterable[Question]) -> Robots:
    """Return every robot that occurs in questions, once."""
    args = (arg for question in questions for arg in question.args)
    robots = {id(a): a for a in args if isinstance(a, Robot | mujoco.MjModel)}
    return list(robots.values())


class StaysError(Robo47Error):
    """A question holds something that cannot travel to the sandbox."""


def pack(
    questions: Sequence[Question],
    models: Sequence[dict[str, Any]],
    worlds: list[Any],
) -> list[dict[str, Any]]:
    """Return questions as JSON; they name the process's models and worlds by place.

    Args:
        questions: what to call.
        models: those that the process was sent.
        worlds: those that it may ask about; new ones are added.
    """
    args = {id(arg): arg for question in questions for arg in question.args}
    packed: dict[int, Any] = {}
    for key, arg in args.items():
        if isinstance(arg, Robot | mujoco.MjModel):
            packed[key] = {"model": models.index(_copy_of(arg))}
        elif isinstance(arg, Path):
            packed[key] = {"path": [list(pair) for pair in arg.pairs]}
        elif is_world(arg):
            packed[key] = {"world": _place(arg, worlds)}
    plain = {key: arg for key, arg in args.items() if key not in packed}
    try:
        packed |= zip(plain, map(wire.pack_value, plain.values()), strict=True)
    except wire.UnsendableError as error:
        asked = ", ".join(sorted({one.function for one in questions}))
        raise StaysError(f"a question to {asked} holds {error}") from None
    return [
        {"function": one.function, "args": [packed[id(arg)] for arg in one.args]}
        for one in questions
    ]


def _place(world: Any, worlds: list[Any]) -> int:
    """Return a world's place among those that a process may ask about."""
    for at, known in enumerate(worlds):
        if known is world:
            return at
    worlds.append(world)
    return len(worlds) - 1


def free(asked: Any, worlds: Sequence[Any]) -> bool | None:
    """Return what a world says of the edge that a process asks about.

    None is the answer about what are no two points of that world.

    Raises:
        ValueError: only a forger asks that.
    """
    try:
        number, *ends = asked
        world = worlds[number]
        a, b = (wire.unpack_value(end) for end in ends)
    except Exception:
        raise ValueError("not a question about a world") from None
    try:
        a, b = np.array(a, dtype=np.float64), np.array(b, dtype=np.float64)
        # a malformed answer could ask a million edges
        if a.ndim != 1 or a.shape != b.shape:
            return None
        return bool(world.edge_free(a, b))
    except Exception:  # a point of another number of joints
        return None


def read(came: Sequence[dict[str, Any]], most: int = NUMBERS) -> list[Reply]:
    """Return messages as replies, up to the first forged one; none is believed."""
    values = wire.unpack_values([message.get("value") for message in came], most)
    found: list[Reply] = []
    with contextlib.suppress(Exception):  # a forged message can be anything
        for message, value in zip(came, values, strict=False):
            found.append(_reply(message, value))
    return found


@cache
def _source_of(name: str) -> tuple[str, tuple[str, ...]]:
    """Return a module's source, and which modules of the kit it imports."""
    path = file_of(name)
    try:
        source = path.read_text("utf-8")
    except OSError:
        says = f"a day's library names {shown(path)}, which is not there"
        raise Robo47Error(says) from None
    inner: list[str] = []
    for module, imported, plain in _IMPORTS.findall(source):
        names = [f"{module}.{name}" for name in re.findall(r"\w+", imported)]
        inner += [n if file_of(n).is_file() else module for n in names] + [plain]
    return source, tuple(name for name in inner if name.startswith("robo47."))


def file_of(name: str) -> File:
    """Return where a module is: "robo47.fast.ik" in robo47/fast/ik.py."""
    path = ROOT.joinpath(*name.split("."))
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


@lru_cache(8)  # a class is asked with the same few robots
def _copy_of(robot: Robot | mujoco.MjModel) -> dict[str, Any]:
    """Return a robot as it travels; only an unchanged one is what `load` returns."""
    if isinstance(robot, mujoco.MjModel):
        return copy_model(robot)
    known = isinstance(robot.entry, str) and not robot.change
    return copy_model(robot.model, str(robot.entry) if known else "")


def copy_model(model: mujoco.MjModel, entry: str = "") -> dict[str, Any]:
    """Return a model's sizes, names and arrays as JSON.

    Args:
        model: any compiled model; what it only looks like should be dropped before.
        entry: of the Panda, which `panda.load(entry)` returns in the sandbox.
    """
    values = {
        name: getattr(model, name) for name in dir(model) if not name.startswith("_")
    }
    arrays = {n: v for n, v in values.items() if isinstance(v, np.ndarray)}
    return {
        "entry": entry,
        "sizes": {n: v for n, v in values.items() if isinstance(v, int)},
        "arrays": {n: wire.pack_array(v) for n, v in arrays.items()},
        "names": {
            kind: [getattr(model, kind)(i).name for i in range(values[count])]
            for kind, (_, count, _) in KINDS.items()
        },
    }


def _code_of(script: File, added: str = "") -> dict[str, Any]:
    """Return a script, with what is added to it, and the ones beside it."""
    if not script.is_file():
        raise Robo47Error(f"{shown(script)} is not there")
    if script.stat().st_size > SCRIPT:
        raise Robo47Error(f"{shown(script)} is over {SCRIPT // 1000} kB: no script")
    found = sorted(script.parent.glob("*.py"))[:MOST_BESIDE]
    # A grade follows no link either.
    own = [p for p in found if p.is_file() and not p.is_symlink()]
    own = [path for path in own if path.stat().st_size <= SCRIPT]
    return {
        "file": script.name,
        "code": _text(script.read_bytes()),
        "absent": sorted({name for path in {script, *own} for name in _absent(path)}),
        "added": added,
        "beside": {path.stem: _text(path.read_bytes()) for path in own},
    }


def _absent(script: File) -> tuple[str, ...]:
    return other_packages(script.read_text("utf-8", "replace"))


def _text(code: bytes) -> str:
    return base64.b64encode(code).decode("ascii")


@cache
def _facts() -> dict[str, Any]:
    """Return what the fakes of `mujoco` and `robo47` need to know, as JSON."""
    return {
        "version": mujoco.__version__,
        "enums": {
            name: {k: int(v) for k, v in getattr(mujoco, name).__members__.items()}
            for name in dir(mujoco)
            if name.startswith("mjt") and hasattr(getattr(mujoco, name), "__members__")
        },
        "constants": {"READY_Q": panda.READY_Q.tolist(), "END_FRAME": panda.END_FRAME},
        "modules": sorted(
            ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(
                ".__init__"
            )
            for package in ("robo47", "labkit")
            for path in (ROOT / package).rglob("*.py")
        )
        + list(day_mujoco.modules()),
    }


def _reply(message: dict[str, Any], value: Any) -> Reply:
    """Return a message as a reply; its value is a ValueError where it is none."""
    if message.get("missing"):
        return Reply(kind="missing")
    if isinstance(value, ValueError):
        return Reply(error=f"it returned {visible(value)}", kind="unsendable")
    if (largest := _largest(value)) > HUGE:
        says = f"it returns numbers as large as {largest:.0e}"
        return Reply(error=says, kind="huge")
    told = {
        name: made(message[name]) for name, made in _READ.items() if name in message
    }
    return Reply(value=value, **told)


def _largest(value: Any) -> float:
    """Return the largest finite number of an answer."""
    if value is None or isinstance(value, str):
        return 0.0
    try:
        array = np.abs(np.asarray(value)).astype(np.float64)
    except (TypeError, ValueError):  # the items are of different types
        return max(map(_largest, value), default=0.0)
    return float(array[np.isfinite(array)].max(initial=0))


def _texts(told: Any) -> tuple[str, ...]:
    return tuple(map(visible, told[:MOST])) if isinstance(told, list) else ()


def _lines(told: Any) -> tuple[int, ...]:
    """Return what may be numbers of lines in a file."""
    numbers: Sequence[Any] = told[:MOST] if isinstance(told, list) else []
    return tuple(n for n in numbers if type(n) is int and 0 < n < 10_000_000)


# How to read each part of a reply; what the sandbox has nothing to say of is left out.
_READ: dict[str, Callable[[Any], Any]] = {
    "error": visible,
    "kind": lambda told: visible(told, 80),
    "line": lambda told: next(iter(_lines([told])), None),
    "callers": _lines,
    "changed": _texts,
    "refused": _texts,
    "printed": visible_lines,
    "shares": _texts,
}
