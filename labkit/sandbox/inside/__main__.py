"""Run the student's functions on what the checker asks, and send back plain numbers.

Started by `labkit.sandbox.process` with an interpreter that has no site-packages. The
arguments are the wall's name, the folder where NumPy is, and what else of it student
code may import. Standard input brings one line with the request, then one line per
question; one line per answer goes out on what was standard output, each behind the
request's secret. What student code prints goes elsewhere.
"""

import base64
import json
import os
import sys
import types
from collections.abc import Callable
from typing import Any, BinaryIO

Send = Callable[..., None]
HERE = sys.path.pop(0)
PYTHON = [path for path in sys.path if path]  # the standard library


def main() -> None:
    """Answer until standard input ends."""
    wall, libraries, *extras = sys.argv[1:]
    fences = wall != "none"
    asked, channel = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    sys.path[:] = [HERE, *PYTHON, libraries]
    import limits

    if fences:
        limits.die_with_parent()
        # A process with threads may not, and NumPy starts some.
        limits.stop_being_root()
    import entropy

    entropy.settle()  # NumPy takes its own seeds from here
    import answers
    import audit
    import fake_world
    import imports
    import landlock
    import seccomp

    sys.path[:] = PYTHON  # NumPy finds its own parts without
    readable = _readable(libraries, extras)
    request = json.loads(asked.readline())
    _silence()
    robots = [answers.Copies(data) for data in request["models"]]
    watch = audit.Guard(readable)
    imports.Finder(request, robots, watch.refuse, libraries, extras).install()
    _free_names()
    limits.tighten(request["cpu_seconds"], request["memory"])
    # the libraries that compiled modules link to
    shared = os.path.join(sys.base_prefix, "lib")
    # Both, whatever comes of the first: behind bubblewrap one of them may be missing.
    fenced = fences and all([landlock.fence([*readable, shared]), seccomp.close()])
    watch.arm()
    send = _sender(channel, request["secret"])
    send(ready=True, fenced=fenced)
    try:
        module = _load(request)
    except BaseException as error:
        why = answers.describe(error, request["file"])
        send(loaded=False, refused=watch.refused[:3], **why)
        os._exit(0)
    send(loaded=True)
    questions = fake_world.Questions(asked, json.loads)
    answering = answers.Answers(module, robots, request, send, questions)
    for at, call in enumerate(questions):
        watch.refused.clear()
        reply = _answer(call, request, answering, module)
        send(at=at, refused=watch.refused[:3], **reply)
    os._exit(0)  # no atexit of the student's, no thread to wait for


def _answer(call: Any, request: Any, answering: Any, module: types.ModuleType) -> Any:
    """Return the reply to a question, of the file loaded anew where that is asked."""
    if told := call.get("anew"):
        request["added"] = told["added"]
        answering.begin(told)
        answering.module = _anew(request, module)
    return answering.ask(call)


def _sender(channel: BinaryIO, secret: str) -> Send:
    """Return what writes a message, a line of its own, behind the secret."""

    def send(**reply: Any) -> None:
        told = {name: value for name, value in reply.items() if value not in ("", [])}
        channel.write(f"{secret}{json.dumps(told)}\n".encode("ascii"))
        channel.flush()

    return send


def _readable(libraries: str, extras: list[str]) -> list[str]:
    """Return the folders of Python, NumPy and what else may be imported."""
    numpy = os.path.dirname(os.path.abspath(sys.modules["numpy"].__file__ or ""))
    folders = [os.path.join(libraries, extra) for extra in extras]
    return [*PYTHON, numpy, f"{numpy}.libs", *folders]


def _free_names() -> None:
    """Forget our modules' names: a student may want them for their own."""
    for name in os.listdir(HERE):
        if not name.startswith("__"):
            sys.modules.pop(name.removesuffix(".py"), None)


def _anew(request: Any, module: types.ModuleType) -> types.ModuleType:
    """Return the student's file loaded once more: what it kept so far is gone."""
    for name in request["beside"]:
        sys.modules.pop(name, None)
    try:
        return _load(request)
    except BaseException:
        return module


def _silence() -> None:
    """Lead standard input and output nowhere."""
    null = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(null, stream)


def _load(request: Any) -> types.ModuleType:
    """Return the student's file as a module, or raise what keeps it from loading."""
    file, added = request["file"], request["added"]
    module = types.ModuleType(file.removesuffix(".py"))
    module.__file__ = file
    sys.modules[module.__name__] = module
    if request.get("compiled", (None,))[0] != added:
        own = base64.b64decode(request["code"]) + added.encode()
        request["compiled"] = added, compile(own, file, "exec")
    exec(request["compiled"][1], vars(module))
    return module


if __name__ == "__main__":
    main()
