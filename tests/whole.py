"""Which days are tested wholly, and which by a sample.

    python tests/whole.py              test each day that has changed, and record it
    python tests/whole.py 3 11         these days
    python tests/whole.py --changed    name the days that have changed
    python tests/whole.py --machine    record that CI has passed with this machine

A record in `tests/catalogues.txt` says that a day's whole catalogue and its authors'
tests have passed, and with which digest of all that decides this (`digests.py`). While
the digest is the same, a tenth of the catalogue is tested, another tenth at each
commit, and in CI a tenth of the day's own authors' tests. In all other cases, such as a
day without a record, everything is tested. ROBO47_WHOLE=1, which CI sets at night, and
ROBO47_DAY=3 have days tested wholly always.

In the same way a line "machine 14: ..." says that `.ci/run` has passed, on a clean
checkout, with the machine and Days 1 to 14 as they are. Until one of them changes, CI
runs a fifth of the files of authors' tests. A file that loops over all days is always
run, on all days that have changed and on a fifth of the others. With another
processor's kernels, CI runs a fifth of the other tests and of the documents as well.
"""

import os
import random
import re
import sys
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import TypeVar

import pytest
from digests import digest, machine_digest

from labkit.base import git
from labkit.base.git import GitError
from labkit.lesson.day import Day, all_days, find_day
from robo47.paths import ROOT

RECORDS = ROOT / "tests" / "catalogues.txt"
HEAD = (
    "# The days whose whole catalogue and tests have passed, and what decided it.\n"
    "# python tests/whole.py writes this file; after a merge, all lines may stay.\n"
)
FILES = (
    "tests/test_days_catalogue.py",
    "tests/test_days_judging.py",
    "tests/test_odd_ways.py",
)
MARKS = "kit and not soak and not browser and not network"
PART = 10  # one of so many is asked where nothing has changed
FILES_PART = 5  # one of so many files is asked where the machine has not changed
EVERY_DAY = re.compile(r"\b(all_)?days\(|\bweeks\(")  # asked of a new day as well
DAY_OF = re.compile(r"(?:^w[^:]*/day|\[.*\bday)(\d+)")
One = TypeVar("One")


def changed(day: Day) -> bool:
    """Return whether a day is to be tested wholly."""
    if os.environ.get("ROBO47_WHOLE") or os.environ.get("ROBO47_DAY"):
        return True
    return digest(day) not in recorded().get(day.number, set())


def recorded(file: Path | None = None) -> dict[int, set[str]]:
    """Return the digests on record, by day; after a merge a day may have several."""
    file = file or RECORDS
    text = file.read_text("utf-8") if file.is_file() else ""
    found: dict[int, set[str]] = {}
    for number, mark in re.findall(r"(?m)^day (\d+): ([0-9a-f]{16})$", text):
        found.setdefault(int(number), set()).add(mark)
    return found


def sample(things: Iterable[One], purpose: str, part: int = PART) -> list[One]:
    """Return a tenth of some things, one at least, another tenth at each commit."""
    some = list(things)
    rng = random.Random(f"{commit()} {purpose}")
    kept = {*rng.sample(range(len(some)), min(len(some), max(1, len(some) // part)))}
    return [one for i, one in enumerate(some) if i in kept]


def machine_is_recorded(file: Path | None = None) -> bool:
    """Return whether CI has passed with the machine and its days as they are now."""
    file = file or RECORDS
    if os.environ.get("ROBO47_WHOLE") or not file.is_file():
        return False
    lines = re.findall(r"(?m)^machine (\d+): ([0-9a-f]{16})$", file.read_text("utf-8"))
    try:
        return any(mark == _machine(int(last)) for last, mark in lines)
    except GitError:
        return False


def _machine(last: int) -> str:
    """Return the digest of the machine and of the days up to one."""
    return machine_digest([day for day in all_days() if day.number <= last])


def left_out_of_machine(items: Sequence[pytest.Item]) -> list[pytest.Item]:
    """Return the tests that are not to be run while the machine is as recorded.

    Args:
        items: the tests that are collected.
    """
    if not machine_is_recorded():
        return []
    kernel = os.environ.get("OPENBLAS_CORETYPE")
    marks = ("kit", "browser", "network")
    own = [one for one in items if kernel or any(map(one.get_closest_marker, marks))]
    files = sorted({one.path for one in own if ROOT / "tests" in one.path.parents})
    alone = [path for path in files if not EVERY_DAY.search(path.read_text("utf-8"))]
    left = {*alone} - {*sample(alone, "machine", FILES_PART)}
    same = [day for day in all_days() if not changed(day)]
    others = {day.number for day in same} - {
        day.number for day in sample(same, "machine", FILES_PART)
    }
    return [one for one in own if one.path in left or _day_of(one) in others]


def _day_of(item: pytest.Item) -> int:
    """Return the number of the day that a test is about, 0 where it names none."""
    name = DAY_OF.search(item.nodeid)
    return int(name[1]) if name else 0


def left_out(items: Sequence[pytest.Item]) -> list[pytest.Item]:
    """Return the authors' tests in days' folders that are not to be run: all but some.

    Args:
        items: the tests that are collected.
    """
    left: list[pytest.Item] = []
    for day in all_days():
        own = [one for one in items if day.own in one.path.parents]
        own = [one for one in own if one.get_closest_marker("kit")]
        kept = asked(day, own, "tests") if own else own
        left += [one for one in own if one not in kept]
    return left + left_out_of_machine(items)


def one_of_each(things: Iterable[One], kind: Callable[[One], object]) -> list[One]:
    """Return one thing of each kind, others at each commit."""
    of_kind: dict[object, list[One]] = {}
    for one in things:
        of_kind.setdefault(kind(one), []).append(one)
    return [random.Random(f"{commit()} {k}").choice(of_kind[k]) for k in of_kind]


def asked(day: Day, things: Sequence[One], purpose: str) -> Sequence[One]:
    """Return all things of a day that has changed, and a sample of another day's."""
    return things if changed(day) else sample(things, f"day {day.number} {purpose}")


@cache
def commit() -> str:
    """Return the commit that is tested; "" without a repository."""
    try:
        done = git.run("rev-parse", "HEAD", folder=ROOT, seconds=git.SECONDS)
        return str(done.stdout).strip()
    except GitError:
        return ""


class Outcomes:
    """Of a run of pytest: the days that it tested, and those of which a test failed."""

    def __init__(self) -> None:
        """Begin with no test."""
        self.passed, self.failed = set[int](), set[int]()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note the outcome of a test; a failure without a day is one of all days."""
        name = DAY_OF.search(report.nodeid)
        if not name and report.failed:
            self.failed |= {day.number for day in all_days()}
        elif name and not report.passed:
            self.failed.add(int(name[1]))
        elif name and report.when == "call":
            self.passed.add(int(name[1]))


def tests_of(days: Sequence[Day]) -> list[str]:
    """Return the files and folders of the tests that are run wholly of some days."""
    return [*(str(ROOT / name) for name in FILES), *(str(day.own) for day in days)]


def ask(days: Sequence[Day]) -> list[Day]:
    """Test days wholly; return those of which all tests pass."""
    before = {day.number: digest(day) for day in days}
    os.environ.pop("PYTEST_ADDOPTS", None)
    os.environ |= {"ROBO47_CI": "1", "ROBO47_WHOLE": "1"}
    os.environ["ROBO47_DAY"] = ",".join(map(str, before))
    outcomes = Outcomes()
    options = ["-q", "-m", MARKS, "-n", "2", "--dist", "worksteal"]
    code = pytest.main([*options, *tests_of(days)], plugins=[outcomes])
    if code not in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED):
        return []
    # A file that has changed meanwhile was not asked, or only in part.
    same = {number for number in before if digest(find_day(number)) == before[number]}
    return [find_day(number) for number in same & outcomes.passed - outcomes.failed]


def record(days: Iterable[Day], file: Path | None = None) -> None:
    """Write the digests of days whose whole catalogue has passed."""
    file = file or RECORDS
    known = recorded(file) | {day.number: {digest(day)} for day in days}
    lines = [
        f"day {n}: {m}\n" for n, marks in sorted(known.items()) for m in sorted(marks)
    ]
    text = file.read_text("utf-8") if file.is_file() else ""
    machine = re.findall(r"(?m)^machine .*\n", text)
    file.write_text(HEAD + "".join([*lines, *machine]), "utf-8", newline="\n")


def record_machine() -> str:
    """Write that CI has passed with the machine and all days; return the line."""
    last = max(day.number for day in all_days())
    line = f"machine {last}: {_machine(last)}"
    text = RECORDS.read_text("utf-8") if RECORDS.is_file() else HEAD
    kept = re.sub(r"(?m)^machine .*\n", "", text)
    RECORDS.write_text(f"{kept}{line}\n", "utf-8", newline="\n")
    return line


def main() -> int:
    """Test the days that are named, or have changed; return 1 where a test failed."""
    arguments = sys.argv[1:]
    if arguments == ["--changed"]:
        names = [f"day {day.number}" for day in all_days() if changed(day)]
        print(", ".join(names) or "no day has changed")
        return 0
    if arguments == ["--machine"]:
        print(f"{RECORDS.name}: {record_machine()}")
        return 0
    days = [find_day(int(number)) for number in arguments] or [
        day for day in all_days() if changed(day)
    ]
    if not days:
        print("no day has changed")
        return 0
    failed = []
    for day in days:  # one by one: what has passed is on record if a later one stops
        print(f"day {day.number}:", flush=True)
        good = ask([day])
        record(good)
        failed += [] if good else [f"day {day.number}"]
    print(f"{RECORDS.name}: {len(days) - len(failed)} of {len(days)} days are recorded")
    print(f"not recorded: {', '.join(failed)}\n" if failed else "", end="")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
