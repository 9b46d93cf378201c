"""Turn a day's lab script into a notebook, for a headless machine or Colab.

    make notebook DAY=1                              write it
    python3 scripts/make_notebook.py --day 1         the same
    python3 scripts/make_notebook.py --check         only say if it is old
    make notebook DAY=1 ARGS=--starter               without answers, in work/

The script is the only source: its functions and the steps of its main() become
cells. What a notebook adds to them (pictures, sliders) is in dayN/notebook.toml.
It is yours: git does not keep it, and one that you edited is kept under another name.
"""

import json
import os
from itertools import count
from pathlib import Path

from labkit.base import cli
from labkit.lesson.day import Day, chosen_day
from labkit.lesson.notebook import build, digest
from labkit.lesson.week import NOTEBOOKS
from robo47.errors import Robo47Error
from robo47.paths import shown


def is_edited(path: Path) -> bool:
    """Return whether somebody has written in a notebook: a run alone is no edit."""
    try:
        found = json.loads(path.read_text("utf-8"))
        made = digest(cell["source"] for cell in found["cells"])
        return bool(found["metadata"].get("robo47") != made)
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return True


def put_aside(path: Path) -> Path:
    """Give a notebook a name beside itself that nothing has yet, and return it."""
    names = (path.with_suffix(f".before-{n}.ipynb") for n in count(1))
    free = next(name for name in names if not name.exists())
    return path.rename(free)


def notebook_of(day: Day) -> Path:
    """Return where a day's notebook is."""
    return day.folder / NOTEBOOKS / Path(day.script).with_suffix(".ipynb").name


def main() -> int:
    """Write a notebook, or check it."""
    parser = cli.parser(__doc__)
    parser.add_argument("--day", type=cli.day, help="default: the one worked on last")
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--check", action="store_true", help="write nothing")
    how.add_argument("--starter", action="store_true", help="without answers, in work/")
    options = parser.parse_args()
    day = chosen_day(options.day)
    starter = options.starter
    path = day.work.with_suffix(".ipynb") if starter else notebook_of(day)
    if starter and path.exists():
        raise Robo47Error(f"{shown(path)} is there already and stays as it is")
    if os.path.lexists(path) and not path.is_file():
        raise Robo47Error(
            f"{shown(path)} is no file: move it away, then the same again"
        )
    fresh = build(day, starter)
    if path.exists() and fresh == path.read_text("utf-8", "replace"):
        print(f"{shown(path)} is up to date")
        return cli.EXIT_OK
    if options.check:
        print(f"{shown(path)} is out of date: make notebook DAY={day.number}")
        return cli.EXIT_FAILED
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.exists() and is_edited(path):
        print(f"as you had it: {shown(put_aside(path))}")
    path.write_text(fresh, "utf-8", newline="\n")
    print(f"{shown(path)} written{'; the answers are yours to find' * starter}")
    if not starter:
        print("Open it with Jupyter or VS Code (kernel .venv).")
    return cli.EXIT_OK
