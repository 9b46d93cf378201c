"""Run the student's functions on what the checker asks, and send back plain numbers.

Started by `labkit.sandbox.process` with an interpreter that has no site-packages. The
arguments are the wall's name, the folder where NumPy is, and what else of it student
code may import. Standard input brings one
line with the request, then one line per question; one line per answer goes out on what
was standard output, each behind the request's secret. What student code prints goes
elsewhere.
"""

import base64
import json
import os
import sys
import types
from collections.abc import Callable
from typing import Any

HERE = sys.path.pop(0)
PYTHON = [path for path in sys.path if path]  # the standard library


def main() -> None:
    """Answer until standard input ends."""
    wall, libraries, *extras = sys.argv[1:]
    asked, channel = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    sys.path[:] = [HERE, *PYTHON, libraries]
    import limits

    fences = wall != "none"
    if fences:
        limits.die_with_parent()
        limits.leave_network()  # before NumPy: a process with threads may not
    import answers
    import audit
    import fake_model
    import imports
    import landlock
    import seccomp
    import wire

    sys.path[:] = PYTHON  # NumPy finds its own parts without
    request = json.loads(asked.readline())
    _silence()

    def send(**reply: Any) -> None:
        told = {name: value for name, value in reply.items() if value not in ("", [])}
        line = request["secret"] + json.dumps(told) + "\n"
        channel.write(line.encode("ascii"))
        channel.flush()

    numpy = os.path.dirname(os.path.abspath(sys.modules["numpy"].__file__ or ""))
    folders = [os.path.join(libraries, extra) for extra in extras]
    readable = [*PYTHON, numpy, f"{numpy}.libs", *folders]
    watch = audit.Guard(readable)
    makers = [_maker(fake_model, wire, data) for data in request["models"]]
    entries = [data["entry"] for data in request["models"]]
    named = dict(zip(entries, makers, strict=True))
    imports.Finder(request, named, watch.refuse, libraries, extras).install()
    for name in os.listdir(HERE):  # a student may want these names for their own
        if not name.startswith("__"):
            sys.modules.pop(name.removesuffix(".py"), None)
    limits.tighten(request["cpu_seconds"], request["memory"])
    shared = os.path.join(sys.base_prefix, "lib")  # what compiled modules link to
    fenced = fences and landlock.fence([*readable, shared])
    closed = fences and seccomp.close()
    watch.arm()
    send(ready=True, fenced=fenced and closed)
    try:
        module = _load(request)
    except BaseException as error:
        why = answers.describe(error, request["file"])
        send(loaded=False, refused=watch.refused[:3], **why)
    else:
        send(loaded=True)
        answering = answers.Answers(module, makers, request["keep"], request["numbers"])
        for at, line in enumerate(asked):
            watch.refused.clear()
            call = json.loads(line)
            if told := call.get("again"):  # by another check, with more robots
                for data in told["models"]:
                    makers.append(_maker(fake_model, wire, data))
                    named[data["entry"]] = makers[-1]
                request["added"] = told["added"]
                answering.begin(told["keep"])
            if told or "anew" in call:
                answering.module = _anew(request, module)
            reply = answering.ask(call)
            send(at=at, refused=watch.refused[:3], **reply)
    os._exit(0)  # no atexit of the student's, no thread to wait for


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


def _maker(fake_model: Any, wire: Any, data: Any) -> Callable[[], Any]:
    arrays = {name: wire.unpack_array(a) for name, a in data["arrays"].items()}
    return lambda: fake_model.MjModel(data, arrays)


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
