"""Run a student's functions in a process of their own and bring back plain arrays.

The process works on a temporary copy, in a clean environment, without the repository
on its import path, within limits of time and memory; `inside/` says what else it may
not do. Replies come on a private channel, each behind a secret made for that run. A
function that hangs or ends the interpreter costs its own task only: the rest is asked
again in a fresh process.
"""

import contextlib
import importlib.util
import json
import os
import queue
import secrets
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robo47.checker import resources
from robo47.checker.inside import wire
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

START_SECONDS, LOAD_SECONDS, CALL_SECONDS = 60.0, 10.0, 3.0
RESIDENT_BYTES = 1024**3
LARGEST_SCRIPT = 1_000_000  # bytes
POLL_SECONDS = 0.05


@dataclass(frozen=True)
class Question:
    """One call to make.

    Attributes:
        task: whose it is; a task that hangs is not asked again.
        function: a name in the student's file.
        args: float64 arrays, floats, or a `Model`.
    """

    task: str
    function: str
    args: tuple[Any, ...]


@dataclass(frozen=True)
class Model:
    """Stands for a model in a question's arguments: its place in `run`'s list."""

    index: int


@dataclass(frozen=True)
class Reply:
    """What came of one call.

    Attributes:
        value: an array, a tuple of arrays, or None.
        error: "" or what went wrong, in words.
        kind: "" where the function returned; the exception's name where it raised one;
            "missing", "unsendable", "stopped" (time, memory, ended, channel).
        line: of the student's file, or None.
        refused: what the guard refused during the call.
        printed: what the function printed.
    """

    value: Any = None
    error: str = ""
    kind: str = ""
    line: int | None = None
    refused: tuple[str, ...] = ()
    printed: str = ""


class LoadError(Exception):
    """The student's file does not load; `reply` says why."""

    def __init__(self, reply: Reply) -> None:
        """Keep the reply."""
        super().__init__(reply.error)
        self.reply = reply


class Sandbox:
    """Processes for one student's file after the other; the next is always warm."""

    def __init__(self) -> None:
        """Start the first process, so that it loads while the caller prepares."""
        self._warm: _Process | None = _Process()

    def __enter__(self) -> "Sandbox":
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """End what is left."""
        if self._warm:
            self._warm.end()

    def run(
        self,
        script: Path,
        questions: Sequence[Question],
        models: Sequence[dict[str, Any]],
        facts: dict[str, Any],
    ) -> list[Reply]:
        """Ask a student's file.

        Args:
            script: the file; the other `.py` files beside it may be imported by it.
            questions: what to call.
            models: as `model_copy.copy_model` makes them, by `Model.index`.
            facts: `model_copy.facts()`.

        Returns:
            One reply per question.

        Raises:
            LoadError: the file does not load.
            Robo47Error: there is no such file, or it is no script.
        """
        replies: dict[int, Reply] = {}
        base = {"models": list(models), "facts": facts, "closed": _closed_folders()}
        while left := [i for i in range(len(questions)) if i not in replies]:
            process, self._warm = self._warm or _Process(), None
            with contextlib.closing(process):
                copy = process.copy(script)
                calls = [_pack(questions[i]) for i in left]
                request = {**base, "file": str(copy), "calls": calls}
                got, stopped = process.converse(request)
            replies.update({left[i]: reply for i, reply in got.items()})
            if stopped:
                culprit = questions[left[min(len(got), len(left) - 1)]].task
                for i in left:
                    if i not in replies and questions[i].task == culprit:
                        replies[i] = stopped
        return [replies[i] for i in range(len(questions))]


class _Process:
    """One interpreter with its folder, from start to end."""

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="robo47-check-")).resolve()
        inside = Path(__file__).parent / "inside"
        command = [sys.executable, "-I", "-S", "-B", "-X", "utf8", str(inside)]
        self.process = subprocess.Popen(
            [*command, *_library_folders()],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=self.folder,
            env=_clean_environment(self.folder),
            **resources.start_options(),  # type: ignore[call-overload]
        )
        self.lines: queue.Queue[bytes | None] = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        stream = self.process.stdout
        assert stream is not None
        with contextlib.suppress(ValueError, OSError):  # closed while reading
            for line in iter(lambda: stream.readline(10_000_000), b""):
                self.lines.put(line)
        self.lines.put(None)

    def copy(self, script: Path) -> Path:
        """Copy a script and its neighbours into the folder; return the copy."""
        if not script.is_file():
            raise Robo47Error(f"{shown(script)} is not there")
        for path in {script, *sorted(script.parent.glob("*.py"))[:50]}:
            if not path.is_file():
                continue
            if path.stat().st_size <= LARGEST_SCRIPT:
                shutil.copyfile(path, self.folder / path.name)
            elif path == script:
                raise Robo47Error(f"{shown(script)} is over 1 MB: that is no script")
        return self.folder / script.name

    def converse(
        self, request: dict[str, Any]
    ) -> tuple[dict[int, Reply], Reply | None]:
        """Send a request; return the replies in order, and what stopped them early.

        Raises:
            LoadError: the file does not load.
        """
        secret = secrets.token_hex(16)
        whole = {**request, "secret": secret, "folder": str(self.folder)}
        with contextlib.suppress(OSError):  # it died already; the loop below says so
            assert self.process.stdin is not None
            self.process.stdin.write(json.dumps(whole).encode("ascii"))
            self.process.stdin.close()
        replies: dict[int, Reply] = {}
        limit, loaded = START_SECONDS, False
        while len(replies) < len(request["calls"]):
            message = self._next(limit, secret.encode("ascii"))
            if isinstance(message, Reply):
                if not loaded:
                    raise LoadError(message)
                return replies, message
            if message.get("loaded") is False:
                raise LoadError(_reply(message))
            loaded = loaded or message.get("loaded") is True
            limit = CALL_SECONDS if loaded else LOAD_SECONDS
            if message.get("at") == len(replies) and len(message) > 1:  # an answer
                replies[len(replies)] = _reply(message)
        return replies, None

    def _next(self, limit: float, secret: bytes) -> dict[str, Any] | Reply:
        """Return the next message, or a reply that says why there is none."""
        deadline = time.monotonic() + limit
        while True:
            try:
                line = self.lines.get(timeout=POLL_SECONDS)
            except queue.Empty:
                if resources.resident_bytes(self.process) > RESIDENT_BYTES:
                    return _stopped("it used more than 1 GB of memory")
                if time.monotonic() > deadline:
                    return _stopped(
                        f"it was still running after {limit:.0f} s: an endless loop?"
                    )
                continue
            if line is None:
                return _stopped(
                    "it ended Python instead of returning "
                    f"(exit code {self.process.wait()})"
                )
            if not line.startswith(secret):
                return _stopped("it wrote into the checker's own channel")
            try:
                message = json.loads(line[len(secret) :])
                return message if isinstance(message, dict) else _stopped("damaged")
            except ValueError:
                return _stopped("it wrote into the checker's own channel")

    def end(self) -> None:
        """End the process and remove its folder."""
        resources.end(self.process)
        for stream in (self.process.stdin, self.process.stdout):
            with contextlib.suppress(OSError, AttributeError):
                stream.close()  # type: ignore[union-attr]
        shutil.rmtree(self.folder, ignore_errors=True)

    close = end


def _reply(message: dict[str, Any]) -> Reply:
    """Return a message as a reply, believing nothing in it."""
    line = message.get("line")
    if message.get("missing"):
        return Reply(kind="missing")
    try:
        value = wire.unpack_value(message.get("value"))
    except ValueError as error:
        return Reply(error=f"it returned {error}", kind="unsendable")
    refused = message.get("refused")
    return Reply(
        value=value,
        error=str(message.get("error", "")),
        kind=str(message.get("kind", "")),
        line=line if isinstance(line, int) else None,
        refused=tuple(map(str, refused)) if isinstance(refused, list) else (),
        printed=str(message.get("printed", "")),
    )


def _stopped(why: str) -> Reply:
    return Reply(error=why, kind="stopped")


def _pack(question: Question) -> dict[str, Any]:
    args: list[dict[str, Any]] = []
    for arg in question.args:
        if isinstance(arg, Model):
            args.append({"model": arg.index})
        elif isinstance(arg, (int, float)):
            args.append({"number": arg})
        else:
            args.append(wire.pack_value(arg))
    return {"function": question.function, "args": args}


def _library_folders() -> list[str]:
    """Return where NumPy is: all that the sandbox gets of this environment."""
    spec = importlib.util.find_spec("numpy")
    if spec is None or spec.origin is None:
        raise Robo47Error("NumPy is not installed: run `make day1` once")
    return [str(Path(spec.origin).parent.parent)]


def _closed_folders() -> list[str]:
    """Return what a task must not read, even where libraries are read from there."""
    closed = [ROOT / "robo47", ROOT / ".git", *ROOT.glob("w*-*")]
    for folder in map(Path, _library_folders()):
        closed += folder.glob("mujoco*")
        closed += folder.glob("robo47*")
    return [str(path) for path in closed]


def _clean_environment(folder: Path) -> dict[str, str]:
    threads = ("OPENBLAS", "OMP", "MKL", "VECLIB")
    kept = ("SYSTEMROOT", "SYSTEMDRIVE", "LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")
    return {
        **{name: os.environ[name] for name in kept if name in os.environ},
        **{f"{name}_NUM_THREADS": "1" for name in threads},
        **{name: str(folder) for name in ("HOME", "USERPROFILE", "TMPDIR", "TEMP")},
        "LANG": "C.UTF-8",
    }
