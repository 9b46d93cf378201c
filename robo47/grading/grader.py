"""A process for the checker, from outside: one package after the other, with a limit.

`grade_package` is what runs on this machine's threads and on Dask's workers alike.
"""

import atexit
import contextlib
import json
import os
import pickle
import queue
import shutil
import subprocess
import sys
import tempfile
import threading

from robo47.checker import resources
from robo47.errors import Robo47Error
from robo47.grading import kit
from robo47.grading.package import Package
from robo47.grading.result import Result, from_json, ungraded
from robo47.lesson.day import find_day
from robo47.paths import ROOT

# For one package. The sandbox stops eight tasks that hang after 20 s each at most, so
# only a file that keeps the checker itself busy gets here.
SECONDS = 240.0
LEAVE_SECONDS = 5.0


class Grader:
    """One grading process and its folder, from start to end."""

    def __init__(self) -> None:
        """Start it."""
        self.folder = tempfile.mkdtemp(prefix="robo47-grader-")
        temporary = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), self.folder)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "robo47.grading.child", self.folder],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=self.folder,  # MuJoCo writes its warnings there
            env={**os.environ, **temporary, "PYTHONPATH": str(ROOT)},
            **resources.start_options(),  # type: ignore[call-overload]
        )

    def grade(self, package: Package, seconds: float = SECONDS) -> Result:
        """Return a package's result; one that says so where grading ended early.

        Args:
            package: one submission.
            seconds: after so many the process is ended.
        """
        late = threading.Event()

        def stop() -> None:
            late.set()
            resources.end(self.process)

        timer = threading.Timer(seconds, stop)
        timer.start()
        try:
            assert self.process.stdin is not None
            assert self.process.stdout is not None
            with contextlib.suppress(OSError):  # it died: the answer below is empty
                pickle.dump(package, self.process.stdin)
                self.process.stdin.flush()
            answer = self.process.stdout.readline()
        finally:
            timer.cancel()
        if answer.endswith(b"\n"):
            return from_json(json.loads(answer))
        self.close()
        why = f"it took more than {seconds:.0f} s" if late.is_set() else "it crashed"
        return ungraded(find_day(package.day), f"grading it was stopped: {why}")

    @property
    def alive(self) -> bool:
        """Whether it can take another package."""
        return self.process.poll() is None

    def close(self) -> None:
        """End the process and remove its folder."""
        for stream in (self.process.stdin, self.process.stdout):
            with contextlib.suppress(OSError, AttributeError):
                stream.close()  # type: ignore[union-attr]
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(LEAVE_SECONDS)
        resources.end(self.process)
        shutil.rmtree(self.folder, ignore_errors=True)


_idle: queue.SimpleQueue[Grader] = queue.SimpleQueue()


def grade_package(package: Package) -> Result:
    """Return a package's result; any thread may call it, each call has its process.

    Args:
        package: one submission.

    Raises:
        Robo47Error: this machine has another kit than the one that sent it.
    """
    if package.kit != kit.fingerprint():
        raise Robo47Error(
            f"a worker's kit ({kit.fingerprint()}) is not the coordinator's "
            f"({package.kit}); check out the same commit on both"
        )
    try:
        grader = _idle.get_nowait()
    except queue.Empty:
        grader = Grader()
    try:
        return grader.grade(package)
    finally:
        if grader.alive:
            _idle.put(grader)


@atexit.register
def close_graders() -> None:
    """End the idle grading processes."""
    while True:
        try:
            _idle.get_nowait().close()
        except queue.Empty:
            return
