"""The starter of a day: its lab script with the bodies of the tasks taken out.

The complete script in `src/` is the only source. A task's lines stand between
`# region 1.4` and `# endregion 1.4`, below the docstring of the function they belong
to; a task may own several regions. The starter keeps everything else, and each gap
raises, naming its task: a placeholder such as the identity is a legal pose.
"""

import re
from dataclasses import dataclass
from pathlib import Path

from labkit.lesson.day import Day, Task
from labkit.lesson.sealed import opened
from robo47.errors import Robo47Error
from robo47.paths import shown

_MARKER = re.compile(r"^(?P<indent>\s*)# (?P<end>end)?region\b\s*(?P<task>\S*)\s*$")
_DEF = re.compile(r"^def (?P<name>\w+)\(")
BORROWED = "# borrowed from the kit"  # in a function that is not the student's own


@dataclass(frozen=True)
class Region:
    """One stretch of a solution."""

    task: str  # its id, such as "1.4"
    function: str  # the function it stands in
    start: int  # index of the marker's line, counted from 0
    end: int  # index of the end marker's line
    indent: str  # the white space before the marker


def find_regions(text: str, name: str) -> list[Region]:
    """Return the regions of a complete script, in order.

    Raises:
        Robo47Error: a region that is nested, unclosed, closed without being open,
            closed under another name, without an id, or outside a function.
    """
    regions: list[Region] = []
    function, opened = "", None
    for number, line in enumerate(text.splitlines()):

        def refuse(why: str, number: int = number) -> Robo47Error:
            return Robo47Error(f"{name}, line {number + 1}: {why}")

        if definition := _DEF.match(line):
            if opened:
                raise refuse(f"region {opened[0]} is still open at the next function")
            function = definition["name"]
        if not (marker := _MARKER.match(line)):
            continue
        task = marker["task"]
        if not task:
            raise refuse("a region marker without the id of its task")
        if not marker["end"]:
            if opened:
                raise refuse(f"region {task} opens inside region {opened[0]}")
            if not marker["indent"] or not function:
                raise refuse(f"region {task} is not inside a function")
            opened = (task, number, marker["indent"])
        elif not opened:
            raise refuse(f"endregion {task}, but no region is open")
        elif opened[0] != task:
            raise refuse(f"endregion {task} closes region {opened[0]}")
        else:
            regions.append(Region(task, function, opened[1], number, opened[2]))
            opened = None
    if opened:
        raise Robo47Error(
            f"{name}, line {opened[1] + 1}: region {opened[0]} is never closed"
        )
    return regions


def make_starter(text: str, name: str, day: int) -> str:
    """Return the script with each region replaced by a TODO and a raise.

    Args:
        text: the complete script.
        name: what to call it in an error.
        day: number of the day, for the commands in the first lines.
    """
    lines = text.splitlines()
    for region in reversed(find_regions(text, name)):
        size = region.end - region.start - 1
        about = f"about {size} line{'s' if size > 1 else ''}"
        lines[region.start : region.end + 1] = [
            f"{region.indent}# TODO {region.task}: {about}. Stuck? make hint "
            f"TASK={region.task}",
            f"{region.indent}raise NotImplementedError("
            f'"task {region.task}: write {region.function}")',
        ]
    head = [
        "# Yours to complete: write the body of each TODO. How it stands:",
        f"#     make check DAY={day}        (add ARGS=--watch to check at every save)",
    ]
    return "\n".join(head + lines) + "\n"


def solution(text: str, name: str, task: str) -> str:
    """Return the complete functions that a task asks for, without markers."""
    wanted = [r.function for r in find_regions(text, name) if r.task == task]
    bodies = ["\n".join(function_lines(text, function)[2]) for function in wanted]
    kept = [ln for ln in "\n\n".join(bodies).splitlines() if not _MARKER.match(ln)]
    return "\n".join(kept)


def function_lines(text: str, function: str) -> tuple[int, int, list[str]]:
    """Return where a top-level function stands, even in a file that does not parse.

    Returns:
        First line's index, index past the last, and the lines; (-1, -1, []) if absent.
    """
    lines = text.splitlines()
    for start, line in enumerate(lines):
        found = _DEF.match(line)
        if not found or found["name"] != function:
            continue
        end = start + 1
        # Indented, blank, or the closing bracket of a signature of several lines.
        while end < len(lines) and re.match(r"\s|$|\)", lines[end]):
            end += 1
        while not lines[end - 1].strip():
            end -= 1
        return start, end, lines[start:end]
    return -1, -1, []


def put_back(text: str, starter: str, functions: tuple[str, ...]) -> str:
    """Return a student's script with some functions as the starter has them.

    One that is gone is put above `main`.
    """
    for function in functions:
        gap = function_lines(starter, function)[2]
        start, end, _ = function_lines(text, function)
        lines = text.splitlines()
        if start < 0:
            start = end = max(function_lines(text, "main")[0], 0) or len(lines)
            gap = [*gap, "", ""]
        lines[start:end] = gap
        text = "\n".join(lines) + "\n"
    return text


def borrowed_tasks(day: Day, text: str) -> list[Task]:
    """Return the tasks of which a student's file borrows a function."""
    if BORROWED not in text:
        return []

    def borrows(function: str) -> bool:
        return BORROWED in "\n".join(function_lines(text, function)[2])

    return [task for task in day.tasks if any(map(borrows, task.functions))]


def read_script(path: Path) -> str:
    """Return a script's text in UTF-8, of a sealed one the complete lab's."""
    try:
        return opened(path.read_text("utf-8-sig"))
    except FileNotFoundError:
        raise Robo47Error(f"{shown(path)} is not there") from None
    except UnicodeDecodeError:
        raise Robo47Error(f"{shown(path)} is not in UTF-8: save it as such") from None
    except OSError as error:
        raise Robo47Error(f"{shown(path)} cannot be read: {error.strerror}") from None
