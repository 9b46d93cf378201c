"""Run the labs of a week and collect the numbers that they record."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from labkit.base import processes
from labkit.lesson.day import Day
from labkit.log import read_rows
from labkit.report.series import Series, series_of


@dataclass(frozen=True)
class LabResult:
    """The result of a day's lab."""

    day: Day
    mine: bool  # the student's file ran, and not the kit's
    numbers: Sequence[Series]  # the numbers that the manifest asks for, with their rows
    why: str  # why it did not pass, in a line; "" where it did

    @property
    def passed(self) -> bool:
        """The lab and every number that the manifest asks for are right."""
        return not self.why and all(one.status == "pass" for one in self.numbers)


def run_labs(
    days: Sequence[Day],
    python: str | Path = sys.executable,
    environment: Mapping[str, str] | None = None,
    *,
    kits: bool = False,
) -> Iterator[LabResult]:
    """Run labs side by side, the student's own where they are begun.

    Args:
        days: whose labs.
        python: to run them with.
        environment: its variables; this process's by default.
        kits: run the kit's labs, whatever the student has begun.

    Returns:
        What became of each, in the order of the days.
    """
    given = os.environ if environment is None else environment

    def run(day: Day) -> LabResult:
        mine = day.work.is_file() and not kits
        command = [str(python), str(day.work if mine else day.source)]
        with tempfile.TemporaryDirectory(prefix="robo47-week-") as folder:
            log = Path(folder) / "metrics.csv"
            variables = {**given, "ROBO47_METRICS": str(log), "COLUMNS": "80"}
            done = processes.run(command, env=variables)
            rows = read_rows(log) if log.exists() else []
        return LabResult(day, mine, series_of(day, rows), _why(done))

    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        yield from pool.map(run, days)


def _why(done: subprocess.CompletedProcess[str]) -> str:
    """Return what a lab says of its failure, in a line."""
    if done.returncode == 0:
        return ""
    _, mark, failed = done.stdout.partition("FAILED: ")
    if mark:
        return " ".join(failed.partition("FAILED: ")[0].split())
    lines = done.stderr.strip().splitlines()
    # A bug of the kit prints its own words first.
    if lines[1:] and lines[-1].startswith("Which function"):
        del lines[-1]
    return lines[-1].strip() if lines else f"it ended with code {done.returncode}"
