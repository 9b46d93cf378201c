"""The student's file as text: the slips that it shows, and code put below it."""

import ast
import difflib
import re
from collections.abc import Iterable
from functools import lru_cache
from itertools import chain

from labkit.lesson import folder
from labkit.lesson.day import Day, Task
from labkit.lesson.starter import function_lines, read_script


def arguments(source: str, function: str) -> tuple[str, ...]:
    """Return the names of a function's arguments; () where it is not in the file."""
    found = _functions(source).get(function)
    return tuple(arg.arg for arg in found.args.args) if found else ()


def unfinished(source: str, function: str) -> str:
    """Return what keeps a function from doing anything yet, in a sentence, or ""."""
    found = _functions(source).get(function)
    body = found.body if found else []
    if (
        body
        and isinstance(body[0], ast.Expr)
        and isinstance(body[0].value, ast.Constant)
    ):
        body = body[1:]  # the docstring
    gaps = [node for node in body if _is_gap(node)]
    if gaps and len(gaps) < len(body):
        return (
            f"Your code is there, but line {gaps[0].lineno}, "
            "`raise NotImplementedError(...)`, still stops it: delete that line."
        )
    if body and all(isinstance(node, ast.Pass) for node in body):
        return "Its body is `pass`, which does nothing: write what it should return."
    return ""


def renamed(source: str, function: str) -> str:
    """Return what to do about a missing function that has another name, or ""."""
    there = {name.lower(): found for name, found in _functions(source).items()}
    for near in difflib.get_close_matches(function.lower(), there, 1, cutoff=0.8):
        return (
            f"The file has no function {function}, but {there[near].name} (line "
            f"{there[near].lineno}): did you mean {function}? Give it that name again."
        )
    return ""


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
    text = folder.without_kit(read_script(day.source))
    lines = [f"_kits = {{'__name__': 'kits_lab'}}; exec({text!r}, _kits)"]
    lines += [f"{name} = _kits[{name!r}]" for name in names]
    return "\n\n" + "\n".join(lines) + "\n"


def kits_own(day: Day, tasks: Iterable[Task]) -> str:
    """Return code that puts the kit's own functions of some tasks below a file.

    No other function of the kit comes with them: what the file's own ask of these may
    pass, and they could call whatever is there.

    Args:
        day: whose complete lab has them; "" is returned where it is not there.
        tasks: that a file borrows.
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


@lru_cache(8)  # a check asks for all functions of a file
def _functions(source: str) -> dict[str, ast.FunctionDef]:
    """Return the functions at the top of a file; {} where it cannot be read."""
    try:
        found = ast.parse(source.removeprefix("\ufeff")).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return {}
    return {node.name: node for node in found if isinstance(node, ast.FunctionDef)}


def _is_gap(node: ast.stmt) -> bool:
    names = (n.id for n in ast.walk(node) if isinstance(n, ast.Name))  # no recursion
    return isinstance(node, ast.Raise) and "NotImplementedError" in names
