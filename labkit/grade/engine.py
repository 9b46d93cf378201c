"""Packages in, results out: on this machine's processors, or on a Dask cluster.

Both are executors of the standard library's kind and run the same function, which has
each package graded by a process of its own, within a limit (`labkit.grade.child`). Only
so many packages are under way at once, so a class of any size takes the same memory.
"""

import atexit
import contextlib
import json
import os
import pickle
import queue
import shutil
import socket
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    CancelledError,
    Executor,
    Future,
    ThreadPoolExecutor,
    wait,
)
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Protocol, TypeAlias

from labkit.base.processes import Child, scheduled, sweep
from labkit.base.text import visible
from labkit.grade.package import FOLDER as COMMIT_FOLDER
from labkit.grade.package import Package, fingerprint
from labkit.grade.result import Result, from_json, kept_busy
from labkit.grade.roster import Student
from labkit.lesson.day import find_day
from labkit.sandbox.process import wall
from labkit.sandbox.sandbox import deadline_of
from robo47.errors import FaultError, Robo47Error
from robo47.paths import ROOT

PER_WORKER = 2  # packages under way for each worker: one graded, one waiting
REACHING = 10.0  # seconds for a Dask scheduler to answer
PATIENCE = 60.0  # seconds without any worker before giving up
SILENCE = 900.0  # seconds without any result before giving up on what is under way
# The time of one package beyond its own deadline. The checker keeps the deadline, so
# only code that it cannot interrupt gets here, or a machine under load.
BEYOND = 230.0
LEFT_BEHIND = 86_400  # seconds after which a folder of ours belongs to nobody
FOLDER = "robo47-grader-"


class Stoppable(Protocol):
    """A package of another kind, which knows what stands where it was stopped."""

    @property
    def day(self) -> int:
        """The day's number."""

    @property
    def kit(self) -> str:
        """The fingerprint of the kit that collected it."""

    def stopped(self, why: str) -> dict[str, Any]:
        """Return what stands in the place of its result."""


Gradable: TypeAlias = Package | Stoppable


class Grader(Child):
    """One grading process and its folder, from start to end."""

    def __init__(self) -> None:
        """Start the process, behind the wall that was promised, in a new folder."""
        # The wall that was promised, or none of this: not what stands at that moment.
        promised = {"ROBO47_WALL": wall().name, "PYTHONPATH": str(ROOT)}
        self.folder = tempfile.mkdtemp(prefix=f"{FOLDER}{os.getpid()}_")
        temporary = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), self.folder)
        environment = {**os.environ, **temporary, **promised}
        try:  # MuJoCo writes its warnings into the working folder
            super().__init__(
                "labkit.grade.child", self.folder, cwd=self.folder, env=environment
            )
        except OSError:
            shutil.rmtree(self.folder, ignore_errors=True)
            raise

    def grade(self, package: Gradable, beyond: float = BEYOND) -> dict[str, Any]:
        """Return a package's result as JSON, which `result.from_json` reads.

        Args:
            package: one submission.
            beyond: so many seconds after its deadline the process is ended. If it was
                at work most of the time, the submission kept it busy.

        Raises:
            FaultError: grading ended early, or the machine failed.
        """
        day = find_day(package.day)
        seconds = deadline_of(day).seconds + beyond
        before, _ = scheduled(self.process)
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
        if self.late and self.ran - before > seconds / 2:
            why = f"{why} of the checker's own work"
            if isinstance(package, Package):
                return asdict(kept_busy(day, why))
            return package.stopped(why)
        raise FaultError(f"grading it was stopped: {why}")

    def close(self) -> None:
        """End the process and remove its folder."""
        super().close()
        shutil.rmtree(self.folder, ignore_errors=True)


def in_container() -> bool:
    """Return whether this is a container, where root is not root outside."""
    marks = ("/.dockerenv", "/run/.containerenv")
    told = ("container", "KUBERNETES_SERVICE_HOST")  # systemd's and podman's; a pod's
    return any(map(os.environ.get, told)) or any(Path(mark).exists() for mark in marks)


def refusal() -> str:
    """Return why other people's code should not run here; "" where it may."""
    if wall().name == "none":  # a container may share the home, as Toolbox's does
        return "these submissions would run with your rights"
    if hasattr(os, "geteuid") and os.geteuid() == 0 and not in_container():
        return "you are root, and this is no container: be an ordinary user"
    return ""


_idle: queue.SimpleQueue[Grader] = queue.SimpleQueue()


def grade_package(package: Gradable, needs_wall: bool = False) -> dict[str, Any]:
    """Return a package's result as JSON; each call has a process of its own.

    Args:
        package: one submission; any thread may bring one.
        needs_wall: refuse where nothing keeps submissions from this machine.

    Raises:
        Robo47Error: it refuses, or has another kit than the one that sent it.
        FaultError: the machine failed; the package is as good as new.
    """
    if needs_wall and (why := refusal()):
        raise Robo47Error(
            f"a worker on {socket.gethostname()} refuses: {why}, run workers in a "
            "container (docs/cluster.md), or add --i-know-them"
        )
    own = fingerprint(package.day)
    if package.kit != own:
        raise Robo47Error(
            f"a worker's kit ({own}) is not the coordinator's "
            f"({package.kit}); check out the same commit on both"
        )
    grader = None
    try:
        with contextlib.suppress(queue.Empty):
            grader = _idle.get_nowait()
        grader = grader or Grader()
        return grader.grade(package)
    except (OSError, RuntimeError, MemoryError) as error:  # RuntimeError: no thread
        raise FaultError(f"no process for it: {error}") from None
    finally:
        if grader and grader.alive:
            _idle.put(grader)


@atexit.register
def close_graders() -> None:
    """End the idle grading processes."""
    with contextlib.suppress(queue.Empty):
        while True:
            _idle.get_nowait().close()


@dataclass(frozen=True)
class Engine:
    """The workers that grade packages."""

    executor: Executor  # runs `grade_package`
    # It returns how many packages can be graded at the same time.
    workers: Callable[[], int]
    # The error of a package whose workers all died.
    lost: type[BaseException] = FaultError
    needs_wall: bool = False  # nobody spoke for the submissions


@contextlib.contextmanager
def local(processes: int) -> Iterator[Engine]:
    """Grade on this machine.

    Args:
        processes: how many submissions at a time.
    """
    for prefix in (FOLDER, COMMIT_FOLDER):
        sweep(prefix, LEFT_BEHIND)
    pool = ThreadPoolExecutor(processes)  # each thread waits for a process of its own
    try:
        yield Engine(pool, lambda: processes)
    finally:
        pool.shutdown(cancel_futures=True)
        close_graders()


@contextlib.contextmanager
def dask(address: str, trusted: bool = False) -> Iterator[Engine]:
    """Grade on a Dask cluster; certificates come from Dask's own configuration.

    Args:
        address: of the scheduler, "tls://10.0.0.5:8786".
        trusted: also on workers that nothing keeps the submissions from.

    Raises:
        Robo47Error: `distributed` is not installed, or no scheduler answers.
    """
    try:
        from distributed import Client
        from distributed.comm import resolve_address
        from distributed.scheduler import KilledWorker
        from distributed.security import Security
    except ImportError:
        raise Robo47Error(
            "--dask needs the package distributed: python3 scripts/setup_env.py grade "
            "(make grade does it)"
        ) from None
    known = Security().get_connection_args("client")
    if address.startswith("tls:") and not known.get("ssl_context"):
        raise Robo47Error(
            "tls:// needs Dask to know your certificates (ca-file, client cert and "
            "key); docs/cluster.md says how"
        )
    try:
        # first, since half a client takes 20 s to end, with a traceback
        resolve_address(address)
        client = Client(address, timeout=REACHING, set_as_default=False)
    except (OSError, ValueError, TypeError, RuntimeError) as error:
        why = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise Robo47Error(f"no Dask scheduler at {address}: {why}") from None
    try:
        executor = client.get_executor()
        yield Engine(
            executor, lambda: sum(client.nthreads().values()), KilledWorker, not trusted
        )
    finally:
        client.close()


def grade_all(
    packages: Iterable[tuple[Student, Package]], engine: Engine
) -> Iterator[tuple[Student, Package, Result | FaultError]]:
    """Yield each package's result as it comes, in any order.

    Args:
        packages: whose each is, and it; taken as there is room.
        engine: where to grade.

    Raises:
        Robo47Error: no worker is left, or one cannot run this kit.
    """
    under_way: dict[Future[Any], tuple[Student, Package]] = {}
    try:
        for student, package in packages:
            future = engine.executor.submit(grade_package, package, engine.needs_wall)
            under_way[future] = (student, package)
            while len(under_way) >= PER_WORKER * max(1, engine.workers()):
                yield from _finished(under_way, engine)
        while under_way:
            yield from _finished(under_way, engine)
    finally:
        for future in under_way:
            future.cancel()


def _finished(
    under_way: dict[Future[Any], tuple[Student, Package]], engine: Engine
) -> Iterator[tuple[Student, Package, Result | FaultError]]:
    silent = time.monotonic() + SILENCE
    while not (done := wait(under_way, PATIENCE, FIRST_COMPLETED).done):
        if time.monotonic() >= silent:
            break
        if not engine.workers():
            raise Robo47Error(
                f"no Dask worker has been there for {PATIENCE:.0f} s. What is graded "
                "is kept: start workers and run the same command again"
            )
    for future in done or list(under_way):
        student, package = under_way.pop(future)
        if future.done():
            yield student, package, _answer(future, package, engine)
        else:
            future.cancel()
            yield student, package, FaultError(f"no answer for {SILENCE:.0f} s")


def _answer(
    future: Future[Any], package: Package, engine: Engine
) -> Result | FaultError:
    """Return what came of a package; a worker may raise and return anything.

    Raises:
        Robo47Error: no worker like that one can grade.
    """
    error = CancelledError() if future.cancelled() else future.exception()
    if error is None:
        try:  # the answer can be anything
            return signed(from_json(future.result(), find_day(package.day)), package)
        except Exception:
            return FaultError("a worker's answer is no result of the day")
    if isinstance(error, FaultError):
        return error
    if isinstance(error, engine.lost):
        return FaultError("the workers that graded it were lost")
    if isinstance(error, ImportError | AttributeError):  # an older commit's
        raise Robo47Error(f"a worker cannot run this kit: {visible(error)}")
    if isinstance(error, Robo47Error):
        raise Robo47Error(visible(error))
    return FaultError(f"a worker ended with {type(error).__name__}: {error}")


def signed(result: Result, package: Package) -> Result:
    """Return a result with what another machine needs to come to the same."""
    again = f'make check DAY={package.day} ARGS="--seed {package.seed} --explain"'
    text = f"{result.text}\nGraded by robo47 {package.version} with the seed "
    text += f"{package.seed}, for everybody.\nThe same on your machine: {again}\n"
    return replace(result, text=text, kit=package.version, seed=package.seed)
