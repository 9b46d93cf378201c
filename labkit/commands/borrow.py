"""Use the kit's function for a task in which you are stuck, so that you can continue.

    python3 scripts/borrow.py 3.3          (make borrow TASK=3.3)
    python3 scripts/borrow.py              the next open task (make borrow)
    python3 scripts/borrow.py --day 5      all open tasks of a day

Your file then calls the kit's function, with a comment. The task is not passed until
you write the function yourself: make start RESET=3.3 empties it again. A copy of your
old file is kept next to it.
"""

import sys

from labkit.base import cli
from labkit.commands.hint import check as open_tasks
from labkit.commands.start import require_begun
from labkit.lesson.backup import rewrite
from labkit.lesson.borrowed import with_borrowed
from labkit.lesson.day import Day, chosen_day, find_task
from labkit.lesson.lab_module import read_script
from labkit.lesson.starter import function_lines, require_kits
from robo47.errors import Robo47Error
from robo47.paths import shown


def borrow(task_id: str) -> int:
    """Put the kit's function in the place of the student's."""
    day, task = find_task(task_id)
    require_kits(day)
    text = read_script(day.work)
    gone = [name for name in task.functions if function_lines(text, name)[0] < 0]
    if gone:
        raise Robo47Error(
            f"{shown(day.work)} has no function {gone[0]}; put its gap back first: "
            f"make start RESET={task_id}"
        )
    text = with_borrowed(text, read_script(day.source), task.functions)
    kept = rewrite(day.work, text, task_id)
    names = " and ".join(task.functions)
    print(f"task {task_id} borrows {names} from the kit in {shown(day.work)}")
    print(f"your file as it was: {shown(kept)}")
    print(f"To give it back, write it yourself: make start RESET={task_id}")
    return cli.EXIT_OK


def borrow_open(day: Day, every: bool) -> int:
    """Borrow the next task that does not pass, or all of them after a yes.

    Args:
        day: whose tasks.
        every: all that is open.

    Raises:
        Robo47Error: the day was not begun, or its file cannot be judged.
    """
    require_begun(day)
    with cli.busy("checking your functions"):
        left, problem = open_tasks(day)
    if problem:
        raise Robo47Error(f"{problem} Fix that first; nothing was borrowed.")
    if not left:
        print(f"All tasks of day {day.number} pass: there is nothing to borrow.")
        return cli.EXIT_OK
    wanted = left if every else left[:1]
    if every and not _agreed([task.id for task in wanted]):
        print("Nothing was borrowed.")
        return cli.EXIT_OK
    for task in wanted:
        borrow(task.id)
    return cli.EXIT_OK


def _agreed(ids: list[str]) -> bool:
    """Ask once; without a keyboard to answer on it is a yes, since it was typed."""
    if not sys.stdin.isatty():
        return True
    return input(f"Borrow {', '.join(ids)}? [y/N] ").strip().lower() in ("y", "yes")


def main() -> int:
    """Borrow one task's functions, or what is open."""
    parser = cli.parser(__doc__)
    parser.add_argument("task", nargs="?", help="such as 3.3; default: the next")
    parser.add_argument("--day", type=cli.day, help="of a day all that is open")
    options = parser.parse_args()
    day = chosen_day(options.day, options.task)
    if options.task:
        return borrow(options.task)
    return borrow_open(day, every=options.day is not None)
