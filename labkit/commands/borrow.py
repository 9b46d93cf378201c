"""Borrow the kit's function of a task you are stuck on, so that you can go on.

    python3 scripts/borrow.py 3.3          (make borrow TASK=3.3)

Your file then calls the kit's function there, and says so. The task counts as
not passed until you write it yourself: make start RESET=3.3 puts its gap back.
Your file as it was is kept beside it.
"""

from labkit.base import cli
from labkit.commands.start import rewrite
from labkit.lesson.borrowed import with_borrowed
from labkit.lesson.day import chosen_day, find_task
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


def main() -> int:
    """Borrow one task's functions."""
    parser = cli.parser(__doc__)
    parser.add_argument("task", help="such as 3.3")
    parser.add_argument("--day", type=cli.day, help="default: the task's")
    options = parser.parse_args()
    chosen_day(options.day, options.task)
    return borrow(options.task)
