"""Whether a lab script in `src/` is still the kit's.

The public course's own script has the same name and is saved over ours; what then runs
is neither. The markers of the tasks tell the two apart, with or without git.
"""

from labkit.lesson.day import Day
from labkit.lesson.script import find_regions, read_script
from robo47.errors import Robo47Error
from robo47.paths import shown


def is_kits(day: Day) -> bool:
    """Return whether a day's script in `src/` holds every task of the manifest."""
    try:
        return not _lacking(day)
    except Robo47Error:  # gone, in another encoding, or with broken markers
        return False


def _lacking(day: Day) -> set[tuple[str, str]]:
    """Return the task and the function of each region that a script lacks."""
    regions = find_regions(read_script(day.source), shown(day.source))
    wanted = {(task.id, f) for task in day.tasks for f in task.functions}
    return wanted - {(region.task, region.function) for region in regions}


def _fault(day: Day) -> str:
    """Return what is wrong with the marks of a script that has some, else ""."""
    try:
        if "# region" not in read_script(day.source):
            return ""
    except Robo47Error:
        return ""
    try:
        task, function = min(_lacking(day))
    except Robo47Error as error:
        return str(error)
    return f"{shown(day.source)} has no region {task} in {function}"


def require_kits(day: Day) -> None:
    """Refuse a script in `src/` that lacks the marks of the kit's own."""
    if not is_kits(day):
        if fault := _fault(day):
            author = f"Do you write this day? make author DAY={day.number}"
            raise Robo47Error(f"{fault}. {author}. Else: make doctor")
        raise Robo47Error(
            f"{shown(day.source)} is not the kit's: the marks of its tasks are gone. "
            f"Yours belongs in {shown(day.work.parent)}/; to get the kit's back: "
            f"git checkout -- {shown(day.source)}"
        )
