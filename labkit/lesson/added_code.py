"""Code that the checker puts below a student's file before it is asked."""

import re
from collections.abc import Iterable
from itertools import chain

from labkit.lesson.day import Day, Task
from labkit.lesson.lab_module import read_script, without_kit
from labkit.lesson.starter import function_lines


def kits_functions(day: Day, tasks: Iterable[Task]) -> str:
    """Return code that puts functions of the complete lab below a file.

    The whole lab comes with it, so nothing that is answered then may pass.

    Args:
        day: whose complete lab it is; "" is returned where it is not there.
        tasks: whose functions.
    """
    names = [name for task in tasks for name in task.functions]
    if not names or not day.source.is_file():
        return ""
    text = without_kit(read_script(day.source))
    lines = [f"_kits = {{'__name__': 'kits_lab'}}; exec({text!r}, _kits)"]
    lines += [f"{name} = _kits[{name!r}]" for name in names]
    return "\n\n" + "\n".join(lines) + "\n"


def kits_own(day: Day, tasks: Iterable[Task]) -> str:
    """Return code that puts the functions below a file that it borrows.

    No other function of the kit comes with them: the file's own could call it and pass.

    Args:
        day: whose complete lab has them; "" is returned where it is not there.
        tasks: that the file borrows.
    """
    names = [name for task in tasks for name in task.functions]
    if not names or not day.source.is_file():
        return ""
    text = read_script(day.source)
    own = "\n".join(chain.from_iterable(function_lines(text, n)[2] for n in names))
    return f"\n\nexec({own!r}, globals())\n"


def old_names(day: Day, text: str) -> str:
    """Return code that gives functions the names that the manifest has for them now.

    Args:
        day: from its manifest.
        text: a student's file, begun with an older one.
    """
    there = set(re.findall(r"^def (\w+)\(", text, re.MULTILINE))
    names = [pair for task in day.tasks for pair in task.renamed]
    lines = [
        f"{now} = {was}" for was, now in names if was in there and now not in there
    ]
    return "\n\n" + "\n".join(lines) + "\n" if lines else ""
