"""Whether a lab script in `src/` is still the kit's.

The public course's own script has the same name and is saved over ours; what then runs
is neither. The markers of the tasks tell the two apart, with or without git.
"""

from labkit.lesson.day import Day
from labkit.lesson.starter import find_regions, read_script
from robo47.errors import Robo47Error
from robo47.paths import shown


def is_kits(day: Day) -> bool:
    """Return whether a day's script in `src/` holds every task of the manifest."""
    try:
        text = read_script(day.source)
        found = {(r.task, r.function) for r in find_regions(text, day.script)}
    except Robo47Error:  # gone, in another encoding, or with broken markers
        return False
    return found >= {(task.id, f) for task in day.tasks for f in task.functions}


def require_kits(day: Day) -> None:
    """Refuse a script in `src/` that is not the kit's.

    Raises:
        Robo47Error: it lacks the markers of the tasks; says how to get ours back.
    """
    if not is_kits(day):
        raise Robo47Error(
            f"{shown(day.source)} is not the kit's: the marks of its tasks are gone. "
            f"Yours belongs into {shown(day.work.parent)}/; to get the kit's back: "
            f"git checkout -- {shown(day.source)}"
        )
