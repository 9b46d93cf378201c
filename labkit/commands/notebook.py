"""Write a day as a notebook: guide, checks, and a cell for each of your functions.

    make notebook DAY=3                        w1-foundations/work/day3.ipynb
    python3 scripts/make_notebook.py --day 3   the same
    make notebook DAY=3 ARGS=--complete        with the kit's functions
    python3 scripts/make_notebook.py --all --out FOLDER --repository ADDRESS
                                               all days, to open from the web

Open it with JupyterLab or VS Code (kernel .venv). A notebook that is there already
keeps everything that you wrote. If you edited a function in the lab's file since, its
cell shows the new text; a function that you edited in both is named and stays as it is.
"""

import json
from pathlib import Path

from labkit.base import cli, store
from labkit.lesson.day import Day, all_days, chosen_day
from labkit.lesson.week import NOTEBOOKS
from labkit.notebook import sync
from labkit.notebook.build import build
from robo47.errors import Robo47Error
from robo47.paths import shown


def write(day: Day, path: Path, text: str) -> None:
    """Write a notebook's text, and say so."""
    if path.exists() and not path.is_file():
        raise Robo47Error(
            f"{shown(path)} is no file: move it away, then the same again"
        )
    path.parent.mkdir(parents=True, exist_ok=True)
    store.replace(path, text.encode())
    print(cli.wrapped(f"{shown(path)} written: Day {day.number}, {day.title}", "  "))


def renew(day: Day) -> None:
    """Show in a student's notebook what they edited in the lab's file since."""
    path = day.notebook
    try:
        found = json.loads(path.read_text("utf-8"))
        renewed = sync.with_newer(day, found)
    except (OSError, ValueError, LookupError, TypeError, RecursionError):
        raise Robo47Error(
            f"{shown(path)} is there, and it is no notebook: move it away, then the "
            "same again"
        ) from None
    there = f"{shown(path)} is there already and keeps what you wrote."
    print(cli.wrapped(there, "  "))
    if renewed:
        store.replace(
            path, (json.dumps(found, indent=1, ensure_ascii=False) + "\n").encode()
        )
        says = f"Renewed from {shown(day.work)}: {', '.join(renewed)}."
        print(cli.wrapped(says, "  "))


def main() -> int:
    """Write a notebook, or those of all days."""
    parser = cli.parser(__doc__)
    parser.add_argument("--day", type=cli.day, help="default: the one worked on last")
    parser.add_argument("--complete", action="store_true", help="with all functions")
    parser.add_argument("--all", action="store_true", help="every day; needs --out")
    parser.add_argument("--out", type=Path, help="folder to write to")
    parser.add_argument("--repository", default="", help="where others get the kit")
    options = parser.parse_args()
    if options.all and not options.out:
        parser.error("--all needs --out: the folder to write to")
    if options.all:
        for day in all_days():
            made = build(day, fresh=True, repository=options.repository)
            write(day, options.out / day.notebook.name, made)
        return cli.EXIT_OK
    day = chosen_day(options.day)
    if options.complete:
        folder = options.out or day.folder / NOTEBOOKS
        write(day, folder / day.notebook.name, build(day, complete=True))
    elif options.out:
        made = build(day, repository=options.repository)
        write(day, options.out / day.notebook.name, made)
    elif day.notebook.exists():
        renew(day)
    else:
        write(day, day.notebook, build(day))
        sync.remember(day)
        print("Open it with JupyterLab or VS Code (kernel .venv).")
    return cli.EXIT_OK
