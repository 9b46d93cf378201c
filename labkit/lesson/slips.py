"""Mistakes that a file shows without a run: a gap, a function renamed or doubled.

Also what is no Python: lines of a notebook, marks of a merge, a pointer of Git LFS.
"""

import ast
import difflib
import re
from collections.abc import Iterator, Sequence
from functools import lru_cache

# Packages that a lab may use in its `main`, and that no task needs.
OTHER_PACKAGES = ("IPython", "PIL", "cv2", "matplotlib", "mpl_toolkits", "numba",
                  "pandas", "plotly", "scipy", "seaborn", "sklearn", "sympy", "torch",
                  "tqdm")  # fmt: skip
_GENERATORS = {"random", "rng", "default_rng"}
_POINTER = "version https://git-lfs"
_NOTEBOOK = re.compile(r'\s*\{\s*$|\s*\{\s*"cells"')
# Beginnings of lines that Python cannot read, each with a sentence for the student.
_NO_PYTHON = (
    (r"\s*%+\w", "A line that begins with % is a command of a notebook: delete it."),
    (r"\s*!\w", "A line that begins with ! is a command of a notebook: delete it."),
    (r"\s*(In|Out) ?\[\d*\]", "This is a label of a notebook: delete it, and keep the "
     "code behind it."),
    (r"\s*>>>", "This is the prompt of Python: delete it on each line, and keep the "
     "code behind it."),
)  # fmt: skip


def arguments(source: str, function: str) -> tuple[str, ...]:
    """Return the names of a function's arguments; () where it is not in the file."""
    found = _functions(source).get(function)
    return tuple(arg.arg for arg in found.args.args) if found else ()


def draws(source: str, function: str) -> bool:
    """Return whether the code of a function draws random numbers."""
    found = _functions(source).get(function)
    nodes = list(ast.walk(found)) if found else []
    names = {getattr(node, "attr", getattr(node, "id", "")) for node in nodes}
    return not _GENERATORS.isdisjoint(names - set(arguments(source, function)))


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
            f"Line {gaps[0].lineno}, `raise NotImplementedError(...)`, still stops "
            "your function. Delete this line."
        )
    if body and all(isinstance(node, ast.Pass) for node in body):
        return "The body of your function is `pass`. Return the result instead."
    return ""


def twice(source: str, function: str) -> str:
    """Return that a function is defined more than once, in a sentence, or ""."""
    lines = [node.lineno for node in _defined(source) if node.name == function]
    if len(lines) < 2:
        return ""
    times = "twice" if len(lines) == 2 else f"{len(lines)} times"
    return (
        f"Your file defines {function} {times}, on lines "
        f"{' and '.join(map(str, lines))}. Python uses the last definition, so delete "
        "each one that is not yours."
    )


def no_python(lines: Sequence[str], at: int) -> str:
    """Return what a file holds that is no Python, in a sentence, or "".

    Args:
        lines: of the file.
        at: the index of the line that Python could not read.
    """
    first = lines[0] if lines else ""
    if first.startswith(_POINTER):
        return "The file is a pointer of Git LFS, not your code: run `git lfs pull`."
    if _NOTEBOOK.match(first) and any('"cells"' in line for line in lines[:3]):
        return "The file is a notebook (.ipynb): save its code as a Python file."
    if any(line.startswith("<<<<<<< ") for line in lines):
        return (
            "This is the mark of a merge that git could not finish: keep one side, and "
            "delete the lines that begin with <<<<<<<, ======= and >>>>>>>."
        )
    line = lines[at] if 0 <= at < len(lines) else ""
    return next((says for form, says in _NO_PYTHON if re.match(form, line)), "")


def other_packages(source: str) -> tuple[str, ...]:
    """Return the packages of `OTHER_PACKAGES` that a file imports, as it needs them.

    Of an import in a `try` the file may do without.
    """
    if not any(name in source for name in OTHER_PACKAGES):
        return ()  # the file need not be parsed, which is the usual case
    found = (name.partition(".")[0] for name in _imported(_parsed(source)))
    return tuple(sorted(set(found) & set(OTHER_PACKAGES)))


def _imported(nodes: Sequence[ast.AST]) -> Iterator[str]:
    """Yield the names of the modules that are imported, outside of any `try`."""
    waiting = list(nodes)
    while waiting:  # no recursion: a student's file can be nested deeply
        node = waiting.pop()
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""
        elif not isinstance(node, ast.Try):
            waiting += ast.iter_child_nodes(node)


def renamed(source: str, function: str) -> str:
    """Return what to do about a missing function that has another name, or ""."""
    there = {name.lower(): found for name, found in _functions(source).items()}
    for near in difflib.get_close_matches(function.lower(), there, 1, cutoff=0.8):
        return (
            f"The file has no function {function}, but {there[near].name} (line "
            f"{there[near].lineno}): did you mean {function}? Give it that name again."
        )
    return ""


def _functions(source: str) -> dict[str, ast.FunctionDef]:
    """Return the functions at the top of a file, the last of each name."""
    return {node.name: node for node in _defined(source)}


def _defined(source: str) -> list[ast.FunctionDef]:
    """Return every definition of a function at the top of a file."""
    return [node for node in _parsed(source) if isinstance(node, ast.FunctionDef)]


@lru_cache(8)  # a check asks for all functions of a file
def _parsed(source: str) -> list[ast.stmt]:
    """Return the statements at the top of a file; [] where it cannot be read."""
    try:
        return ast.parse(source.removeprefix("\ufeff")).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []


def _is_gap(node: ast.stmt) -> bool:
    names = (n.id for n in ast.walk(node) if isinstance(n, ast.Name))  # no recursion
    return isinstance(node, ast.Raise) and "NotImplementedError" in names
