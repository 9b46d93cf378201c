"""One question in, one answer out: call a function of the student's, say what came.

An answer says besides which arguments it changed, and what it shares its memory with:
an array that is handed out twice, or that is an argument, changes under its owner.
"""

import io
import sys
from collections import defaultdict
from collections.abc import Callable
from functools import partial
from types import ModuleType
from typing import Any

import numpy as np
import wire
from fake_model import MjModel
from fake_world import Questions, stand_in

KEPT_OUTPUT, MOST_OUTPUT = 2_000, 2_000_000  # characters of what a call printed
KEPT_TEXT = 2_000  # characters of an exception's text
FLOOD = "it prints more than 2 MB in a call"
EFFORT = 10_000  # effort of the exact test whether two arrays overlap
# types of arguments that a function can change, as packed
_MAY_CHANGE = {"array", "tuple", "list", "rows"}
# As they are before student code.
_exactly: Any = np.shares_memory
_roughly: Any = np.may_share_memory


class Copies:
    """A model that came with a request; each call makes a fresh copy."""

    def __init__(self, data: dict[str, Any]) -> None:
        """Take the model as `labkit.sandbox.messages` packed it."""
        self.entry = data["entry"]
        self._data = data
        packed = data["arrays"]
        self._arrays = {name: wire.unpack_array(packed[name]) for name in packed}

    def __call__(self) -> MjModel:  # noqa: D102
        return MjModel(self._data, self._arrays)


class Answers:
    """The student's module and the answers that it gave so far."""

    def __init__(
        self,
        module: ModuleType,
        robots: list[Copies],
        request: dict[str, Any],
        send: Callable[..., None],
        questions: Questions,
    ) -> None:
        """Begin.

        Args:
            module: loaded from the student's file.
            robots: those that questions name by place.
            request: "keep": hold on to every answer, to tell which share their memory;
                "numbers": how many one answer may have.
            send: writes a message to the checker.
            questions: the lines that come from it.
        """
        self._world = partial(stand_in, send=send, questions=questions)
        self.module = module
        self.robots = robots
        self.most = request["numbers"]
        self.begin({**request, "models": ()})

    def begin(self, told: dict[str, Any]) -> None:
        """Forget the answers so far; take "keep", and the "models" that are new."""
        self.robots += map(Copies, told["models"])
        self.keep = told["keep"]
        self.kept = list[Any]()
        # the arrays, by owner
        self.arrays: defaultdict[int, list[np.ndarray]] = defaultdict(list)
        self.flooding: dict[str, dict[str, Any]] = {}  # functions that are not called

    def ask(self, call: dict[str, Any]) -> dict[str, Any]:
        """Return what came of one call, as JSON."""
        name = call["function"]
        sys.stdout = sys.stderr = printed = _Kept()  # type: ignore[assignment]
        try:
            reply = self.flooding.get(name) or self._call(call)
        except wire.UnsendableError as error:
            reply = {"error": f"it returned {error}", "kind": "unsendable"}
        except BaseException as error:
            reply = describe(error, str(self.module.__file__))
        if printed.left < 0:  # making the text of a large object takes its time
            self.flooding[name] = reply = {"error": FLOOD, "kind": "RuntimeError"}
        return {**reply, "printed": printed.getvalue()}

    def _call(self, call: dict[str, Any]) -> dict[str, Any]:
        function = getattr(self.module, call["function"], None)
        if not callable(function):
            return {"missing": True}
        args = [self._argument(packed) for packed in call["args"]]
        value = function(*args)
        if _complex(value) and not any(map(_complex, args)):
            raise wire.UnsendableError("an array of dtype complex128; expected float64")
        reply = {"value": wire.pack_value(value, self.most)}
        names = _names(function, len(args))
        trio = zip(call["args"], args, names, strict=True)
        reply["changed"] = [name for was, arg, name in trio if _differs(arg, was)]
        reply["shares"] = self._shares(value, args, names)
        return reply

    def _argument(self, packed: Any) -> Any:
        if packed and "model" in packed:
            return self.robots[packed["model"]]()
        if packed and "path" in packed:
            return [tuple(pair) for pair in packed["path"]]
        if packed and "world" in packed:
            return self._world(packed["world"])
        return wire.unpack_value(packed)

    def _shares(self, value: Any, args: list[Any], names: list[str]) -> list[str]:
        """Return what an answer shares its memory with."""
        own = _arrays_of(value)
        found = [
            name
            for name, arg in zip(names, args, strict=True)
            if _overlap(own, _arrays_of(arg))
        ]
        if self.keep:
            same = isinstance(value, list) and any(value is old for old in self.kept)
            if same or any(_overlap([one], self.arrays[_owner(one)]) for one in own):
                found.append("another answer")
            self.kept.append(value)
            for one in own:
                self.arrays[_owner(one)].append(one)
        return found


def describe(error: BaseException, file: str) -> dict[str, Any]:
    """Return an exception as text and the lines of the student's file that led to it.

    "line" is where it happened, "callers" the other lines
    of the calls before it, the nearest first.
    """
    lines = []
    trace = error.__traceback__
    while trace:
        if trace.tb_frame.f_code.co_filename == file:
            lines.append(trace.tb_lineno)
        trace = trace.tb_next
    line = lines[-1] if lines else None
    # A comprehension or a generator is a frame of its own, often on the same line.
    callers = [number for number in dict.fromkeys(reversed(lines)) if number != line]
    try:
        text = str(error)
    except BaseException:  # its __str__ is student code too
        text = ""
    if isinstance(error, SyntaxError):
        text = error.msg or text
        if error.filename == file:
            line = error.lineno
            callers = []
        else:
            text = f"{text} ({error.filename}, line {error.lineno})"
    kind = type(error).__name__[:80]
    callers = callers[:3]
    return {"error": text[:KEPT_TEXT], "kind": kind, "line": line, "callers": callers}


def _names(function: Any, count: int) -> list[str]:
    """Return the names of a function's arguments, or their numbers."""
    code = getattr(function, "__code__", None)
    known = code.co_varnames[: code.co_argcount] if code else ()
    return [known[i] if i < len(known) else f"{i + 1}" for i in range(count)]


def _differs(arg: Any, packed: dict[str, Any] | None) -> bool:
    """Return whether an argument is no longer what was packed."""
    if packed and "path" in packed:
        return arg != [tuple(pair) for pair in packed["path"]]
    if not packed or not packed.keys() & _MAY_CHANGE:
        return False
    try:
        return bool(wire.pack_value(arg) != packed)
    except wire.UnsendableError:
        return True


def _arrays_of(value: Any) -> list[np.ndarray]:
    """Return the arrays that a value is made of."""
    if isinstance(value, np.ndarray):
        return [value]
    if isinstance(value, (tuple, list)):
        inner = [item for item in value if isinstance(item, (tuple, list))]
        items = (item for some in (value, *inner) for item in some)
        return [item for item in items if isinstance(item, np.ndarray)]
    parts = getattr(value, "__dict__", {}).values()  # a model's
    return [item for item in parts if isinstance(item, np.ndarray)]


def _complex(value: Any) -> bool:
    """Return whether a value is, or has, an array of complex numbers."""
    numbers = isinstance(value, np.generic | complex)
    some = [np.asarray(value)] if numbers else _arrays_of(value)
    return any(one.dtype.kind == "c" for one in some)


def _owner(memory: Any) -> int:
    """Return the identity of what an array's numbers belong to."""
    while getattr(memory, "base", None) is not None:
        memory = memory.base
    return id(memory)


def _overlap(some: list[np.ndarray], others: list[np.ndarray]) -> bool:
    for a in some:
        for b in others:
            if _roughly(a, b):
                try:
                    if _exactly(a, b, max_work=EFFORT):
                        return True
                except Exception:  # too hard to tell: then they are entangled
                    return True
    return False


class _Kept(io.StringIO):
    """The output of a task, up to a limit."""

    left = MOST_OUTPUT

    def write(self, text: str) -> int:
        self.left -= len(text)
        if self.left < 0:
            raise RuntimeError(FLOOD)
        if self.tell() < KEPT_OUTPUT:
            super().write(text[:KEPT_OUTPUT])
        return len(text)
