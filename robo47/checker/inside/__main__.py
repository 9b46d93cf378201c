"""Run the student's functions on what the checker asks, and send back plain numbers.

Started by `robo47.checker.sandbox` with an interpreter that has no site-packages; the
arguments are the folders where NumPy is. One request comes in on standard input; the
replies go out line by line on what was standard output, each behind the request's
secret. What student code prints goes elsewhere.
"""

import io
import json
import os
import sys
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

HERE = sys.path.pop(0)
LIBRARIES = [path for path in sys.path if path]
sys.path += sys.argv[1:]
KEPT_OUTPUT = 2_000  # characters of what a task printed


def main() -> None:
    """Answer one request."""
    channel = os.fdopen(os.dup(1), "wb")
    sys.path.insert(0, HERE)
    import limits

    limits.leave_network()  # before NumPy: a process with threads may not
    import guard
    import landlock
    import standins
    import wire

    sys.path.remove(HERE)
    for name in ("limits", "guard", "landlock", "standins", "wire"):
        del sys.modules[name]  # names that a student may want for a file of their own
    request = json.loads(sys.stdin.buffer.read())
    null = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(null, stream)

    def send(**reply: Any) -> None:
        line = request["secret"] + json.dumps(reply) + "\n"
        channel.write(line.encode("ascii"))
        channel.flush()

    watch = guard.Guard(request["folder"], LIBRARIES + sys.argv[1:], request["closed"])
    models = [_model_maker(standins, wire, data) for data in request["models"]]
    sys.modules.update(standins.make_modules(watch.refuse, models[0], request["facts"]))
    used = standins.note_use(request["noted"])
    limits.tighten()
    shared = os.path.join(sys.base_prefix, "lib")  # what compiled modules link to
    landlock.fence(request["folder"], [*LIBRARIES, *sys.argv[1:], shared])
    watch.arm()
    _answer(request, send, watch.refused, used, wire, models)
    os._exit(0)  # no atexit of the student's, no thread to wait for


def _model_maker(standins: Any, wire: Any, data: Any) -> Callable[[], Any]:
    arrays = {name: wire.unpack_array(a) for name, a in data["arrays"].items()}
    return lambda: standins.MjModel(data, arrays)


def _answer(
    request: Any,
    send: Callable[..., None],
    refused: list[str],
    used: list[str],
    wire: Any,
    models: Any,
) -> None:
    """Load the student's file, then make the calls one by one."""
    path = Path(request["file"])
    sys.path.insert(0, request["folder"])
    os.chdir(request["folder"])
    module = types.ModuleType(path.stem)
    module.__file__ = str(path)
    sys.modules[path.stem] = module
    send(at="load")
    try:
        exec(compile(path.read_bytes(), str(path), "exec"), vars(module))
    except BaseException as error:
        send(loaded=False, refused=refused[:3], **_describe(error, path))
        return
    send(loaded=True)
    for index, call in enumerate(request["calls"]):
        send(at=index)
        refused.clear()
        used.clear()
        sys.stdout = sys.stderr = printed = _Kept()
        try:
            function = getattr(module, call["function"], None)
            if not callable(function):
                send(at=index, missing=True)
                continue
            args = [_argument(packed, wire, models) for packed in call["args"]]
            named = {"path": list(map(tuple, call["path"]))} if call["path"] else {}
            reply = {"value": wire.pack_value(function(*args, **named))}
            reply["changed"] = _changed(function, call["args"], args, wire)
        except wire.UnsendableError as error:
            reply = {"error": f"it returned {error}", "kind": "unsendable"}
        except BaseException as error:
            reply = _describe(error, path)
        notes = {"refused": refused[:3], "used": used[:3]}
        send(at=index, printed=printed.getvalue(), **notes, **reply)


def _argument(packed: Any, wire: Any, models: Any) -> Any:
    if "model" in packed:
        return models[packed["model"]]()
    return packed["number"] if "number" in packed else wire.unpack_value(packed)


def _changed(function: Any, packed: Any, args: list[Any], wire: Any) -> list[str]:
    """Return the names of the arrays that a call left other than it got them."""
    code = getattr(function, "__code__", None)
    names = code.co_varnames[: code.co_argcount] if code else ()
    found = []
    for index, (before, arg) in enumerate(zip(packed, args, strict=True)):
        if "array" not in before:
            continue
        try:
            same = wire.pack_value(arg) == before
        except wire.UnsendableError:
            same = False
        if not same:
            found.append(names[index] if index < len(names) else f"{index + 1}")
    return found


def _describe(error: BaseException, path: Path) -> dict[str, Any]:
    """Return an exception as text and the lines of the student's file that led to it.

    "line" is where it happened, "callers" the calls before it, the nearest first.
    """
    lines, trace = [], error.__traceback__
    while trace:
        if trace.tb_frame.f_code.co_filename == str(path):
            lines.append(trace.tb_lineno)
        trace = trace.tb_next
    text = str(error)
    line, callers = (lines[-1] if lines else None), lines[-2::-1]
    if isinstance(error, SyntaxError):
        line, callers, text = error.lineno, [], error.msg or text
    kind = type(error).__name__
    return {"error": text[:500], "kind": kind, "line": line, "callers": callers[:3]}


class _Kept(io.StringIO):
    """What a task prints, up to a point."""

    def write(self, text: str) -> int:
        if self.tell() < KEPT_OUTPUT:
            super().write(text[:KEPT_OUTPUT])
        return len(text)


if __name__ == "__main__":
    main()
