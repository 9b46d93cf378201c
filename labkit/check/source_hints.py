"""What the text of a student's function shows, not its answers: names, first slips.

`source` is the student's whole file, `function` a name in it.
"""

import ast
import difflib
import re

from labkit.lesson.starter import function_lines


def arguments(source: str, function: str) -> tuple[str, ...]:
    """Return the names of a function's arguments; () where they cannot be read."""
    _, definition = _definition(source, function)
    return tuple(arg.arg for arg in definition.args.args) if definition else ()


def unfinished(source: str, function: str) -> str:
    """Return what keeps a function from doing anything yet, in a sentence, or ""."""
    start, definition = _definition(source, function)
    body = definition.body if definition else []
    if (
        body
        and isinstance(body[0], ast.Expr)
        and isinstance(body[0].value, ast.Constant)
    ):
        body = body[1:]  # the docstring
    gaps = [node for node in body if _is_gap(node)]
    rest = [node for node in body if not _is_gap(node)]
    if gaps and rest:
        line = start + gaps[0].lineno
        return (
            f"Your code is there, but line {line}, `raise NotImplementedError(...)`, "
            "still stops it: delete that line."
        )
    if body and all(isinstance(node, ast.Pass) for node in body):
        return "Its body is `pass`, which does nothing: write what it should return."
    return ""


def renamed(source: str, function: str) -> str:
    """Return what to do about a missing function that has another name, or ""."""
    there = {name.lower(): name for name in re.findall(r"^def (\w+)\(", source, re.M)}
    for near in difflib.get_close_matches(function.lower(), there, 1, cutoff=0.8):
        line = function_lines(source, there[near])[0] + 1
        return (
            f"The file has no function {function}, but {there[near]} (line {line}): "
            f"did you mean {function}? Give it that name again."
        )
    return ""


def _definition(source: str, function: str) -> tuple[int, ast.FunctionDef | None]:
    """Return the index of a function's first line, and the function."""
    start, _, lines = function_lines(source, function)
    try:
        found = ast.parse("\n".join(lines)).body[0]
    except (SyntaxError, IndexError, ValueError, RecursionError, MemoryError):
        return start, None
    return start, found if isinstance(found, ast.FunctionDef) else None


def _is_gap(node: ast.stmt) -> bool:
    names = (n.id for n in ast.walk(node) if isinstance(n, ast.Name))  # no recursion
    return isinstance(node, ast.Raise) and "NotImplementedError" in names
