"""A proof of every student's week, each made by a process of its own."""

import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from labkit.base import processes
from labkit.base.text import visible
from labkit.grade.roster import Student, file_names
from labkit.sandbox.process import wall
from robo47.paths import ROOT

SECONDS = 900.0  # for one; a whole week takes a minute on a quiet machine


def write_pages(
    students: Sequence[Student], week: int, folder: Path, at_once: int
) -> Iterator[tuple[Student, str]]:
    """Write a page for every student of the roster, `at_once` at a time.

    Yields:
        Each student, and why there is no page; "" where there is.
    """
    folder.mkdir(parents=True, exist_ok=True)
    files = file_names(student.folder for student in students)

    def make(student: Student) -> str:
        return student.problem or _page(student, week, folder / files[student.folder])

    with ThreadPoolExecutor(at_once) as pool:
        yield from zip(students, pool.map(make, students), strict=True)


def _page(student: Student, week: int, file: Path) -> str:
    """Write a student's page; return why there is none, or ""."""
    command = [sys.executable, str(ROOT / "scripts" / "proof.py"), "--week", str(week)]
    command += ["--of", str(student.path), f"--name={student.name}"]
    command += ["--out", f"{file}.html"]
    promised = {**os.environ, "ROBO47_WALL": wall().name}
    try:
        done = processes.run(command, env=promised, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return f"it took more than {SECONDS:.0f} s"
    return visible(done.stderr.strip().rpartition("\n")[2]) if done.returncode else ""
