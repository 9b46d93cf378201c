"""Start a day: write your copy of its lab script, with the tasks left for you to do.

    python scripts/start_day.py 1                 (make start DAY=1)
    python scripts/start_day.py 1 --reset 1.4     put one task's gap back
                                                  (make start RESET=1.4)

A file that is there is never overwritten, and a reset keeps your old text beside it.
"""

import argparse
from pathlib import Path

import kit  # noqa: F401 (goes on in the kit's own Python)

from robo47 import cli
from robo47.paths import shown
from robo47.lesson.starter import make_starter, put_back, read_script
from robo47.lesson.day import Day, find_day, find_task


def starter_of(day: Day) -> str:
    """Return the starter of a day's lab script."""
    return make_starter(read_script(day.source), shown(day.source), day.number)


def start(day: Day) -> int:
    """Write the starter, unless the student's file is there."""
    work = day.work
    work.parent.mkdir(parents=True, exist_ok=True)
    try:
        with work.open("x", encoding="utf-8") as file:
            file.write(starter_of(day))
    except FileExistsError:
        print(f"{shown(work)} is there already and stays as it is.")
        print("To begin one task anew: make start RESET=1.4 (with its number)")
        return cli.EXIT_OK
    first = day.tasks[0]
    print(f"Day {day.number}: {day.title}, about {day.minutes} minutes.")
    print(f"Your copy of the lab: {shown(work)}")
    print(f"It has {len(day.tasks)} tasks, from {first.id} ({first.functions[0]}) on.")
    print(f"Open it in your editor, then: make check DAY={day.number}")
    return cli.EXIT_OK


def reset(task_id: str) -> int:
    """Put one task's gaps back; keep what stood there."""
    day, task = find_task(task_id)
    work = day.work
    text = read_script(work)
    kept = free_name(work, task_id)
    kept.write_text(text, "utf-8")
    work.write_text(put_back(text, starter_of(day), task.functions), "utf-8")
    print(f"task {task_id} is back at its start in {shown(work)}")
    print(f"your file as it was: {shown(kept)}")
    return cli.EXIT_OK


def free_name(work: Path, task_id: str) -> Path:
    """Return a name beside the student's file that nothing has yet."""
    number = 1
    while (path := work.with_suffix(f".before-{task_id}-{number}.txt")).exists():
        number += 1
    return path


def main() -> int:
    """Start a day or reset a task."""
    about, usage = (__doc__ or "").split("\n", 1)
    parser = argparse.ArgumentParser(
        description=about,
        epilog=usage,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("day", type=int, nargs="?", default=1, help="default: 1")
    parser.add_argument("--reset", metavar="TASK", help="such as 1.4")
    options = parser.parse_args()
    return reset(options.reset) if options.reset else start(find_day(options.day))


if __name__ == "__main__":
    cli.run(main)
