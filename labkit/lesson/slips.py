"""What shows in a student's file unrun: a gap left in, a function renamed."""

import ast
import difflib
from functools import lru_cache


def arguments(source: str, function: str) -> tuple[str, ...]:
    """Return the names of a function's arguments; () where it is not in the file."""
    found = _functions(source).get(function)
    return tuple(arg.arg for arg in found.args.args) if found else ()


def unfinished(source: str, function: str) -> str:
    """Return what keeps a function from doing anything yet, in a sentence, or ""."""
    found = _functions(source).get(function)
    body = found.body if found else []
    first = body[0] if body else None
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
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
