"""One interpreter for student code, from its start to its end."""

import contextlib
import json
import os
import queue
import secrets
import subprocess
import threading
import time
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from labkit.base import processes
from labkit.base.exchange import CHANNEL, EndedError, LoadError, stopped
from labkit.sandbox.wall import command, wall
from robo47.errors import FaultError

START_SECONDS, LOAD_SECONDS = 60.0, 10.0
GB = 1024**3
MODEST = 0.5  # who holds more of its share is why the machine's memory ran out
LONGEST_LINE, MOST_WAITING = 2_000_000, 16  # bytes of a reply, replies unread
MOST_PARTS = 20_000  # commas and brackets of a reply: all its texts may be of them
PER_NUMBER = 11  # bytes: eight, as text
MOST_BYTES = 50_000_000  # of all replies to what is asked at once
POLL_SECONDS = 0.05
ENDLESS = "it runs on and on, as a loop without an end does"

# A child dies with the thread that started it, so one thread starts them all.
_starter = ThreadPoolExecutor(1, thread_name_prefix="robo47-start")


class Process:
    """One interpreter; it has no folder of its own, everything comes by a pipe."""

    def __init__(self, extras: Sequence[str] = ()) -> None:
        """Start it; it gets ready while the caller prepares a request.

        Args:
            extras: packages that student code may import, pinned.

        Raises:
            FaultError: this machine starts no process now.
        """
        self.extras, self.secret = tuple(extras), b""
        self.told: dict[str, Any] = {}  # the request of what it has loaded
        self.answers = 0
        self._room = MOST_BYTES
        self.memory, self.longest = 1.0, LONGEST_LINE  # GB, bytes
        self.killed = False  # ended by a signal of somebody's
        self._oom_kills = processes.oom_kills()
        self._most = 0  # bytes of memory it was seen with
        self.waited = 0.0  # seconds for a processor, by which its time was extended
        self._waits = 0.0  # of all its life, when last looked
        self._closed = threading.Event()
        self._in: queue.Queue[bytes | None] = queue.Queue(MOST_WAITING)
        self._out: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._threads = [
            threading.Thread(target=run, daemon=True)
            for run in (self._read, self._write)
        ]
        self.wall = wall()
        try:
            self.process = _starter.submit(_start, command(self.wall, extras)).result()
            for thread in self._threads:
                thread.start()
        except (OSError, RuntimeError, MemoryError) as error:  # RuntimeError: no thread
            self._drop()
            raise _fault(f"starts no process for the checker ({error})") from None

    def load(self, request: dict[str, Any]) -> None:
        """Load a student's file, with what else `inside/__main__.py` is told.

        Raises:
            LoadError: the file does not load.
            FaultError: the process does not start, or this machine ended it.
        """
        self.secret = secrets.token_hex(16).encode("ascii")
        self.memory = request["memory"]
        self.longest = max(LONGEST_LINE, PER_NUMBER * request["numbers"])
        self._send({**request, "secret": self.secret.decode("ascii")})
        try:
            ready = self._message(START_SECONDS)
        except EndedError as error:
            raise _fault(f"starts no process for the checker ({error})") from None
        if self.wall.name == "landlock" and ready.get("fenced") is not True:
            raise _fault("did not close Linux's Landlock")
        try:
            message = self._message(LOAD_SECONDS)
            if message.get("loaded") is not True:
                from labkit.sandbox import messages  # NumPy, after the start

                raise LoadError(*messages.read([message]) or [stopped(CHANNEL)])
            self.told = request
        except EndedError as error:
            raise LoadError(error.reply) from None

    def ask(self, calls: Iterable[dict[str, Any]]) -> None:
        """Send questions; `next` returns what came of each."""
        self._room = max(MOST_BYTES, MOST_WAITING * self.longest)
        for call in calls:
            self._send(call)

    def next(self, seconds: float) -> dict[str, Any]:
        """Return the next reply as it came, for `messages.read`.

        Raises:
            EndedError: none came within so many seconds, or ever will.
            FaultError: this machine ended the process.
        """
        message = self._message(seconds)
        if message.get("at") != self.answers:
            raise EndedError(CHANNEL)
        self.answers += 1
        return message

    def close(self) -> None:
        """End the process."""
        processes.end(self.process)
        self._closed.set()
        self._out.put(None)
        for thread in self._threads:  # where something holds a pipe's other end, later
            thread.join(processes.END_SECONDS)

    def _drop(self) -> None:
        """End what began only in part."""
        if not hasattr(self, "process"):
            return
        processes.end(self.process)
        for stream in (self.process.stdin, self.process.stdout):
            if stream:
                stream.close()

    def _message(self, seconds: float) -> dict[str, Any]:
        """Return the next message."""
        looked = time.monotonic()
        deadline = looked + seconds
        while True:
            try:
                line = self._in.get(timeout=POLL_SECONDS)
                break
            except queue.Empty:
                self._most = max(self._most, processes.resident_bytes(self.process))
                if self._most > self.memory * GB:
                    says = f"it used more than {self.memory:g} GB of memory"
                    raise EndedError(says) from None
                now = time.monotonic()
                deadline += self._others(now - looked)
                if now > deadline and self._in.empty():  # it can be us who were late
                    raise EndedError(ENDLESS) from None
                looked = now
        if line is None:
            raise EndedError(self._how_it_ended())
        self._room -= len(line)
        if self._room < 0:
            raise EndedError("its answers are far too large, all together")
        try:
            parts = sum(map(line.count, (b",", b"[", b"{")))  # 20 times as much memory
            message = parts <= MOST_PARTS and json.loads(line.removeprefix(self.secret))
            if line.startswith(self.secret) and isinstance(message, dict):
                return message
        except Exception:  # a forged message can be anything
            pass
        raise EndedError(CHANNEL)

    def _others(self, most: float) -> float:
        """Return for how much of the last seconds others had the processor."""
        before, self._waits = self._waits, processes.scheduled(self.process)[1]
        waited = min(self._waits - before, most)  # what is long past is over
        self.waited += waited
        return waited

    def _how_it_ended(self) -> str:
        try:
            code = self.process.wait(timeout=processes.END_SECONDS)
        except subprocess.TimeoutExpired:
            return "it closed the checker's own channel"
        self.killed = processes.was_killed(self.process)
        if self.killed and processes.oom_kills() > self._oom_kills:
            if self._most < MODEST * self.memory * GB:
                raise _fault("ran out of memory and ended the checker's process")
            return "it used more memory than this machine has"
        return f"it ended Python (exit code {code})"

    def _send(self, message: dict[str, Any]) -> None:
        self._out.put(json.dumps(message).encode("ascii") + b"\n")

    def _write(self) -> None:
        """Write what is to be sent; the process may take its time to read it."""
        stream = self.process.stdin
        assert stream is not None
        with contextlib.suppress(OSError), stream:  # it died; `_message` says so
            for line in iter(self._out.get, None):
                stream.write(line)
                if self._out.empty():
                    stream.flush()

    def _read(self) -> None:
        stream = self.process.stdout
        assert stream is not None
        with stream:
            with contextlib.suppress(OSError):
                for line in iter(lambda: stream.readline(self.longest), b""):
                    self._deliver(line)
            self._deliver(None)

    def _deliver(self, line: bytes | None) -> None:
        """Queue a line as soon as there is room; whoever floods us waits."""
        while not self._closed.is_set():
            with contextlib.suppress(queue.Full):
                return self._in.put(line, timeout=POLL_SECONDS)


def _fault(what: str) -> FaultError:
    says = f"this machine {what}. Nothing was judged: close other programs, try again"
    return FaultError(says)


def _start(command: list[str]) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        cwd=Path(__file__).parent / "inside",
        env=_clean_environment(),
        **processes.start_options(),  # type: ignore[call-overload]
    )


def _clean_environment() -> dict[str, str]:
    threads = ("OPENBLAS", "OMP", "MKL", "VECLIB")
    kept = ("SYSTEMROOT", "SYSTEMDRIVE", "LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH")
    return {
        **{name: os.environ[name] for name in kept if name in os.environ},
        **{f"{name}_NUM_THREADS": "1" for name in threads},
        "LANG": "C.UTF-8",
    }
