"""Packages in, results out: on this machine's processors, or on a Dask cluster.

Both are executors of the standard library's kind and run the same function. Only so
many packages are under way at once, so a class of any size takes the same memory.
"""

import contextlib
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
from dataclasses import dataclass, replace
from typing import Any

from labkit.base.processes import sweep
from labkit.base.text import visible
from labkit.grade import in_time
from labkit.grade.grader import (
    FOLDER,
    LEFT_BEHIND,
    close_graders,
    grade_behind_wall,
    grade_package,
)
from labkit.grade.package import Package
from labkit.grade.result import Result, from_json
from labkit.grade.roster import Student
from labkit.lesson.day import find_day
from robo47.errors import FaultError, Robo47Error

PER_WORKER = 2  # packages under way for each worker: one graded, one waiting
PATIENCE = 60.0  # seconds without any worker before giving up
SILENCE = 900.0  # seconds without any result before giving up on what is under way
NO_DASK = (
    "--dask needs the package distributed: python3 scripts/setup_env.py grade "
    "(make grade does it)"
)
NO_CERTIFICATES = (
    "tls:// needs Dask to know your certificates (ca-file, client cert and key); "
    "docs/cluster.md says how"
)


@dataclass(frozen=True)
class Engine:
    """Where packages are graded.

    Attributes:
        executor: runs `grade`.
        workers: returns how many packages can be graded at the same time now.
        lost: the exception that a package brings back whose workers all died.
        grade: what is run.
    """

    executor: Executor
    workers: Callable[[], int]
    lost: type[BaseException] = FaultError
    grade: Callable[[Package], Any] = grade_package


@contextlib.contextmanager
def local(processes: int) -> Iterator[Engine]:
    """Grade on this machine.

    Args:
        processes: how many submissions at a time.
    """
    for prefix in (FOLDER, in_time.FOLDER):
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
        from distributed.scheduler import KilledWorker
        from distributed.security import Security
    except ImportError:
        raise Robo47Error(NO_DASK) from None
    known = Security().get_connection_args("client")
    if address.startswith("tls:") and not known.get("ssl_context"):
        raise Robo47Error(NO_CERTIFICATES)
    try:
        client = Client(address, timeout=10, set_as_default=False)
    except (OSError, ValueError, TypeError, RuntimeError) as error:
        why = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise Robo47Error(f"no Dask scheduler at {address}: {why}") from None
    try:
        grade = grade_package if trusted else grade_behind_wall
        executor = client.get_executor()
        yield Engine(
            executor, lambda: sum(client.nthreads().values()), KilledWorker, grade
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
            future = engine.executor.submit(engine.grade, package)
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
    """Wait for results and yield them."""
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
