"""Turn Day 1's lab script into a notebook, for a headless machine or Colab.

    make notebook                             write it
    python scripts/make_notebook.py           the same
    python scripts/make_notebook.py --check   only say whether it is up to date

The script is the only source: its functions and the steps of its main() become
cells. What the notebook adds (set-up, pictures, sliders) is in this file.
"""

import ast
import contextlib
import re
import textwrap

import kit  # noqa: F401 (goes on in the kit's own Python)

from robo47 import cli
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

SCRIPT = ROOT / "w1-foundations" / "src" / "day1_transforms.py"
NOTEBOOK = ROOT / "w1-foundations" / "notebooks" / "day1_transforms.ipynb"
KERNEL = {"display_name": "Python 3", "language": "python", "name": "python3"}
MARKER = re.compile(r"^ *# (?:end)?region (\S+)\n", re.MULTILINE)

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

sys.path.insert(0, str(ROOT / "w1-foundations" / "src"))
sys.argv = ["day1_transforms"]  # add "--no-log" to leave metrics/metrics.csv alone
"""
# After which step a picture comes: what to look at, and the code that draws it.
PICTURES = {
    "1": (
        "The arm at home. Each link carries a frame: x red, y green, z blue. MuJoCo\n"
        "drew the robot; the frames over it are composed by hand.",
        "from robo47 import figures\n\nfigures.render_panda(HOME_Q)",
    ),
    "4": (
        "The same `T_extra`, once on the left and once on the right. Blue is where it\n"
        "takes the arm, or the tool.",
        "import day1_figures\n\nday1_figures.order()",
    ),
}
RECORD = "Record the number"
SLIDERS = (
    "## Try it\n\nDrag a joint: the frames follow, and so does `T_world_ee`.\n"
    "Which joint changes only its rotation?",
    "from robo47.figures.sliders import joint_sliders\n\njoint_sliders()",
)


def build() -> str:
    """Return the notebook as the text of its file.

    Raises:
        Robo47Error: jupytext is not installed.
    """
    try:
        import jupytext
    except ModuleNotFoundError:
        raise Robo47Error(
            "jupytext is not installed; run make notebook, which brings it"
        ) from None
    source = SCRIPT.read_text("utf-8")
    tree, lines = ast.parse(source), source.splitlines(keepends=True)
    cells = [*head(tree), *library(tree, lines), *lab(tree, lines)]
    notebook = jupytext.reads("\n\n".join(cells), fmt="py:percent")
    notebook.metadata = {"kernelspec": KERNEL, "language_info": {"name": "python"}}
    for i, cell in enumerate(notebook.cells):
        cell["id"] = f"cell-{i:02}"  # random ones would differ at every run
    return jupytext.writes(notebook, fmt="ipynb").rstrip("\n") + "\n"


def text(words: str) -> str:
    """Return a cell of text."""
    return "# %% [markdown]\n" + textwrap.indent(words.strip(), "# ", lambda _: True)


def code(lines: str, tags: str = "") -> str:
    """Return a cell of code, without the markers of a task's gap."""
    return f"# %%{tags}\n{textwrap.dedent(MARKER.sub('', lines)).strip()}"


def drawing(words: str, lines: str) -> list[str]:
    """Return two cells; where nothing draws, "run all" goes on with the next."""
    return [text(words), code(lines, ' tags=["raises-exception"]')]


def head(tree: ast.Module) -> list[str]:
    """Return the title and the set-up."""
    title, *about = (ast.get_docstring(tree) or "").split("\n\n")
    prose = [part for part in about if not part.startswith(" ")]  # not the commands
    made = (
        f"Made from `{shown(SCRIPT)}` by `make notebook`: change it there. "
        "Run the cells from top to bottom."
    )
    return [text("\n\n".join([f"# {title}", *prose, made])), code(SETUP)]


def library(tree: ast.Module, lines: list[str]) -> list[str]:
    """Return what stands before main(): the constants, then a function per cell."""
    docstring, *nodes = tree.body[: tree.body.index(find_main(tree))]
    constants, functions = "", []
    end = docstring.end_lineno
    for node in nodes:
        segment = "".join(lines[end : node.end_lineno])
        end = node.end_lineno
        if isinstance(node, ast.Try):  # whose message is for a shell
            wanted = lines[node.body[0].lineno - 1 : node.body[-1].end_lineno]
            segment = "\n" + textwrap.dedent("".join(wanted))
        if isinstance(node, ast.FunctionDef):
            task = "".join(MARKER.findall(segment)[:1])
            functions += [text(f"### {task} `{node.name}`"), code(segment)]
        else:
            constants += segment
    return [code(constants), text("## The functions"), *functions]


def lab(tree: ast.Module, lines: list[str]) -> list[str]:
    """Return main(): a heading and a cell per step, and the pictures."""
    cells = [text("## The lab")]
    for title, body in sections(tree, lines):
        cells += [text(f"### {title}")] if title else []
        cells.append(code(body))
        cells += drawing(*PICTURES[title[0]]) if title[:1] in PICTURES else []
    return [*cells, *drawing(*SLIDERS)]


def sections(tree: ast.Module, lines: list[str]) -> list[tuple[str, str]]:
    """Return the titles and bodies of main()'s steps; the first has no title."""
    docstring, *nodes = find_main(tree).body
    names = literals(tree)
    found, title, body = [], "", ""
    end = docstring.end_lineno
    for node in nodes:
        segment = "".join(lines[end : node.end_lineno])
        end = node.end_lineno
        method, arguments = lab_call(node)
        if method == "step" or (method == "record" and title != RECORD):
            found.append((title, body))
            title = evaluate(arguments[0], names) if method == "step" else RECORD
            body = ""
        if isinstance(node, ast.Return) and node.value:
            segment = f"\n    {ast.unparse(node.value)}"
        body += segment if method != "step" else ""
    return [*found, (title, body)]


def find_main(tree: ast.Module) -> ast.FunctionDef:
    """Return the definition of main()."""
    functions = (node for node in tree.body if isinstance(node, ast.FunctionDef))
    return next(node for node in functions if node.name == "main")


def lab_call(node: ast.stmt) -> tuple[str, list[ast.expr]]:
    """Return the method and the arguments of `lab.method(...)`, or "" and none."""
    match node:
        case ast.Expr(ast.Call(ast.Attribute(ast.Name("lab"), method), arguments)):
            return method, arguments
    return "", []


def literals(tree: ast.Module) -> dict[str, object]:
    """Return the constants that headings may name, such as CONFIGURATIONS."""
    names: dict[str, object] = {}
    for node in tree.body:
        if isinstance(node, ast.Assign):
            with contextlib.suppress(ValueError):  # not a literal
                value = ast.literal_eval(node.value)
                exec(f"{ast.unparse(node.targets[0])} = value", {"value": value}, names)
    return names


def evaluate(heading: ast.expr, names: dict[str, object]) -> str:
    """Return the words of a heading, an f-string or a plain one."""
    return str(eval(compile(ast.Expression(heading), SCRIPT.name, "eval"), names))


def main() -> int:
    """Write the notebook, or check it."""
    parser = cli.parser(__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing")
    check, fresh = parser.parse_args().check, build()
    current = NOTEBOOK.read_text("utf-8") if NOTEBOOK.exists() else ""
    if fresh == current:
        print(f"{shown(NOTEBOOK)} is up to date")
        return cli.EXIT_OK
    if check:
        print(f"{shown(NOTEBOOK)} is out of date: run `make notebook`")
        return cli.EXIT_FAILED
    NOTEBOOK.parent.mkdir(parents=True, exist_ok=True)
    NOTEBOOK.write_text(fresh, "utf-8", newline="\n")
    print(f"{shown(NOTEBOOK)} written; open it with Jupyter or VS Code (kernel .venv)")
    return cli.EXIT_OK


if __name__ == "__main__":
    cli.run(main)
