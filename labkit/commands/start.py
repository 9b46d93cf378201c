"""Start a day: write your copy of its lab script, with empty functions.

    python3 scripts/start_day.py 1                 (make start DAY=1)
    python3 scripts/start_day.py 1 --reset 1.4     empty one task again
                                                  (make start RESET=1.4)

An existing file is never overwritten, and a reset keeps your old text next to it.
"""

from pathlib import Path

from labkit.base import cli, store
from labkit.base.git import GitError
from labkit.handin.whereabouts import whereabouts
from labkit.lesson import clash, last_day
from labkit.lesson.backup import rewrite
from labkit.lesson.day import Day, chosen_day, find_task
from labkit.lesson.lab_module import read_script
from labkit.lesson.starter import put_back, require_kits, starter_of
from labkit.notebook.sync import bring_saved
from robo47.errors import Robo47Error
from robo47.paths import shown


def start(day: Day) -> int:
    """Write the starter, unless the student's file is there."""
    work = day.work
    first = day.tasks[0]
    require_kits(day)
    starter = starter_of(day)
    work.parent.mkdir(parents=True, exist_ok=True)
    copy_kit(day)
    if work.exists():
        print(f"{shown(work)} is there already and stays as it is.")
        print(f"To reset one task: make start RESET={first.id} (with its number);")
        print(f"all of it: move that file away, then make start DAY={day.number}")
        return cli.EXIT_OK
    store.replace(work, starter.encode())
    print(f"Day {day.number}: {day.title}, about {day.minutes} minutes.")
    print(f"Your copy of the lab: {shown(work)}")
    print(f"It has {len(day.tasks)} tasks, from {first.id} ({first.functions[0]}) on.")
    print(f"Open it in your editor, then: make watch (or make check DAY={day.number})")
    return cli.EXIT_OK


def require_begun(day: Day) -> None:
    """Refuse a day without a file, or with an empty one; a lost kit.py comes back.

    A file beside it that has a module's name is told.
    """
    start = f"make start DAY={day.number}"
    for line in bring_saved(day).sentences(day):
        print(cli.wrapped(line))
    if not day.work.is_file():
        clone = day.folder.parent
        old = day.named_as(lambda name: (clone / name).is_file()).work
        if old != day.work:
            says = f"the lab {old.name} is called {day.script} now"
            raise Robo47Error(f"{says}; to bring yours over: make update")
        if where := _elsewhere(day, clone):
            raise Robo47Error(f"{shown(day.work)} is not there. {where}")
        raise Robo47Error(f"{shown(day.work)} is not there; first: {start}")
    if not day.work.read_bytes().strip():
        raise Robo47Error(f"{shown(day.work)} is empty. Delete it, then: {start}")
    copy_kit(day)
    clash.tell(day.work.parent)


def _elsewhere(day: Day, clone: Path) -> str:
    """Return a sentence on where a student's file is; "" where nobody knows."""
    try:
        return whereabouts(day, clone)
    except (GitError, OSError):
        return ""


def copy_kit(day: Day) -> None:
    """Put the kit's files beside the student's.

    `kit.py` lets any Python run the lab, `Makefile` takes the commands in there too.
    """
    for original in (day.source.with_name("kit.py"), day.folder / "Makefile"):
        copy = day.work.with_name(original.name)
        if original.is_file() and not copy.exists():
            store.replace(copy, original.read_bytes())


def reset(task_id: str) -> int:
    """Put one task's gaps back; keep what stood there."""
    day, task = find_task(task_id)
    work = day.work
    require_kits(day)
    text = read_script(work)
    require_begun(day)
    kept = rewrite(work, put_back(text, starter_of(day), task.functions), task_id)
    print(f"task {task_id} is back at its start in {shown(work)}")
    print(f"your file as it was: {shown(kept)}")
    return cli.EXIT_OK


def main() -> int:
    """Start a day or reset a task."""
    parser = cli.parser(__doc__)
    parser.add_argument(
        "day", type=cli.day, nargs="?", help="default: the one worked on last"
    )
    parser.add_argument("--reset", metavar="TASK", help="such as 1.4")
    options = parser.parse_args()
    if options.reset:
        chosen_day(options.day, options.reset)
        return reset(options.reset)
    day = chosen_day(options.day)
    last_day.remember(day.number)
    return start(day)
