"""Work through a day in one loop: save, read the verdict, continue.

    make watch                     the day worked on last
    make watch DAY=4
    make watch TASK=4.5            one task alone

The command shows the next open task and its position in your file. At each save it
checks that task; when the task passes, it shows the next one. Then it checks all others
again, because a change may affect them, and shows them in brackets until the result is
known. When all functions are right, it lists what is left to hand in.

Keys: h hint, r run the lab, v view, b borrow, l list, c check all, q quit. Without a
keyboard (a pipe, an editor's window) it also watches; Ctrl-C ends it.
Exit code: 0 all passed, 1 something is left, 2 it could not run.
"""

import contextlib
import os
import re
import secrets
import subprocess
import sys
import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from labkit.base import cli
from labkit.base.keys import Keys
from labkit.commands.start import require_begun
from labkit.lesson.day import Day, Task, chosen_day, days_of
from labkit.lesson.starter import function_lines
from labkit.sandbox.process import Process
from robo47.errors import Robo47Error
from robo47.paths import METRICS_CSV, ROOT, shown

if TYPE_CHECKING:
    from labkit.check.report import Report

POLL_SECONDS = 0.15  # polling sees saves on WSL and network mounts, where events do not
BAR = 20  # places
KEY_SECONDS = 0.05  # to look for a key during the lab's run
LETTERS = "hrvblcq"
KEYS = "h hint  r run  v view  b borrow  l list  c check all  q quit"


class Loop:
    """A day that is being worked on.

    Attributes:
        states: how tasks stand, by id: "passed", "wrong", "to do" ...
        sure: whether that was asked of the file as it is.
    """

    def __init__(self, day: Day, only: str | None, file: Path | None = None) -> None:
        """Take the day as it was last checked.

        Args:
            day: from the manifest.
            only: one task's id, where the others do not matter.
            file: instead of the student's file in work/.
        """
        from labkit.check import memory

        self.day = day
        self.only = day.task(only) if only else None
        self.script = file or day.work
        self.states = {} if file else memory.task_states(day)
        self.sure = len(self.states) == len(day.tasks)
        self.warm: Process | None = Process()
        self.seen: dict[str, tuple[int, int]] = {}  # stamps of what is checked
        self.key = ""  # pressed during the lab's run

    def open(self) -> list[Task]:
        """Return the tasks that do not pass, those that count first."""
        asked = [self.only] if self.only else sorted(self.day.tasks, key=_optional)
        return [task for task in asked if self.states.get(task.id) != "passed"]

    def check(self, only: Task | None) -> bool:
        """Check one task and print what it says, or all; return whether they pass."""
        from labkit.check import memory
        from labkit.check.report import Report, as_text
        from labkit.check.tasks import check_tasks
        from labkit.sandbox.sandbox import Sandbox

        key = memory.key_of(self.day)
        warm, self.warm = self.warm, None
        with Sandbox(warm) as sandbox:
            id = only.id if only else None
            results = check_tasks(self.day, self.script, sandbox, id)
        self.warm = Process()  # it gets ready while the student types
        found = {result.task.id: memory.state_of(result.verdict) for result in results}
        if self.script == self.day.work:
            memory.note(results)
            memory.remember(key, results)
        self.states |= found
        if only:
            report = Report(self.day, results)
            print(_without_next(as_text(report, colour=cli.wants_colour(sys.stdout))))
        return all(state == "passed" for state in found.values())

    def interrupted(self, keys: Keys) -> bool:
        """Return whether a file was saved or a key pressed; keep the key."""
        key = keys.wait(KEY_SECONDS)
        self.key = self.key or (key if key and key in LETTERS else "")
        return bool(self.key) or stamps(self.day, self.script) != self.seen

    def close(self) -> None:
        """End the process that waits."""
        if self.warm:
            self.warm.close()

    def far(self) -> str:
        """Return how far the day and the week are, in a line each."""
        tasks = [task for task in self.day.tasks if not task.optional]
        passed = sum(self.states.get(task.id) == "passed" for task in tasks)
        day = f"Day {self.day.number}"
        lines = [_bar(day, passed, len(tasks))]
        in_week = [passed, len(tasks)]
        for other in days_of(self.day.week):
            if other.number != self.day.number:
                for i, count in enumerate(_counted(other)):
                    in_week[i] += count
        lines.append(_bar(f"Week {self.day.week.number}", *in_week))
        if not self.sure:
            lines.append("  (some as they were before your last save)")
        return "\n".join(lines)

    def listed(self) -> str:
        """Return a line per task: its name and how it stands."""
        lines = []
        wide = max(len(task.id) for task in self.day.tasks)
        for task in self.day.tasks:
            state = self.states.get(task.id, "not asked yet")
            state = state if self.sure else f"({state})"
            side = " (side quest)" if task.optional else ""
            lines.append(
                f"  {task.id:{wide}}  {', '.join(task.functions) + side:40} {state}"
            )
        return "\n".join(lines)

    def shown(self, task: Task) -> str:
        """Return a task: its name, where it stands, and what it is to return."""
        text = self.script.read_text("utf-8", errors="replace")
        lines = [f"Next: {task.id}  {task.title}"]
        for name in task.functions:
            at, _, body = function_lines(text, name)
            where = f"{shown(self.script)}:{at + 1}" if at >= 0 else "not in your file"
            lines.append(f"  {name}  {where}")
            if said := re.search(r'"""(.+?)("""|$)', "\n".join(body), re.MULTILINE):
                lines.append(cli.wrapped(f"    {said[1]}", "    "))
        lines.append(cli.wrapped(f"  Read: {task.read}", "  "))
        return "\n".join(lines)


def watch(day: Day, only: str | None, file: Path | None = None) -> int:
    """Check at every save until everything passes, somebody quits or Ctrl-C.

    Args:
        day, only, file: as `Loop` takes them.
    """
    loop = Loop(day, only, file)
    with contextlib.closing(loop), Keys() as keys:
        seen = stamps(day, loop.script)
        first = True
        clear = True
        while True:
            if first or (now := stamps(day, loop.script)) != seen:
                seen = seen if first else now
                first = False
                loop.seen = seen
                if _saved(loop, keys, clear=clear):
                    return cli.EXIT_OK
                clear = True
                seen_again = stamps(day, loop.script)
                if seen_again != seen:
                    continue
            key, loop.key = loop.key or keys.wait(POLL_SECONDS), ""
            if key == "q":
                return cli.EXIT_FAILED if loop.open() else cli.EXIT_OK
            if key:
                pressed(key, loop, keys)
                # A cleared screen would lose the output of the key.
                clear = stamps(day, loop.script) == seen


def _saved(loop: Loop, keys: Keys, *, clear: bool = True) -> bool:
    """Ask what is next, then the rest; return whether all is done."""
    if clear:
        _clear()
    loop.sure = False
    print(f"Day {loop.day.number}: {loop.day.title}", flush=True)
    try:
        done = _go_on(loop, keys)
        if not done and not loop.only and not loop.sure:
            # A terminal shows this while the tasks run.
            with cli.busy("asking the others again"):
                loop.check(None)
            loop.sure = True
    except Robo47Error as error:  # a file may be away while an editor saves it
        cli.complain(f"error: {error}")
        return False
    if done:
        return True
    if left := loop.open():
        quest = left[0].optional and not loop.only
        if not quest:  # the end of the day has said it already
            print(f"\n{loop.far()}")
        print(f"\n{'A side quest is left. ' if quest else ''}{loop.shown(left[0])}")
    asked = KEYS if keys.there else "Ctrl-C ends it"
    print(f"\n{time.strftime('%H:%M:%S')}  watching; {asked}\n", flush=True)
    return False


def _go_on(loop: Loop, keys: Keys) -> bool:
    """Check the next open task, where it passes the one after; say if all is done."""
    tried: set[str] = set()
    while left := [task for task in loop.open() if task.id not in tried]:
        task = left[0]
        tried.add(task.id)
        print(flush=True)
        if not loop.check(task):
            return False
        if loop.only:
            return True
    return _whole_day(loop, keys)


def _whole_day(loop: Loop, keys: Keys) -> bool:
    """Check the whole day, lab and handing in; return whether it passes.

    A save or a key ends the run of the lab.
    """
    from labkit.check import memory
    from labkit.check.once import check_once
    from labkit.check.report import as_text
    from labkit.check.slow import StoppedEarly

    key = " or a key" if keys.there else ""
    print(f"\nChecking the whole day. A save{key} ends the lab's run.", flush=True)
    stop = partial(loop.interrupted, keys)
    try:
        seed = secrets.randbits(32)
        report = check_once(loop.day, loop.script, None, seed, stop)
    except StoppedEarly:
        again = f"make check DAY={loop.day.number}{' (c)' if keys.there else ''}"
        print(f"\nThe lab's run was ended early. To run it: {again}", flush=True)
        asked = [task.id for task in loop.day.tasks if not task.optional]
        loop.states |= dict.fromkeys(asked, "passed")  # else the lab does not run
        loop.sure = True
        return False
    for result in report.tasks:
        loop.states[result.task.id] = memory.state_of(result.verdict)
    loop.sure = True
    wrong = any(result in report.left for result in report.counted)
    if wrong or any(item.status == "wrong" for item in report.items):
        text = as_text(report, colour=cli.wants_colour(sys.stdout))
        print(f"\n{text}")
    else:
        print(f"\n{_finish(loop, report)}", flush=True)
    return report.passed


def _finish(loop: Loop, report: "Report") -> str:
    """Return what is said when all functions of a day are right, in a few lines."""
    day = loop.day.number
    count = f"{len(report.counted)} of {len(report.counted)} tasks pass."
    right = cli.paint(f"Day {day}: all your functions are right. {count}", "good")
    lines = [right, loop.far(), ""]
    lines += [f"See what they do: make view DAY={day} (key v)."]
    left = [item.name for item in report.items if not item.passed]
    if left:
        lines.append(f"Left to hand in: {', '.join(left)}.")
        says = f"make run DAY={day} (r) logs your numbers; make check DAY={day} (c) "
        lines.append(says + "says what is missing.")
    else:
        lines.append(f"Next: {report.next_step()}")
    return "\n".join(map(cli.wrapped, lines))


def pressed(key: str, loop: Loop, keys: Keys) -> None:
    """Do what a key stands for."""
    left = loop.open()
    task = left[0].id if left else ""
    day = str(loop.day.number)
    commands = {
        "h": ["hint.py", task or "--day", *([] if task else [day])],
        "r": ["run_day.py", day],
        "v": ["view_panda.py", day],
        "b": ["borrow.py", task],
        "c": ["check_day.py", day],
    }
    if key == "l":
        print(f"{loop.far()}\n\n{loop.listed()}\n", flush=True)
    elif key in commands and (key != "b" or task):
        print(f"make {_verb(key, day, task)}\n", flush=True)
        _run(keys, commands[key], view=key == "v")
        print(f"\n{KEYS}\n", flush=True)
    else:
        print(KEYS, flush=True)


def _verb(key: str, day: str, task: str) -> str:
    """Return what a key's command is called where one types it."""
    words = {"h": "hint", "r": "run", "v": "view", "b": "borrow", "c": "check"}
    return f"{words[key]} " + (f"TASK={task}" if key in "hb" and task else f"DAY={day}")


def _run(keys: Keys, command: list[str], *, view: bool) -> None:
    """Run one of the kit's scripts, with the terminal for itself; Ctrl-C ends it."""
    scripts = ROOT / "scripts"
    name, *rest = command
    with keys.away(), contextlib.suppress(KeyboardInterrupt):
        if view:
            subprocess.run([sys.executable, scripts / "setup_env.py", "view"])
        subprocess.run([sys.executable, scripts / name, *rest], check=False)


def stamps(day: Day, script: Path) -> dict[str, tuple[int, int]]:
    """Return time and size of every file whose change calls for a new check."""
    week = day.folder
    files = {script, week / day.figure, week / day.worksheet, METRICS_CSV}
    files |= {*script.parent.glob("*.py"), ROOT / ".git" / "index"}
    found = {}
    for path in files:
        with contextlib.suppress(OSError):
            status = path.stat()
            found[str(path)] = (status.st_mtime_ns, status.st_size)
    return found


def _counted(day: Day) -> Iterator[int]:
    """Yield how many tasks of another day are known to pass, and how many there are."""
    from labkit.check import memory

    tasks = [task for task in day.tasks if not task.optional]
    states = memory.task_states(day)
    yield sum(states.get(task.id) == "passed" for task in tasks)
    yield len(tasks)


def _bar(name: str, passed: int, count: int) -> str:
    full = BAR * passed // count if count else 0
    bar = cli.paint("#" * full, "good") + "." * (BAR - full)
    return f"  {name:8} [{bar}] {passed} of {count} tasks"


def _without_next(text: str) -> str:
    """Return a check's text without head and end: the loop has its own."""
    return "\n\n".join(text.split("\n\n")[1:-1])


def _optional(task: Task) -> bool:
    return task.optional


def _clear() -> None:
    if sys.stdout.isatty() and os.environ.get("TERM") != "dumb":
        print("\x1b[2J\x1b[H", end="")


def main() -> int:
    """Watch a day."""
    os.environ.setdefault("MUJOCO_GL", "disable")  # nothing is drawn: no window library
    parser = cli.parser(__doc__)
    parser.add_argument(
        "day", type=cli.day, nargs="?", help="default: the one worked on last"
    )
    parser.add_argument("--task", help="this task alone, such as 1.4")
    options = parser.parse_args()
    day = chosen_day(options.day, options.task)
    require_begun(day)
    return watch(day, options.task)
