"""Borrowed functions: the kit's own in a student's file, so that they can go on.

A borrowed task is marked in the file and counts as not passed; writing the function
gives it back.
"""

import ast
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from typing import Any

from labkit.lesson.day import Day, Task, day_of
from labkit.lesson.lab_module import lab_of
from labkit.lesson.starter import function_lines, put_back
from robo47.errors import Robo47Error
from robo47.paths import shown

BORROWED = "# borrowed from the kit"  # this comment marks a function of the kit


@cache  # a lab's borrowed function asks at every call, thousands of times
def kits(file: str, function: str) -> Callable[..., Any]:
    """Return the kit's own function; a borrowed one in a student's file calls it.

    Args:
        file: the student's, `__file__`; its name says which day it is.
        function: its name.
    """
    day = day_of(Path(file))
    if not day.source.is_file():
        raise Robo47Error(
            f"{shown(day.source)} is not here, so {function} cannot be borrowed from it"
        )
    found: Callable[..., Any] = getattr(lab_of(day), function)
    return found


def with_borrowed(text: str, complete: str, functions: Iterable[str]) -> str:
    """Return a script in which some functions call the kit's own.

    Args:
        text: the script.
        complete: the complete lab, whose signatures and docstrings are kept.
        functions: their names; one that is not there is left out.
    """
    tree = ast.parse(complete)
    nodes = {n.name: n for n in tree.body if isinstance(n, ast.FunctionDef)}
    there = tuple(name for name in functions if function_lines(text, name)[0] >= 0)
    calls: list[str] = []
    for name in there:
        node = nodes[name]
        given = ", ".join(arg.arg for arg in node.args.args)
        calls += complete.splitlines()[node.lineno - 1 : node.body[0].end_lineno]
        calls += [
            f"    {BORROWED}; your own function gives it back",
            "    from labkit.lesson.borrowed import kits",
            "",
            f'    return kits(__file__, "{name}")({given})',
        ]
    return put_back(text, "\n".join(calls), there)


def borrowed_tasks(day: Day, text: str) -> list[Task]:
    """Return the tasks of which a student's file borrows a function."""
    if BORROWED not in text:
        return []

    def borrows(function: str) -> bool:
        return BORROWED in "\n".join(function_lines(text, function)[2])

    return [task for task in day.tasks if any(map(borrows, task.functions))]
