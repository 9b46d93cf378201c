"""One interpreter for student code: the wall around it, its start, its end.

What stands between student code and this machine is the kernel's. Three kinds of walls,
the first that works here:

    bubblewrap   a tool of every Linux distribution: its own processes, no network, and
                 of the file system Python and NumPy alone, read-only
    landlock     Linux's own rules and its filter of system calls, where bubblewrap
                 is not to be had
    none         other systems: the code runs with the rights of whoever checks it

ROBO47_WALL=bubblewrap, landlock or none asks for one by name, for tests. The commands
that run other people's code say which wall stands, and so cannot be fooled by it.
"""

import contextlib
import functools
import importlib.metadata
import importlib.util
import json
import os
import queue
import secrets
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from labkit.base import processes
from labkit.base.exchange import CHANNEL, EndedError, LoadError, stopped
from labkit.sandbox.environment import clean_environment
from labkit.sandbox.inside import landlock, seccomp
from robo47.errors import FaultError, Robo47Error
from robo47.paths import shown

START_SECONDS, LOAD_SECONDS = 60.0, 10.0
GB = 1024**3
MODEST = 0.5  # a process that holds more of its share is why the memory ran out
LONGEST_LINE, MOST_WAITING = 2_000_000, 16  # bytes of a reply, replies unread
MOST_PARTS = 20_000  # commas and brackets of a reply: all its texts may be of them
PER_NUMBER = 11  # bytes: eight, as text
MOST_BYTES = 50_000_000  # the size of all replies to one batch of questions
POLL_SECONDS = 0.05
ENDLESS = "it does not end, as in an endless loop"
INSIDE = Path(__file__).parent / "inside"
FLAGS = ["-I", "-S", "-B", "-X", "utf8"]
PROBE_SECONDS = 20.0
# Bubblewrap shows the interpreter, its standard library, the system's libraries,
# NumPy and `inside/`, all read-only; one process, no network, no folder to write to.
NAMESPACES = "--unshare-all --die-with-parent --new-session --as-pid-1 --cap-drop ALL"
DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom")
SYSTEM = ("/lib", "/lib32", "/lib64", "/usr/lib", "/usr/lib32", "/usr/lib64")
OTHERS = ("python*/site-packages", "python*/dist-packages")  # packages of this machine
_SAYS = {
    "bubblewrap": "student code runs behind bubblewrap: Python and NumPy, read-only, "
    "and nothing else of this machine",
    "landlock": "student code runs behind Linux's Landlock: opens no file of yours (it "
    "can tell names and sizes), no network, no other process. Stronger: install "
    "bubblewrap",
    "none": "nothing keeps student code from this machine: it runs with your rights",
}

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
        self.extras = tuple(extras)
        self.secret = b""
        self.told: dict[str, Any] = {}  # the request of what it has loaded
        self.answers = 0
        self.worlds: list[Any] = []  # the worlds that its functions ask about
        self._room = MOST_BYTES
        self.memory = 1.0  # GB
        self.longest = LONGEST_LINE  # bytes
        self.killed = False  # ended by a signal of somebody's
        self._oom_kills = processes.oom_kills()
        self._most = 0  # bytes of memory it was seen with
        self.waited = 0.0  # seconds for a processor, by which its time was extended
        self._waits = 0.0  # the waiting time of its whole life at the last look
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
        until = time.monotonic() + seconds - self.waited
        message = self._message(seconds)
        while "asks" in message:
            until += self._say_if_free(message["asks"])
            if (left := until + self.waited - time.monotonic()) <= 0.0:
                raise EndedError(ENDLESS)
            message = self._message(left)
        if message.get("at") != self.answers:
            raise EndedError(CHANNEL)
        self.answers += 1
        return message

    def _say_if_free(self, asked: Any) -> float:
        """Answer a question about a world, which stays here; return the seconds."""
        from labkit.sandbox import messages  # NumPy, after the start

        began = time.monotonic()
        try:
            self._send({"free": messages.free(asked, self.worlds)})
        except ValueError:
            raise EndedError(CHANNEL) from None
        return time.monotonic() - began

    def used(self) -> tuple[float, float]:
        """Return for how many seconds it had a processor, and waited for one."""
        return processes.scheduled(self.process)

    def close(self) -> None:
        """End the process."""
        processes.end(self.process)
        self._closed.set()
        self._out.put(None)
        # they end later if something holds a pipe's other end
        for thread in self._threads:
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
        before = self._waits
        self._waits = self.used()[1]
        # do not count a wait that ended long ago
        waited = min(self._waits - before, most)
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
        cwd=INSIDE,
        env=clean_environment(),
        **processes.start_options(),  # type: ignore[call-overload]
    )


@dataclass(frozen=True)
class Wall:
    """The wall around student code."""

    name: str  # "bubblewrap", "landlock" or "none"
    says: str  # a sentence for people, without a full stop


@functools.cache
def wall() -> Wall:
    """Return the strongest wall of this machine.

    Raises:
        Robo47Error: ROBO47_WALL asks for one that it does not have.
    """
    tests = {"bubblewrap": _bubblewrap_works, "landlock": _landlock_works}
    wanted = os.environ.get("ROBO47_WALL", "")
    if wanted not in ("", *_SAYS):
        raise Robo47Error(f"ROBO47_WALL is {wanted!r}; known are {', '.join(_SAYS)}")
    for name in (wanted,) if wanted else _SAYS:
        if name == "none" or tests[name]():
            asked = " (ROBO47_WALL asks for it)" if wanted else ""
            return Wall(name, _SAYS[name] + asked)
    raise FaultError(f"ROBO47_WALL asks for {wanted}, which does not work here")


def command(chosen: Wall, extras: Sequence[str] = ()) -> list[str]:
    """Return the command that starts the sandbox's interpreter behind a wall.

    Args:
        chosen: the wall.
        extras: packages that student code may import besides NumPy: "scipy==1.17.1".

    Raises:
        Robo47Error: NumPy is not installed, or an extra is not, in that version.
    """
    packages = [name for extra in extras for name in _folders_of(extra)]
    spec = importlib.util.find_spec("numpy")
    if spec is None or spec.origin is None:
        raise Robo47Error("NumPy is not installed: run `make day1` once")
    libraries = Path(spec.origin).parent.parent
    if chosen.name == "bubblewrap":
        return _behind_bubblewrap(libraries, chosen.name, packages)
    return [sys.executable, *FLAGS, str(INSIDE), chosen.name, str(libraries), *packages]


def _folders_of(extra: str) -> list[str]:
    """Return the folders that a pinned package brings, beside NumPy's."""
    name, _, version = extra.partition("==")
    try:
        found = importlib.metadata.distribution(name)
    except importlib.metadata.PackageNotFoundError:
        found = None
    if found is None or found.version != version:
        here = f"here is {found.version}" if found else "it is not installed"
        raise Robo47Error(
            f"this week's code may import {extra}, and {here}. To install it: "
            f"{shown(Path(sys.executable))} -m pip install {extra}"
        )
    tops = {file.parts[0] for file in found.files or () if len(file.parts) > 1}
    return sorted(top for top in tops if not top.endswith((".dist-info", "..")))


def _landlock_works() -> bool:
    return landlock.version() > 0 and seccomp.known()


def _bubblewrap_works() -> bool:
    """Return whether bubblewrap starts a Python here, with what it is to see."""
    if not sys.platform.startswith("linux") or shutil.which("bwrap") is None:
        return False
    try:
        probe = [*_bubblewrap(), "-I", "-S", "-c", ""]
        tried = processes.run(probe, timeout=PROBE_SECONDS)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return tried.returncode == 0


def _behind_bubblewrap(libraries: Path, name: str, packages: list[str]) -> list[str]:
    """Return the command that runs the sandbox's program behind bubblewrap."""
    binds = _read_only(INSIDE, "/checker")
    for package in ("numpy", "numpy.libs", *packages):
        if (libraries / package).is_dir():
            binds += _read_only(libraries / package, f"/libraries/{package}")
    return [*_bubblewrap(binds), *FLAGS, "/checker", name, "/libraries", *packages]


def _bubblewrap(binds: list[str] | None = None) -> list[str]:
    """Return the command up to Python's own arguments; see bwrap(1)."""
    python = Path(os.path.realpath(getattr(sys, "_base_executable", sys.executable)))
    options = [str(shutil.which("bwrap")), *NAMESPACES.split()]
    for device in DEVICES:
        options += ["--dev-bind", device, device]
    for folder in _library_folders(python):
        if folder.is_symlink():
            options += ["--symlink", os.readlink(folder), str(folder)]
        elif folder.is_dir():
            options += _read_only(folder)
            for hidden in OTHERS:
                for packages in folder.glob(hidden):
                    options += ["--tmpfs", str(packages), "--remount-ro", str(packages)]
    options += ["--ro-bind-try", "/etc/ld.so.cache", "/etc/ld.so.cache"]
    options += _read_only(python) + (binds or [])
    return [*options, "--remount-ro", "/", "--chdir", "/", "--", str(python)]


def _library_folders(python: Path) -> list[Path]:
    """Return where the system's libraries are and Python's own, without repetition."""
    own = {python.parent.parent, Path(os.path.realpath(sys.base_prefix))}
    folders = [*map(Path, SYSTEM)]
    folders += [place / name for place in sorted(own) for name in ("lib", "lib64")]
    return list(dict.fromkeys(folders))


def _read_only(path: Path, at: str = "") -> list[str]:
    return ["--ro-bind", str(path), at or str(path)]
