"""A day's notebook, run from top to bottom, as a page of the site.

What a cell printed, and the picture that it drew, stand below it. A widget is moved in
a notebook of one's own, and here it is only named.
"""

import base64
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import nbclient
import nbformat

from labkit.lesson.day import Day
from labkit.lesson.week import NOTEBOOKS, WORK, weeks
from labkit.notebook.build import build
from labkit.site.pages import documents, linked, notebook_of
from robo47.errors import Robo47Error
from robo47.paths import ROOT, menagerie_root

AT_ONCE = 2  # kernels
SECONDS = 300  # limit of a cell
WIDGET = "application/vnd.jupyter.widget-view+json"
SLIDERS = "*Sliders: move them in a notebook of your own, `make notebook DAY={}`.*"
FENCE = "`" * 8
HEAD = "---\norphan: true\n---\n"


def write_all(days: Sequence[Day], folder: Path) -> None:
    """Run the days' notebooks, and write each one's page where its guide links to.

    Args:
        days: whose notebooks.
        folder: the site's source.

    Raises:
        Robo47Error: a cell failed.
    """
    with ThreadPoolExecutor(AT_ONCE) as threads:
        for day, ran in zip(days, threads.map(run, days), strict=True):
            name = Path(day.folder.name, notebook_of(day))
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            text = linked(page(ran, path, day.number), name, documents(), folder)
            path.write_text(text, "utf-8", newline="\n")


def run(day: Day) -> Any:
    """Return a day's complete notebook with what its cells gave.

    It runs in a copy of the kit, where nobody has begun the day.

    Raises:
        Robo47Error: a cell failed; one that draws fails where OpenGL is missing.
    """
    made = nbformat.reads(build(day, complete=True), as_version=4)
    with tempfile.TemporaryDirectory(prefix="robo47-notebook-") as folder:
        kit = copy_kit(day, Path(folder))
        where = {"metadata": {"path": str(kit)}}
        client = nbclient.NotebookClient(made, timeout=SECONDS, resources=where)
        own = {**os.environ, "PYTHONPATH": str(kit)}
        own["MENAGERIE_ROOT"] = str(menagerie_root().absolute())
        try:
            client.execute(env=own, stderr=subprocess.DEVNULL)
        except nbclient.exceptions.CellExecutionError as error:
            raise Robo47Error(
                f"day {day.number}: a cell of the notebook failed: "
                f"{error.ename}: {error.evalue}; try make notebook DAY={day.number}"
            ) from None
    return made


def copy_kit(day: Day, folder: Path) -> Path:
    """Write what a day's notebook needs of the kit into a folder, and return it.

    No prediction is asked for there.
    """
    left_out = shutil.ignore_patterns("__pycache__", WORK, NOTEBOOKS)
    for name in (
        "robo47",
        "labkit",
        "scripts",
        *(week.folder.name for week in weeks()),
    ):
        shutil.copytree(ROOT / name, folder / name, ignore=left_out)
    (folder / "metrics").mkdir()
    if day.worksheet:
        sheet = folder / day.folder.name / day.worksheet
        rows = sheet.read_text("utf-8").splitlines()
        sheet.write_text("\n".join(ln for ln in rows if ln[:1] != "|") + "\n", "utf-8")
    return folder


def page(ran: Any, path: Path, day: int) -> str:
    """Return a notebook that was run as Markdown; its pictures are put beside it."""
    parts = []
    for n, cell in enumerate(ran.cells):
        if cell.cell_type == "markdown":
            parts.append(cell.source)
            continue
        parts.append(f"{FENCE}python\n{cell.source}\n{FENCE}")
        parts += _outputs(cell.outputs, path.with_name(f"{path.stem}-{n}.png"), day)
    return HEAD + "\n\n".join(parts) + "\n"


def _outputs(outputs: Sequence[Any], picture: Path, day: int) -> Iterator[str]:
    """Yield what a cell gave; progress, which goes to stderr, is left out."""
    printed = "".join(it.text for it in outputs if it.get("name") == "stdout")
    if printed.strip():
        yield _text(printed)
    for data in (it.data for it in outputs if "data" in it):
        if WIDGET in data:
            yield SLIDERS.format(day)
        elif "image/png" in data:
            picture.write_bytes(base64.b64decode(data["image/png"]))
            yield f"![What the cell above draws]({picture.name})"
        else:
            yield _text(data["text/plain"])


def _text(words: str) -> str:
    """Return what was printed, as it was."""
    option = ":class: printed"
    return f"{FENCE}{{code-block}} text\n{option}\n\n{words.strip(chr(10))}\n{FENCE}"
