"""Print the next hint for a task, or the solution to compare once yours passes.

    python3 scripts/hint.py 1.4          (make hint TASK=1.4)
    python3 scripts/hint.py 1.4 --again  the last one again
    python3 scripts/hint.py              for the first open task
    python3 scripts/hint.py figure       what the figure lacks

Each call prints one more hint and the section to read again. The folder .robo47/, which
git ignores, remembers the hints that you have seen.
"""

from labkit.base import cli, store
from labkit.lesson.day import Day, Task, chosen_day
from labkit.lesson.lab_module import read_script
from labkit.lesson.sealed import is_sealed
from labkit.lesson.starter import solution
from labkit.sandbox.sandbox import Sandbox
from robo47.errors import Robo47Error
from robo47.paths import shown


def check(day: Day, task: Task | None = None) -> tuple[list[Task], str]:
    """Return the tasks that do not pass, of one or of all, and why none was judged."""
    if not day.work.is_file():
        return [task] if task else list(day.tasks), ""
    with Sandbox() as sandbox:
        from labkit.check.report import Report
        from labkit.check.tasks import check_tasks

        results = check_tasks(day, day.work, sandbox, task.id if task else None)
    left = [result.task for result in results if not result.passed]
    return left, Report(day, results).problem


def show_deliverable(day: Day, name: str) -> int:
    """Print what is left to do for something to hand in.

    Raises:
        Robo47Error: the day has nothing of that name.
    """
    from labkit.handin.deliverables import check_deliverables

    done = all(task.optional for task in check(day, None)[0])
    items = {item.name: item for item in check_deliverables(day, tasks_pass=done)}
    if name not in items:
        raise Robo47Error(
            f"{name!r} is no task; expected an id such as 1.4, or one of "
            f"{', '.join(items)}"
        )
    print(f"{name}\n")
    for line in (items[name].message or "Nothing is left to do for it.").splitlines():
        print(cli.wrapped(line))
    return cli.EXIT_OK


def show_hint(task: Task, again: bool) -> None:
    """Print the next hint, or the last one again."""
    seen = store.hints_given()
    count = min(seen.get(task.id, 0) + (not again), len(task.hints))
    seen[task.id] = count = max(count, 1)
    store.write("hints.json", seen)
    print(cli.wrapped(f"{task.id}  {task.title}: hint {count} of {len(task.hints)}"))
    print(f"\n{cli.wrapped(task.hints[count - 1])}")
    print(f"\n{cli.wrapped('Re-read: ' + task.read, '    ')}")
    if count == len(task.hints):
        last = "This is the last hint. If you are still stuck, explain the task aloud "
        last += f"to another person, or use the kit's: make borrow TASK={task.id}"
        print(cli.wrapped(last))


def show_solution(day: Day, task: Task) -> None:
    """Print the kit's own lines, to compare with the student's."""
    print(f"{task.id}  {task.title}")
    if is_sealed(day.source.read_text("utf-8")):
        print("Yours passes. This edition does not show the kit's own.")
        return
    print("Yours passes. The kit's, to compare:\n")
    print(solution(read_script(day.source), shown(day.source), task.id))


def main() -> int:
    """Give the next hint."""
    parser = cli.parser(__doc__)
    parser.add_argument(
        "task", nargs="?", help="such as 1.4, or figure; default: the next task"
    )
    parser.add_argument("--day", type=cli.day, help="default: the one worked on last")
    parser.add_argument("--again", action="store_true", help="the last hint again")
    options = parser.parse_args()
    if options.task and not options.task[0].isdecimal():
        return show_deliverable(chosen_day(options.day), options.task)
    day = chosen_day(options.day, options.task)
    wanted = day.task(options.task) if options.task else None
    if wanted and wanted.id != options.task:
        print(f"There is no {options.task} any more: it is {wanted.id} now.\n")
    left, problem = check(day, wanted)
    if problem:
        print(cli.wrapped(problem))
        print("\nFix that first: until then no task can be judged.")
        return cli.EXIT_FAILED
    if left:
        show_hint(left[0], options.again)
    elif wanted:
        show_solution(day, wanted)
    else:
        print(f"All {len(day.tasks)} tasks of day {day.number} pass.")
        if not is_sealed(day.source.read_text("utf-8")):
            print(f"The kit's own, to compare: make hint TASK={day.tasks[0].id}, ...")
    return cli.EXIT_OK
