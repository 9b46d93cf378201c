"""Opens a day's tabs with the complete lab, and compares its pictures with new ones."""

import html
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from labkit.base import processes
from labkit.handin.figure import read_png
from labkit.lesson.day import Day, find_day
from robo47 import panda
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

APART = 40  # a difference over 40 of 255 is no rounding of a driver, and no palette
SHARE = 0.002  # the fraction of the pixels that may differ so much
SECONDS = 60.0  # the time that a tab has to load everything
LONGEST = 600.0  # seconds for all tabs of a day
CALM = 6  # looks at a tab in a row at which nothing was under way
# The lines of a panel about a tab that stopped, or functions outside the library.
_BAD = re.compile(
    r'<div class="[^"]*\br47-bad\b[^"]*" data-line="(?:tab|whose)"[^>]*>(.*?)</div>',
    re.DOTALL,
)


def pictures(day: Day) -> Iterator[str]:
    """Yield the pictures that are not there, or not what the kit draws now."""
    if not day.has("figures"):
        return
    draw = f"make figures DAY={day.number} ARGS=--kit"
    with tempfile.TemporaryDirectory(prefix="robo47-author-") as folder:
        words = ["--day", str(day.number), "--kit", "--out", folder]
        done = processes.run(
            [sys.executable, "scripts/make_figures.py", *words], cwd=ROOT
        )
        if done.returncode:
            yield f"{draw} fails: {' '.join(done.stderr.split())[-300:]}"
            return
        for new in sorted(Path(folder).glob("*.png")):
            there = day.folder / "figures" / new.name
            if not there.is_file():
                yield f"{shown(there)} is not there: {draw}"
            elif far := _difference(there, new):
                yield f"{shown(there)} is not what is drawn now: {far}. {draw}"


def _difference(there: Path, new: Path) -> str:
    """Return how far a picture is from the one that is drawn now, "" where near."""
    before, now = (read_png(path.read_bytes()).astype(int) for path in (there, new))
    if before.shape != now.shape:
        sizes = (f"{one.shape[1]} x {one.shape[0]}" for one in (before, now))
        return " became ".join(sizes)
    share = float((np.abs(before - now).max(axis=2) > APART).mean())
    return f"{share:.1%} of its pixels" if share > SHARE else ""


def tabs(day: Day) -> Iterator[str]:
    """Yield what stops the day's tabs with the complete lab as the student's file.

    It happens in a process of its own, as `make view` has one: what is still at work
    ends with it.
    """
    if not day.has("inspector"):
        return
    if not find_spec("viser"):
        yield "viser is not installed, so no tab can be opened: make author installs it"
        return
    words = [sys.executable, "-m", "labkit.author.display", str(day.number)]
    try:
        done = processes.run(words, cwd=ROOT, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        yield f"the tabs of day {day.number} are not open after {LONGEST:.0f} s"
        return
    lines = done.stdout.splitlines()
    if done.returncode or not lines:
        yield " ".join(done.stderr.split())[-400:]
        return
    yield from json.loads(lines[-1])


def tab_faults(day: Day) -> list[str]:
    """Return what a person would read of each tab of the day that stops, or differs."""
    from labkit.inspector.app import Inspector
    from labkit.inspector.arm import Arm
    from labkit.inspector.guard import LocalServer
    from labkit.inspector.serve import on_loop
    from labkit.inspector.student import Student
    from labkit.inspector.tab import day_tabs
    from labkit.sandbox.sandbox import Sandbox

    try:
        brought = day_tabs(day)
    except Robo47Error as error:
        return [str(error)]
    arm = Arm(panda.load(), panda.END_FRAME["panda_nohand"])
    server = LocalServer(0)
    told = []
    with tempfile.TemporaryDirectory() as folder, Sandbox() as sandbox:
        work = Path(folder) / day.script
        work.write_bytes(day.source.read_bytes())
        student = Student(day, arm, brought.ghost, sandbox, work)
        student.look()
        given = server, arm, "", brought, student, True
        page = on_loop(server, lambda: Inspector(*given))
        for kind in brought.tabs:
            on_loop(server, partial(page.open_tab, kind.title))
            on_loop(server, lambda: page.move(arm.q + 0.01))
            _settle(page, lambda call: on_loop(server, call))
            where = f"{shown(day.own / 'inspector.py')}, tab {kind.title}: "
            told += [where + line for line in _bad(page)]
    return told


def _settle(page: Any, on_loop: Callable[[Callable[[], None]], Any]) -> None:
    """Wait until an open tab has what it asked for."""
    deadline = time.monotonic() + SECONDS
    calm = 0
    while calm < CALM and time.monotonic() < deadline:
        time.sleep(0.05)
        on_loop(lambda: None)
        jobs = [one for one in page.page.running if hasattr(one, "next")]
        busy = page.scheduled or any(one.task for one in jobs)
        calm = 0 if busy else calm + 1


def _bad(page: Any) -> list[str]:
    """Return the lines of the panel that say that something stopped or is off."""
    told = []
    for widget in page.widgets().values():
        for line in _BAD.findall(getattr(widget, "content", "")):
            told.append(" ".join(html.unescape(line).split()))
    return told


if __name__ == "__main__":
    print(json.dumps(tab_faults(find_day(int(sys.argv[1])))), flush=True)
    os._exit(0)  # a tab's thread may still be at work
