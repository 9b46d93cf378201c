"""A process for the checker, from outside: one package after the other, with a limit.

`grade_package` is what runs on this machine's threads and on Dask's workers alike;
`grade_behind_wall` on workers that nobody spoke for.
"""

import atexit
import json
import os
import pickle
import queue
import shutil
import socket
import tempfile
from typing import Any

from labkit.base import processes
from labkit.grade.package import Package, fingerprint
from labkit.sandbox.wall import refusal, wall
from robo47.errors import FaultError, Robo47Error
from robo47.paths import ROOT

# For one package. The sandbox stops a file after 100 s of its own, so only a machine
# under load gets here.
SECONDS = 240.0
LEFT_BEHIND = 86_400  # seconds after which a folder of ours belongs to nobody
FOLDER = "robo47-grader-"


class Grader(processes.Child):
    """One grading process and its folder, from start to end."""

    def __init__(self) -> None:
        """Start the process, behind the wall that was promised, in a new folder."""
        # The wall that was promised, or none of this: not what stands at that moment.
        promised = {"ROBO47_WALL": wall().name, "PYTHONPATH": str(ROOT)}
        self.folder = tempfile.mkdtemp(prefix=FOLDER)
        temporary = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), self.folder)
        environment = {**os.environ, **temporary, **promised}
        try:  # in its folder, since MuJoCo writes its warnings there
            super().__init__(
                "labkit.grade.child", self.folder, cwd=self.folder, env=environment
            )
        except OSError:
            shutil.rmtree(self.folder, ignore_errors=True)
            raise

    def grade(self, package: Package, seconds: float = SECONDS) -> dict[str, Any]:
        """Return a package's result as JSON, which `result.from_json` reads.

        Args:
            package: one submission.
            seconds: after so many the process is ended.

        Raises:
            FaultError: grading ended early, or the machine failed.
        """
        with self.within(seconds):
            self.send(pickle.dumps(package))
            answer = self.process.stdout.readline()
        if answer.endswith(b"\n"):
            found: dict[str, Any] = json.loads(answer)
            if "fault" in found:
                raise FaultError(found["fault"])
            return found
        self.close()
        why = f"it took more than {seconds:.0f} s" if self.late else "it was killed"
        raise FaultError(f"grading it was stopped: {why}")

    def close(self) -> None:
        """End the process and remove its folder."""
        super().close()
        shutil.rmtree(self.folder, ignore_errors=True)


_idle: queue.SimpleQueue[Grader] = queue.SimpleQueue()


def grade_package(package: Package) -> dict[str, Any]:
    """Return a package's result as JSON; each call has a process of its own.

    Args:
        package: one submission; any thread may bring one.

    Raises:
        Robo47Error: this machine has another kit than the one that sent it.
        FaultError: the machine failed; the package is as good as new.
    """
    own = fingerprint(package.day)
    if package.kit != own:
        raise Robo47Error(
            f"a worker's kit ({own}) is not the coordinator's "
            f"({package.kit}); check out the same commit on both"
        )
    grader = None
    try:
        try:
            grader = _idle.get_nowait()
        except queue.Empty:
            grader = Grader()
        return grader.grade(package)
    except (OSError, RuntimeError, MemoryError) as error:  # RuntimeError: no thread
        raise FaultError(f"no process for it: {error}") from None
    finally:
        if grader and grader.alive:
            _idle.put(grader)


def grade_behind_wall(package: Package) -> dict[str, Any]:
    """Return what `grade_package` does, where a wall keeps such code from here.

    Args:
        package: one submission.

    Raises:
        Robo47Error: it does not, or has another kit.
        FaultError: the machine failed; the package is as good as new.
    """
    if why := refusal():
        raise Robo47Error(
            f"a worker on {socket.gethostname()} refuses: {why}, run workers in a "
            "container (docs/cluster.md), or add --i-know-them"
        )
    return grade_package(package)


@atexit.register
def close_graders() -> None:
    """End the idle grading processes."""
    while True:
        try:
            _idle.get_nowait().close()
        except queue.Empty:
            return
