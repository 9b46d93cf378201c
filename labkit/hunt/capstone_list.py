"""The list of mistakes that a week's capstone shows: its file `hunts.txt`.

A trial takes a second or more, and a hunt must begin at once. Therefore
`labkit.hunt.capstone_trials` tries all mistakes and writes the file: each line names a
function and a mistake.
"""

from collections.abc import Iterable
from pathlib import Path

from labkit.base import store
from labkit.lesson.week import Week

HEAD = """\
# Which mistakes the capstone shows, for `make hunt LEVEL=2`: its numbers change, or it
# stops in words that do not name the function. Written by a run, not by hand:
# python scripts/hunt_bug.py {day} --write-seen
"""


def file_of(week: Week) -> Path:
    """Return the path of a week's list."""
    return week.folder / "hunts.txt"


def visible_mistakes(week: Week) -> set[tuple[str, str]]:
    """Return (function, mistake) for all mistakes that a week's capstone shows."""
    path = file_of(week)
    lines = path.read_text("utf-8").splitlines() if path.is_file() else []
    pairs = [line.split() for line in lines if line and line[0] != "#"]
    return {(pair[0], pair[1]) for pair in pairs if len(pair) == 2}


def write(week: Week, found: Iterable[tuple[str, str]]) -> None:
    """Replace a week's list."""
    lines = sorted({" ".join(pair) for pair in found})
    text = HEAD.format(day=week.days[-1]) + "\n".join(lines) + "\n"
    store.replace(file_of(week), text.encode())
