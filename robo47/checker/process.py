"""One interpreter for student code, from its start to its end."""

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
from pathlib import Path
from typing import Any

from robo47.checker import replies, resources
from robo47.checker.replies import LoadError, Reply
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

START_SECONDS, LOAD_SECONDS = 60.0, 10.0
CALL_SECONDS, ALL_SECONDS = 3.0, 20.0
RESIDENT_BYTES = 1024**3
LARGEST_SCRIPT = 1_000_000  # bytes
POLL_SECONDS = 0.05


class Process:
    """One interpreter with its folder, from start to end."""

    def __init__(self) -> None:
        """Start it; it gets ready while the caller prepares a request."""
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
        got: dict[int, Reply] = {}
        loaded, limit, ends = False, START_SECONDS, float("inf")
        while len(got) < len(request["calls"]):
            message = self._next(
                min(time.monotonic() + limit, ends), secret.encode("ascii")
            )
            if isinstance(message, Reply):
                if not loaded:
                    raise LoadError(message)
                return got, message
            if message.get("loaded") is False:
                raise LoadError(replies.read(message))
            if message.get("loaded"):
                loaded, ends = True, time.monotonic() + ALL_SECONDS
            limit = CALL_SECONDS if loaded else LOAD_SECONDS
            if message.get("at") == len(got) and len(message) > 1:  # an answer
                got[len(got)] = replies.read(message)
        return got, None

    def _next(self, deadline: float, secret: bytes) -> dict[str, Any] | Reply:
        """Return the next message, or a reply that says why there is none."""
        while True:
            try:
                line = self.lines.get(timeout=POLL_SECONDS)
            except queue.Empty:
                if resources.resident_bytes(self.process) > RESIDENT_BYTES:
                    return replies.stopped("it used more than 1 GB of memory")
                if time.monotonic() > deadline:
                    return replies.stopped(
                        "it runs on and on, as a loop without an end does"
                    )
                continue
            if line is None:
                return replies.stopped(self._how_it_ended())
            with contextlib.suppress(ValueError):
                message = json.loads(line.removeprefix(secret))
                if line.startswith(secret) and isinstance(message, dict):
                    return message
            return replies.stopped("it wrote into the checker's own channel")

    def _how_it_ended(self) -> str:
        try:
            return f"it ended Python (exit code {self.process.wait(timeout=1)})"
        except subprocess.TimeoutExpired:
            return "it closed the checker's own channel"

    def close(self) -> None:
        """End the process and remove its folder."""
        resources.end(self.process)
        for stream in (self.process.stdin, self.process.stdout):
            with contextlib.suppress(OSError, AttributeError):
                stream.close()  # type: ignore[union-attr]
        shutil.rmtree(self.folder, ignore_errors=True)


def _library_folders() -> list[str]:
    """Return where NumPy is: all that the sandbox gets of this environment."""
    spec = importlib.util.find_spec("numpy")
    if spec is None or spec.origin is None:
        raise Robo47Error("NumPy is not installed: run `make day1` once")
    return [str(Path(spec.origin).parent.parent)]


def closed_folders() -> list[str]:
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
