"""A day's lab as a notebook: its functions and the steps of main() become cells.

What a notebook adds to them (pictures, sliders) is in dayN/notebook.toml.
"""

import ast
import hashlib
import re
import textwrap
import tomllib
from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

from labkit.lesson.day import Day
from labkit.lesson.lab_module import lab_of, read_script
from labkit.lesson.sealed import is_sealed
from labkit.lesson.starter import find_regions, make_starter
from robo47.errors import Robo47Error
from robo47.paths import shown

KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}
MARKER = re.compile(r"^ *# (?:end)?region (\S+)\n", re.MULTILINE)
EARLY = re.compile(r"^( +)return (.+)$", re.MULTILINE)
LAST = "Record the number"

SETUP = """
import importlib.util
import subprocess
import sys
from pathlib import Path

REPOSITORY = ""  # on Colab: the address that you would give to git clone

if importlib.util.find_spec("robo47") is None:  # Colab, or a kernel without the kit
    kit = Path("robo47-kit")
    if not kit.exists():
        assert REPOSITORY, "set REPOSITORY above, then run this cell again"
        subprocess.run(["git", "clone", "--depth=1", REPOSITORY, kit], check=True)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--editable"]
    subprocess.run([*pip, f"{kit}[notebook]"], check=True)
    subprocess.run([sys.executable, kit / "scripts" / "fetch_menagerie.py"], check=True)
    sys.path.insert(0, str(kit.resolve()))  # else it shows only after a restart

from robo47.paths import ROOT

sys.path.insert(0, str(ROOT / "WEEK" / "src"))
__file__ = str(ROOT / "WEEK" / "src" / "SCRIPT.py")  # as in a script
sys.argv = ["SCRIPT"]  # add "--no-log" to leave metrics/metrics.csv alone
"""


def build(day: Day, starter: bool = False) -> str:
    """Return a day's notebook as the text of its file, or of one with gaps."""
    try:
        import jupytext
    except ModuleNotFoundError:
        raise Robo47Error(
            "jupytext is not installed; run make notebook, which brings it"
        ) from None
    source = read_script(day.source)
    if starter or is_sealed(day.source.read_text("utf-8")):  # an edition has no answers
        source = make_starter(source, day.script, day.number)
    tree = ast.parse(source)
    lines = source.splitlines(keepends=True)
    functions = (node for node in tree.body if isinstance(node, ast.FunctionDef))
    main = next(node for node in functions if node.name == "main")
    cells = head(day, tree, starter)
    cells += library(tree.body[: tree.body.index(main)], lines)
    cells += lab(day, main.body, lines)
    notebook = jupytext.reads("\n\n".join(cells), fmt="py:percent")
    notebook.metadata = {
        "kernelspec": KERNEL,
        "language_info": {"name": "python"},
        "robo47": digest(cell["source"] for cell in notebook.cells),
    }
    for i, cell in enumerate(notebook.cells):
        cell["id"] = f"cell-{i:02}"  # random ones would differ at every run
    return jupytext.writes(notebook, fmt="ipynb").rstrip("\n") + "\n"


def digest(sources: Iterable[Any]) -> str:
    """Return what changes with any cell, however its lines are stored."""
    text = "\0".join("".join(source) for source in sources)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def extras(day: Day) -> dict[str, list[str]]:
    """Return the cells that come after a step: {"1": [...], ..., "end": [...]}."""
    path = day.own / "notebook.toml"
    if not path.exists():
        return {}
    found: dict[str, list[str]] = {}
    try:
        for cell in tomllib.loads(path.read_text("utf-8"))["cells"]:
            after = found.setdefault(str(cell["after"]), [])
            after.append(text(cell["text"]))
            if lines := cell.get("code"):  # which may not draw: "run all" goes on
                after.append(code(lines, ' tags=["raises-exception"]'))
    except (ValueError, KeyError, TypeError) as error:
        raise Robo47Error(
            f"{shown(path)}: {type(error).__name__}: {error}; expected [[cells]] with "
            "after, text and code"
        ) from None
    return found


def text(words: str) -> str:
    """Return a cell of text."""
    return "# %% [markdown]\n" + textwrap.indent(words.strip(), "# ", lambda _: True)


def code(lines: str, tags: str = "") -> str:
    """Return a cell of code, without the markers of a task's gap."""
    return f"# %%{tags}\n{textwrap.dedent(MARKER.sub('', lines)).strip()}"


def head(day: Day, tree: ast.Module, starter: bool = False) -> list[str]:
    """Return the title and the set-up."""
    title, *about = (ast.get_docstring(tree) or "").split("\n\n")
    prose = [part for part in about if not part.startswith(" ")]  # not the commands
    made = (
        f"Made from `{shown(day.source)}` by `make notebook`: change it there. "
        "Run the cells from top to bottom."
    )
    if starter:
        made = (
            "Fill in one function after the other; what it needs to do stands in its "
            "docstring. A cell that raises NotImplementedError is still to write. The "
            f"answers to hand in go into `{shown(day.work)}`, which `make check` reads."
        )
    setup = SETUP.replace("WEEK", day.folder.name)
    setup = setup.replace("SCRIPT", Path(day.script).stem)
    return [text("\n\n".join([f"# {title}", *prose, made])), code(setup)]


def segments(body: list[ast.stmt], lines: list[str]) -> Iterator[tuple[ast.stmt, str]]:
    """Yield what follows a docstring, each with the lines since the one before."""
    for before, node in pairwise(body):
        yield node, "".join(lines[before.end_lineno : node.end_lineno])


def library(body: list[ast.stmt], lines: list[str]) -> list[str]:
    """Return what stands before main(): the constants, then a function per cell."""
    constants = ""
    functions = []
    regions = find_regions("".join(lines), "the lab")
    tasks = {region.function: region.task for region in regions}
    for node, segment in segments(body, lines):
        if isinstance(node, ast.FunctionDef):
            name = f"{tasks.get(node.name, '')} `{node.name}`".strip()
            functions += [text(f"### {name}"), code(segment)]
        elif ast.unparse(node) != "import kit":  # a notebook has its kernel already
            constants += segment
    return [code(constants), text("## The functions"), *functions]


def lab(day: Day, body: list[ast.stmt], lines: list[str]) -> list[str]:
    """Return main(): a heading and a cell per step, and what the day adds."""
    cells = [text("## The lab")]
    more = extras(day)
    for title, own in sections(day, body, lines):
        cells += [text(f"### {title}")] if title else []
        cells.append(code(own))
        cells += more.pop(title.partition(".")[0], [])
    cells += more.pop("end", [])
    if more:
        raise Robo47Error(f"day {day.number}: no step {min(more)} to add a cell after")
    return cells


def sections(day: Day, body: list[ast.stmt], lines: list[str]) -> list[list[str]]:
    """Return the titles and bodies of main()'s steps; the first has no title."""
    found = [["", ""]]
    for node, segment in segments(body, lines):
        match node:
            case ast.Return(ast.expr() as value):  # without "Out: 0"
                found.append([LAST, f"\n    {ast.unparse(value)};"])
            case ast.Expr(ast.Call(ast.Attribute(ast.Name("lab"), "step"), [heading])):
                title = eval(ast.unparse(heading), vars(lab_of(day)))
                found.append([title, ""])
            case ast.If():  # "go no further" has no function to leave here
                found[-1][1] += EARLY.sub(r"\1raise SystemExit(\2)", segment)
            case _:
                found[-1][1] += segment
    return found
