"""A day's starter, made of its complete lab: tasks taken out, and put back.

The complete script in `src/` is the only source. A task's lines stand between
`# region 1.4` and `# endregion 1.4`, below the docstring of the function they belong
to; a task may own several regions. The starter keeps everything else, and each gap
raises, naming its task: a placeholder such as the identity is a legal pose.
"""

import re
from dataclasses import dataclass, replace

from labkit.lesson.day import Day
from labkit.lesson.lab_module import read_script
from robo47.errors import Robo47Error
from robo47.paths import shown

_MARKER = re.compile(r"^(?P<indent>\s*)# (?P<end>end)?region\b\s*(?P<task>\S*)\s*$")
# The lines of a lab's docstring on how it runs, and those of its starter.
_RUN = re.compile(r"(?m)^    make day\d+ .*\n    python src/\S+ .*$")
_RUNS = """    make run DAY={0:<6} runs this file and logs your numbers
    make day{0:<10} runs the kit's complete lab"""
_DEF = re.compile(r"^def (?P<name>\w+)\(")


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
        definition, marker = _DEF.match(line), _MARKER.match(line)
        if definition and opened:
            why = f"region {opened.task} is still open at the next function"
        else:
            why = _misplaced(marker, function, opened) if marker else ""
        if why:
            raise Robo47Error(f"{name}, line {number + 1}: {why}")
        if definition:
            function = definition["name"]
        elif marker and opened:
            regions.append(replace(opened, end=number))
            opened = None
        elif marker:
            opened = Region(marker["task"], function, number, -1, marker["indent"])
    if opened:
        why = f"region {opened.task} is never closed"
        raise Robo47Error(f"{name}, line {opened.start + 1}: {why}")
    return regions


def _misplaced(marker: re.Match[str], function: str, opened: Region | None) -> str:
    """Return why a marker may not stand in a function or region that is open, or ""."""
    task = marker["task"]
    if not task:
        return "a region marker without the id of its task"
    if not marker["end"]:
        if opened:
            return f"region {task} opens inside region {opened.task}"
        inside = marker["indent"] and function
        return "" if inside else f"region {task} is not inside a function"
    if not opened:
        return f"endregion {task}, but no region is open"
    closes = f"endregion {task} closes region {opened.task}"
    return "" if opened.task == task else closes


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
        "# Yours to complete: write the body of each TODO. To test it:",
        f"#     make check DAY={day}        (make watch DAY={day} checks at each save)",
    ]
    return _RUN.sub(_RUNS.format(day), "\n".join(head + lines) + "\n", count=1)


def starter_of(day: Day) -> str:
    """Return the starter of a day's lab."""
    return make_starter(read_script(day.source), shown(day.source), day.number)


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


def is_kits(day: Day) -> bool:
    """Return whether `require_kits` lets a day's script in `src/` pass."""
    try:
        require_kits(day)
    except Robo47Error:
        return False
    return True


def require_kits(day: Day) -> None:
    """Refuse a script in `src/` that lacks the marks of a task of the manifest.

    The public course's own script has the same name and is saved over ours; what then
    runs is neither.
    """
    wanted = {(task.id, f) for task in day.tasks for f in task.functions}
    source = shown(day.source)
    text = ""
    fault = ""
    try:
        text = read_script(day.source)
        wanted -= {(r.task, r.function) for r in find_regions(text, source)}
        if wanted:
            fault = "{} has no region {} in {}".format(source, *min(wanted))
    except Robo47Error as error:  # gone, in another encoding, or with broken markers
        fault = str(error)
    if fault and "# region" in text:
        author = f"Do you write this day? make author DAY={day.number}"
        raise Robo47Error(f"{fault}. {author}. Else: make doctor")
    if fault:
        raise Robo47Error(
            f"{source} is not the kit's: the marks of its tasks are gone. "
            f"Yours belongs in {shown(day.work.parent)}/; to get the kit's back: "
            f"git checkout -- {source}"
        )
