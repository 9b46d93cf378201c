"""Child processes: start, messages and end; memory and time, on each platform.

The standard library alone: a student installs no process tool for this.
"""

from __future__ import annotations  # the doctor runs on old Pythons too

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

if sys.platform == "win32":
    import ctypes

    class _Counters(ctypes.Structure):
        """PROCESS_MEMORY_COUNTERS of psapi.h."""

        _fields_ = [
            ("cb", ctypes.c_ulong),
            ("PageFaultCount", ctypes.c_ulong),
            ("sizes", ctypes.c_size_t * 8),  # the seventh is PagefileUsage
        ]

    def _windows_commit(handle: int) -> int:
        """Return the bytes that a Windows process has committed."""
        counters = _Counters(cb=ctypes.sizeof(_Counters))
        ctypes.windll.kernel32.K32GetProcessMemoryInfo(
            ctypes.c_void_p(handle), ctypes.byref(counters), counters.cb
        )
        return int(counters.sizes[6])

else:
    import resource

IN_VENV = "Scripts/python.exe" if os.name == "nt" else "bin/python"  # a venv's Python
END_SECONDS = 5.0  # the time that a killed process has to end
# How a process ends that somebody else ended: SIGKILL or SIGTERM, of it or, behind
# bubblewrap, as that tells it.
_KILLED = (-9, -15, 128 + 9, 128 + 15)


class Child:
    """A module of ours as a process of its own, which reads until its input ends."""

    def __init__(self, module: str, *arguments: str, **options: Any) -> None:
        """Start `python -m module`, with options of `subprocess.Popen`."""
        self.late = False  # ended for taking too long
        self.ran = 0.0  # seconds that it had a processor, when it was ended for that
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 (closed by close)
        pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        command = [sys.executable, "-m", module, *arguments]
        options = {**pipes, "stderr": self._errors, **start_options(), **options}
        self.process: Any = subprocess.Popen(command, **options)

    def send(self, message: bytes) -> None:
        """Send a message; where the child is gone, `process.stdout` has ended."""
        with contextlib.suppress(OSError):
            self.process.stdin.write(message)
            self.process.stdin.flush()

    @contextlib.contextmanager
    def within(self, seconds: float) -> Iterator[None]:
        """End the child when the block takes longer, so that nobody waits for it."""

        def stop() -> None:
            self.late = True
            self.ran, _ = scheduled(self.process)
            end(self.process)

        timer = threading.Timer(seconds, stop)
        timer.start()
        try:
            yield
        finally:
            timer.cancel()

    @property
    def alive(self) -> bool:
        """The process can take another message."""
        return self.process.poll() is None

    def last_words(self) -> str:
        """Return the last line of an ended child's errors, or its exit code."""
        self.process.wait(END_SECONDS)
        self._errors.seek(0)
        lines = self._errors.read().decode(errors="replace").strip().split("\n")
        return lines[-1] or f"exit code {self.process.returncode}"

    def close(self) -> None:
        """End it: it stops where its input does, or is stopped."""
        for pipe in (self.process.stdin, self.process.stdout):
            with contextlib.suppress(OSError):  # it may have ended already
                pipe.close()
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(END_SECONDS)
        end(self.process)
        self._errors.close()


def start_options() -> dict[str, object]:
    """Return what makes a child the head of a group that can be ended as one."""
    if sys.platform == "win32":
        flags = subprocess.CREATE_NEW_PROCESS_GROUP | subprocess.CREATE_NO_WINDOW
        return {"creationflags": flags}
    return {"start_new_session": True}


def run(command: Sequence[str], **more: Any) -> subprocess.CompletedProcess[str]:
    """Run a program that reads no input; return what it printed, bad bytes as "?"."""
    return subprocess.run(
        command,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        encoding="utf-8",
        errors="replace",
        check=False,
        **more,
    )


def run_and_tell(
    command: Sequence[str], tell: Callable[[str], None], **more: Any
) -> tuple[int, str]:
    """Run a program that reads no input, and tell each line as it is printed.

    Args:
        command: the program and its arguments.
        tell: gets a line without its end; standard error is among them.
        more: of `subprocess.Popen`.

    Returns:
        Its exit code, and all that it printed.
    """
    lines = []
    with subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        errors="replace",
        **more,
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            lines.append(line)
            tell(line.rstrip())
    return process.returncode, "".join(lines)


def end(process: subprocess.Popen[bytes]) -> None:
    """End a child and whatever it started, and wait for it."""
    if sys.platform == "win32":
        if process.poll() is None:
            run(["taskkill", "/F", "/T", "/PID", str(process.pid)])
    else:
        # Also when the child is gone already: its own children may not be.
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    with contextlib.suppress(OSError):
        process.kill()
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(END_SECONDS)


def limit_files(process: subprocess.Popen[bytes], largest: int) -> None:
    """Have Linux end a child, or what it starts, at a file of more bytes."""
    if sys.platform.startswith("linux"):
        with contextlib.suppress(OSError, ValueError):  # gone, or bounded already
            limits = (largest, largest)
            resource.prlimit(process.pid, resource.RLIMIT_FSIZE, limits)


def sweep(prefix: str, seconds: float) -> None:
    """Remove a killed run's temporary folders, of a prefix, untouched for `seconds`.

    Of a process that is still there they stay: a clock may jump by years.
    """
    for folder in Path(tempfile.gettempdir()).glob(f"{prefix}*"):
        with contextlib.suppress(OSError):
            facts = folder.lstat()
            own = not hasattr(os, "getuid") or facts.st_uid == os.getuid()
            of = folder.name.removeprefix(prefix).partition("_")[0]
            there = of.isdecimal() and os.path.exists(f"/proc/{of}")
            if own and not there and time.time() - facts.st_mtime > seconds:
                shutil.rmtree(folder, ignore_errors=True)


def resident_bytes(process: subprocess.Popen[bytes]) -> int:
    """Return the memory that a child holds, or 0 where it cannot be told."""
    try:
        if sys.platform == "win32":
            return _windows_commit(int(process._handle))  # type: ignore[attr-defined]
        if sys.platform.startswith("linux"):  # bubblewrap's Python is its child
            sizes = [_read(f"/proc/{it}/statm").split() for it in _family(process.pid)]
            pages = sum(int(words[1]) for words in sizes if words)
            return pages * os.sysconf("SC_PAGE_SIZE")
        ps = ["ps", "-o", "rss=", "-p", str(process.pid)]
        return int(run(ps).stdout or 0) * 1024
    except (OSError, ValueError, IndexError):
        return 0


def was_killed(process: subprocess.Popen[bytes]) -> bool:
    """Return whether a process that ended was ended by a signal, and not by a fault."""
    return process.returncode in _KILLED


def oom_kills() -> int:
    """Return how many processes Linux has killed so far since memory ran out."""
    for line in _read("/proc/vmstat").splitlines():
        if line.startswith("oom_kill "):
            return int(line.split()[1])
    return 0


def scheduled(process: subprocess.Popen[bytes]) -> tuple[float, float]:
    """Return for how many seconds a process and its children had a processor, and for
    how many they waited for one; 0 where nobody knows.
    """
    times = [_read(f"/proc/{pid}/schedstat").split() for pid in _family(process.pid)]
    ran, waited = (sum(int(each[i]) for each in times if each) for i in (0, 1))
    return ran / 1e9, waited / 1e9


def waited() -> float:
    """Return for how many seconds this process waited for a processor, as above."""
    places = (f"/proc/self/task/{one}/schedstat" for one in _threads("self"))
    times = (_read(place).split() for place in places)
    return sum(int(each[1]) for each in times if each) / 1e9


def _family(pid: int) -> list[int]:
    """Return a process and what any of its threads started, on Linux."""
    lists = [_read(f"/proc/{pid}/task/{one}/children") for one in _threads(pid)]
    children = [int(child) for some in lists for child in some.split()]
    return [pid, *(one for child in children for one in _family(child))]


def _threads(pid: int | str) -> list[str]:
    try:
        return os.listdir(f"/proc/{pid}/task")
    except OSError:  # it has ended, or this is another system
        return []


def _read(path: str) -> str:
    """Return a file of the kernel's; "" where there is none."""
    try:
        return Path(path).read_text("ascii")
    except OSError:
        return ""
