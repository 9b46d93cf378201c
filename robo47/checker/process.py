"""One interpreter for student code, from its start to its end."""

import base64
import contextlib
import json
import os
import queue
import secrets
import subprocess
import threading
import time
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from robo47.checker import replies, resources
from robo47.checker.replies import LoadError, Reply
from robo47.checker.wall import command, wall
from robo47.errors import Robo47Error
from robo47.paths import shown

START_SECONDS, LOAD_SECONDS = 60.0, 10.0
RESIDENT_BYTES = 1024**3
LARGEST_SCRIPT, MOST_NEIGHBOURS = 1_000_000, 50  # bytes, files
LONGEST_LINE, MOST_WAITING = 10_000_000, 1_000  # bytes of a reply, replies unread
POLL_SECONDS = 0.05
CHANNEL = "it wrote into the checker's own channel"

# A child dies with the thread that started it, so one thread starts them all.
_starter = ThreadPoolExecutor(1, thread_name_prefix="robo47-start")


class EndedError(Exception):
    """The process came to an end, or had to; `reply` says why."""

    def __init__(self, why: str) -> None:
        """Keep the reply that says so."""
        super().__init__(why)
        self.reply = replies.stopped(why)


class Process:
    """One interpreter; it has no folder of its own, everything comes by a pipe."""

    def __init__(self) -> None:
        """Start it; it gets ready while the caller prepares a request."""
        self.wall = wall()
        self.process = _starter.submit(_start, command(self.wall)).result()
        self.secret = b""
        self.answers = 0
        self._closed = threading.Event()
        self._in: queue.Queue[bytes | None] = queue.Queue(MOST_WAITING)
        self._out: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._threads = [
            threading.Thread(target=run, daemon=True)
            for run in (self._read, self._write)
        ]
        for thread in self._threads:
            thread.start()

    def load(self, script: Path, request: dict[str, Any]) -> None:
        """Load a student's file.

        Args:
            script: the file; the other `.py` files beside it can be imported by it.
            request: what else the process is told; see `inside/__main__.py`.

        Raises:
            LoadError: the file does not load.
            Robo47Error: there is no such file, or the process does not start.
        """
        self.secret = secrets.token_hex(16).encode("ascii")
        whole = {**request, **_code(script), "secret": self.secret.decode("ascii")}
        self._send(whole)
        try:
            ready = self._message(START_SECONDS)
        except EndedError as error:
            raise Robo47Error(
                f"the checker's process does not start: {error}"
            ) from None
        if self.wall.name == "landlock" and ready.get("fenced") is not True:
            raise Robo47Error("Linux's Landlock did not close; nothing was run")
        try:
            message = self._message(LOAD_SECONDS)
            if message.get("loaded") is not True:
                raise LoadError(self._reply(message))
        except EndedError as error:
            raise LoadError(error.reply) from None

    def ask(self, calls: Iterable[dict[str, Any]]) -> None:
        """Send questions; `next` returns their replies one by one."""
        for call in calls:
            self._send(call)

    def next(self, seconds: float) -> Reply:
        """Return the next reply.

        Raises:
            EndedError: none came within so many seconds, or ever will.
        """
        message = self._message(seconds)
        if message.get("at") != self.answers:
            raise EndedError(CHANNEL)
        self.answers += 1
        return self._reply(message)

    def close(self) -> None:
        """End the process."""
        resources.end(self.process)
        self._closed.set()
        self._out.put(None)
        for thread, stream in zip(
            self._threads, (self.process.stdout, self.process.stdin), strict=True
        ):
            thread.join(resources.END_SECONDS)
            if stream and not thread.is_alive():  # else something holds the other end
                with contextlib.suppress(OSError):
                    stream.close()

    def _reply(self, message: dict[str, Any]) -> Reply:
        try:
            return replies.read(message)
        except Exception:  # a forged message can be anything
            raise EndedError(CHANNEL) from None

    def _message(self, seconds: float) -> dict[str, Any]:
        """Return the next message."""
        deadline = time.monotonic() + seconds
        while True:
            try:
                line = self._in.get(timeout=POLL_SECONDS)
                break
            except queue.Empty:
                if resources.resident_bytes(self.process) > RESIDENT_BYTES:
                    raise EndedError("it used more than 1 GB of memory") from None
                if time.monotonic() > deadline:
                    says = "it runs on and on, as a loop without an end does"
                    raise EndedError(says) from None
        if line is None:
            raise EndedError(self._how_it_ended())
        try:
            message = json.loads(line.removeprefix(self.secret))
            if line.startswith(self.secret) and isinstance(message, dict):
                return message
        except Exception:  # a forged message can be anything
            pass
        raise EndedError(CHANNEL)

    def _how_it_ended(self) -> str:
        try:
            return f"it ended Python (exit code {self.process.wait(timeout=1)})"
        except subprocess.TimeoutExpired:
            return "it closed the checker's own channel"

    def _send(self, message: dict[str, Any]) -> None:
        self._out.put(json.dumps(message).encode("ascii") + b"\n")

    def _write(self) -> None:
        """Write what is to be sent; the process may take its time to read it."""
        stream = self.process.stdin
        assert stream is not None
        with contextlib.suppress(OSError):  # it died; `_message` says so
            for line in iter(self._out.get, None):
                stream.write(line)
                if self._out.empty():
                    stream.flush()

    def _read(self) -> None:
        stream = self.process.stdout
        assert stream is not None
        with contextlib.suppress(OSError):
            for line in iter(lambda: stream.readline(LONGEST_LINE), b""):
                self._deliver(line)
        self._deliver(None)

    def _deliver(self, line: bytes | None) -> None:
        """Queue a line as soon as there is room; whoever floods us waits."""
        while not self._closed.is_set():
            with contextlib.suppress(queue.Full):
                return self._in.put(line, timeout=POLL_SECONDS)


def _start(command: list[str]) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        cwd=Path(__file__).parent / "inside",
        env=_clean_environment(),
        **resources.start_options(),  # type: ignore[call-overload]
    )


def _code(script: Path) -> dict[str, Any]:
    """Return a script and the ones beside it, for the request."""
    if not script.is_file():
        raise Robo47Error(f"{shown(script)} is not there")
    if script.stat().st_size > LARGEST_SCRIPT:
        raise Robo47Error(f"{shown(script)} is over 1 MB: that is no script")
    beside = {
        path.stem: _text(path)
        for path in sorted(script.parent.glob("*.py"))[:MOST_NEIGHBOURS]
        if path.is_file() and path.stat().st_size <= LARGEST_SCRIPT
    }
    return {"file": script.name, "code": _text(script), "beside": beside}


def _text(path: Path) -> str:
    return base64.b64encode(path.read_bytes()).decode("ascii")


def _clean_environment() -> dict[str, str]:
    threads = ("OPENBLAS", "OMP", "MKL", "VECLIB")
    kept = ("SYSTEMROOT", "SYSTEMDRIVE", "LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")
    return {
        **{name: os.environ[name] for name in kept if name in os.environ},
        **{f"{name}_NUM_THREADS": "1" for name in threads},
        "LANG": "C.UTF-8",
    }
