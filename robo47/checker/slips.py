"""First slips that show in the text of a student's function, not in its answers."""

import ast

from robo47.lesson.starter import function_lines


def unfinished(source: str, function: str) -> str:
    """Return what keeps a function from doing anything yet, in a sentence, or "".

    Args:
        source: the student's file.
        function: its name.
    """
    start, _, lines = function_lines(source, function)
    try:
        definition = ast.parse("\n".join(lines)).body[0]
    except (SyntaxError, IndexError, ValueError):
        return ""
    if not isinstance(definition, ast.FunctionDef):
        return ""
    body = definition.body
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


def _is_gap(node: ast.stmt) -> bool:
    return isinstance(node, ast.Raise) and "NotImplementedError" in ast.dump(node)
