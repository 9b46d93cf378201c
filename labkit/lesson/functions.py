"""The library's functions that a student may use, by the day that made them.

A line each, from the first line of its docstring; `make docs` puts them on a page.
"""

import importlib
import inspect
import re
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any

from labkit.lesson.day import Day, all_days

INNER = "fast."  # modules of the library that others call in a student's name


def functions_list(request: str) -> str:
    """Return a list of functions in Markdown.

    Args:
        request: "by day": those that days have made, each from the day after it on;
            or the names of modules, "simulate scenes".
    """
    if request != "by day":
        return "\n".join(_lines(request.split())) + "\n"
    parts = []
    for day in all_days():
        modules = [name for name in day.library if not name.startswith(INNER)]
        parts += [_heading(day), "", *_lines(modules), ""]
    return "\n".join(parts)


def _heading(day: Day) -> str:
    return f"### Day {day.number}: {day.title}"


def _lines(modules: list[str]) -> Iterator[str]:
    """Yield a line per function; one that two modules have stands in the first."""
    seen: set[Any] = set()
    for name in modules:
        for function in _public(importlib.import_module(f"robo47.{name}")):
            if function not in seen:
                seen.add(function)
                yield f"- `{name}.{_call(function)}`: {_purpose(function)}"


def _public(module: ModuleType) -> Iterator[Callable[..., Any]]:
    """Yield the functions that a module makes, and those that it passes on."""
    source = inspect.getsource(module)
    for name, thing in vars(module).items():
        mine = getattr(thing, "__module__", "") == module.__name__
        passed_on = re.search(rf"import {name} as {name}\b", source)
        if inspect.isfunction(thing) and name[0] != "_" and (mine or passed_on):
            yield thing


def _call(function: Callable[..., Any]) -> str:
    """Return a function with the names of what it must be given: "exp_screw(S, theta)".

    What has a default is left out.
    """
    wanted = inspect.signature(function).parameters.values()
    names = [one.name for one in wanted if one.default is inspect.Parameter.empty]
    return f"{function.__name__}({', '.join(names)})"


def _purpose(function: Callable[..., Any]) -> str:
    """Return what a function is for, as the rest of a line."""
    first = (inspect.getdoc(function) or "").partition("\n")[0].removeprefix("Return ")
    return first.replace("|", "\\|").rstrip(".")
