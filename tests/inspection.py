"""What the tests of the inspector share: a server to talk to, as a person starts it."""

import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from queue import Queue

ROOT = Path(__file__).resolve().parent.parent
SCRIPT = ROOT / "scripts" / "view_panda.py"
SECONDS = 60
NO_ROBOT = "from robo47.panda import files; files.panda_folder = lambda: None"


def prepared(work: Path, robot: bool, memory: Path) -> str:
    """Return a program that runs the script with another file as the student's.

    Args:
        work: the student's file, there or not; their real one stays out of the tests.
        robot: False as if the robot had never been fetched.
        memory: the folder in place of `.robo47`.
    """
    lines = [
        "import pathlib, runpy, sys",
        f"sys.argv[0] = {str(SCRIPT)!r}",
        f"sys.path.insert(0, {str(SCRIPT.parent)!r})",
        "from labkit.lesson.day import Day",
        f"Day.work = pathlib.Path({str(work)!r})",
        "from labkit.base import store",
        f"store.path_of = lambda name, *_: pathlib.Path({str(memory)!r}) / name",
        "" if robot else NO_ROBOT,
        "runpy.run_path(sys.argv[0], run_name='__main__')",
    ]
    return "\n".join(lines)


class Served:
    """`view_panda.py` in a process of its own, ready to be looked at."""

    def __init__(
        self,
        *arguments: str,
        robot: bool = True,
        work: Path = ROOT / "nobodys.py",
        memory: Path | None = None,
    ) -> None:
        self.own = tempfile.TemporaryDirectory()
        program = prepared(work, robot, memory or Path(self.own.name))
        self.process = subprocess.Popen(
            [sys.executable, "-c", program, *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            encoding="utf-8",
            cwd=ROOT,
            env={**os.environ, "PYTHONUNBUFFERED": "1"},
            creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
        )
        self.lines: list[str] = []
        self.ready: Queue[str] = Queue()
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()
        try:
            self.url = self.ready.get(timeout=SECONDS)
            assert self.url, self.said
        except BaseException:
            self.close()
            raise

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.lines.append(line)
            if found := re.search(r"http://127\.0\.0\.1:\d+/\S+/", line):
                self.ready.put(found[0])
        self.ready.put("")  # it ended

    @property
    def said(self) -> str:
        """Everything it printed so far."""
        return "".join(self.lines)

    @property
    def port(self) -> int:
        """Where it listens."""
        return int(re.search(r":(\d+)/", self.url)[1])  # type: ignore[index]

    @property
    def path(self) -> str:
        """What makes the address a secret, "/.../"."""
        return "/" + self.url.split("/", 3)[3]

    def press_ctrl_c(self) -> int:
        """Do so, and return the exit code."""
        windows = sys.platform == "win32"
        self.process.send_signal(
            signal.CTRL_BREAK_EVENT if windows else signal.SIGINT  # type: ignore[attr-defined]
        )
        code = self.process.wait(timeout=SECONDS)
        self.reader.join(timeout=SECONDS)
        return code

    def __enter__(self) -> "Served":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End it, whatever state it is in."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait(timeout=SECONDS)
        self.reader.join(timeout=SECONDS)
        assert self.process.stdout is not None
        self.process.stdout.close()
        self.own.cleanup()
