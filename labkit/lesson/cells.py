"""A day's functions found in the cells of a notebook, and put into the lab's file.

The cells are text here: nothing of them runs. A cell that does not parse still counts,
so that the checker can name the line.
"""

import ast
import builtins
import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from labkit.lesson.day import Day
from labkit.lesson.starter import function_lines, put_back, starter_of

_COMMAND = re.compile(r"^[%!].*$", re.MULTILINE)  # a line for IPython or the shell
_DEF = re.compile(r"^def (\w+)\(", re.MULTILINE)
_GAP = re.compile(r'^\s*raise NotImplementedError\("task \d', re.MULTILINE)
MOST = 20_000_000  # bytes of a notebook, with its pictures
BEGIN = "# From the notebook, besides the lab's functions:"
END = "# End of what is from the notebook."
_BLOCK = re.compile(rf"^{BEGIN}\n(.*?)^{END}\n\n?\n?", re.MULTILINE | re.DOTALL)


@dataclass
class Cells:
    """The definitions at the top level of a notebook's cells; the last one counts."""

    # The text of each function, by name.
    functions: dict[str, str] = field(default_factory=dict)
    others: dict[str, str] = field(default_factory=dict)  # imports and constants
    # Functions whose last cell does not parse: "line 2: '(' was never closed".
    broken: dict[str, str] = field(default_factory=dict)


def definitions(sources: Iterable[str]) -> Cells:
    """Return what cells define.

    Args:
        sources: the texts of the code cells, in the order in which they run.
    """
    cells = Cells()
    for source in sources:
        source = _COMMAND.sub("", source)
        try:
            body = ast.parse(source).body
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            at = (
                f"line {error.lineno}: {error.msg}"
                if isinstance(error, SyntaxError)
                else "it cannot be read"
            )
            for name in _DEF.findall(source):
                cells.functions[name] = "\n".join(function_lines(source, name)[2])
                cells.broken[name] = at
            continue
        for node in body:
            _note(node, source, cells)
    return cells


def reverted(sources: Sequence[str], since: int) -> set[str]:
    """Return the functions that were run last with an earlier text than before.

    Args:
        sources: the texts of the executed cells, in order.
        since: how many of them ran before the cells in question.
    """
    now = definitions(sources[since:]).functions
    every = [definitions([source]).functions for source in sources]
    return {
        name
        for name, text in now.items()
        if any(one.get(name, text) != text for one in every)
    }


def _note(node: ast.stmt, source: str, cells: Cells) -> None:
    """Remember what one statement of a cell defines."""
    lines = source.splitlines()
    match node:
        case ast.FunctionDef():
            cells.broken.pop(node.name, None)
            first = min([node.lineno, *(one.lineno for one in node.decorator_list)])
            cells.functions[node.name] = "\n".join(lines[first - 1 : node.end_lineno])
        case ast.Import() | ast.ImportFrom():
            for name in node.names:
                one = type(node)(**{**vars(node), "names": [name]})
                bound = name.asname or name.name.partition(".")[0]
                cells.others[bound] = ast.unparse(one)
        case ast.Assign(targets=[ast.Name(id=name)]):
            text = "\n".join(lines[node.lineno - 1 : node.end_lineno])
            cells.others[name] = text


def is_gap(function: str) -> bool:
    """Return whether a function is still the starter's, with nothing written in it."""
    return bool(_GAP.search(function))


def text_of(script: str, name: str) -> str:
    """Return a function of a script as text, "" if the script has none."""
    return "\n".join(function_lines(script, name)[2])


def with_functions(script: str, cells: Cells, names: Iterable[str]) -> str:
    """Return a script with functions of the cells, and with what these need.

    Args:
        script: the text of the day's file.
        cells: of the notebook.
        names: of the functions that are taken.
    """
    script, own = split_script(script)
    for name in names:
        script = put_back(script, cells.functions[name], (name,))
    known = {**own, **cells.others, **cells.functions}
    needed = _needed(script, known)
    if not needed:
        return script
    lines = script.splitlines()
    first = next((i for i, ln in enumerate(lines) if _DEF.match(ln)), len(lines))
    block = [BEGIN, *"\n\n\n".join(needed).splitlines(), END, "", ""]
    lines[first:first] = block
    return "\n".join(lines) + "\n"


def split_script(script: str) -> tuple[str, dict[str, str]]:
    """Return a script without the notebook's own definitions, and these by name."""
    found = _BLOCK.search(script)
    if not found:
        return script, {}
    cells = definitions([found[1]])
    return script.replace(found[0], "", 1), {**cells.others, **cells.functions}


def _needed(script: str, known: dict[str, str]) -> list[str]:
    """Return the definitions that a script's functions use and the script lacks."""
    has = _names_of(script)
    waiting, seen = [script], list[str]()
    while waiting:
        for name in sorted(_loaded(waiting.pop()) - has - set(seen)):
            if name in known:
                seen.append(name)
                waiting.append(known[name])
    # Imports and constants first: a default value of a function may need them.
    return sorted((known[n] for n in reversed(seen)), key=lambda t: t.startswith("def"))


def _names_of(script: str) -> set[str]:
    """Return the names that a script has at its top level, and Python's own."""
    try:
        body = ast.parse(script).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set(dir(builtins)) | set(re.findall(r"^(?:def )?(\w+)", script, re.M))
    found = set(dir(builtins))
    for node in body:
        for one in ast.walk(node) if isinstance(node, ast.Assign) else (node,):
            match one:
                case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                    found.add(name)
                case ast.Import(names=names) | ast.ImportFrom(names=names):
                    found |= {n.asname or n.name.partition(".")[0] for n in names}
                case ast.Name(id=name, ctx=ast.Store()):
                    found.add(name)
    return found


def _loaded(text: str) -> set[str]:
    """Return the names that a text uses; none if it does not parse."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return set()
    return {n.id for n in ast.walk(tree) if isinstance(n, ast.Name)}


def code_of(notebook: bytes) -> list[str]:
    """Return the texts of the code cells of a notebook's file.

    Raises:
        ValueError: it is no notebook.
    """
    try:
        cells = json.loads(notebook)["cells"]
        code = [cell for cell in cells if cell["cell_type"] == "code"]
        return ["".join(cell["source"]) for cell in code]
    except (ValueError, LookupError, TypeError, RecursionError):
        raise ValueError("it is no notebook") from None


def lab_from(day: Day, notebook: bytes) -> str:
    """Return the text of a lab that was handed in as a notebook alone.

    Args:
        day: from its manifest.
        notebook: the content of the file.

    Raises:
        ValueError: it is no notebook.
    """
    cells = definitions(code_of(notebook))
    there = [name for name in functions_of(day) if name in cells.functions]
    written = [name for name in there if not is_gap(cells.functions[name])]
    return with_functions(starter_of(day), cells, written)


def functions_of(day: Day) -> list[str]:
    """Return the names of a day's functions, those that they had before last."""
    now = [name for task in day.tasks for name in task.functions]
    return now + [was for task in day.tasks for was, _ in task.renamed]
