"""Sphinx run on the pages, and the files that the page with the arm needs.

Formulas become MathML, which needs no script, font or network to be read.
"""

import json
import re
import shutil
import tempfile
from collections.abc import Callable, Collection, Iterator
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx

from labkit.base import processes
from labkit.inspector.recording import Recording
from labkit.lesson.day import all_days
from labkit.site import (
    access,
    equations,
    formulas,
    links,
    meshes,
    notebooks,
    pages,
    robot,
    typed,
)
from robo47.errors import Robo47Error
from robo47.paths import ROOT, TWIN_XML

SOURCES = ROOT / "site"
WASM = SOURCES / "node_modules" / "@mujoco" / "mujoco" / "mujoco.wasm"
FONTS = SOURCES / "node_modules" / "@fontsource" / "stix-two-math" / "files"
MATHS = FONTS / "stix-two-math-latin-400-normal.woff2"  # SIL Open Font License
LARGEST_FILM = 2_000_000  # bytes of a page
SETTINGS: dict[str, Any] = {
    "project": "robo47",
    "html_title": "robo47",
    "html_theme": "furo",
    "html_css_files": ["style.css"],
    "html_js_files": [("page.js", {"type": "module"})],
    "html_search_scorer": str(SOURCES / "search.js"),
    "html_favicon": str(SOURCES / "icon.svg"),
    "html_copy_source": False,
    "html_show_sphinx": False,
    "html_show_copyright": False,
    "html_math_renderer": "mathml",
    "extensions": [
        "myst_parser",  # the documents are Markdown
        "sphinx.ext.autodoc",  # the library's pages, from its docstrings
        "sphinx.ext.napoleon",  # reads Args and Returns
        __name__,  # `setup` below is called by Sphinx
    ],
    "myst_enable_extensions": ["dollarmath", "tasklist"],
    "myst_heading_anchors": 4,
    "autodoc_typehints": "none",  # the docstrings tell shapes and units
    "autodoc_member_order": "bysource",
    "napoleon_use_ivar": True,  # a class's attributes are listed once
    "napoleon_attr_annotations": False,  # types are left out, as elsewhere on the site
    "default_role": "code",  # `q` in a docstring
}
LONG = 55  # letters of LaTeX: a formula that a phone scrolls, since none is broken
# As an accent, a dot is set into its letter at a screen's size: q with a dot reads q.
_MELTS = ' accent="true"'
# the beginnings of lines that own an indented paragraph
_MARKUP = (":", "..", "- ", "* ")
_FORMULA = re.compile(r"(:math:`[^`]*`)")
# docutils puts the index of an accented letter below it: q with a dot and an i.
_BELOW = re.compile(
    r"<munderover>\s*(<mi>[^<]*</mi>)(.*?)(<mo[^>]*>[˙¨]</mo>)\s*</munderover>",
    re.DOTALL,
)
_BESIDE = r"<msub><mover>\1\3</mover>\2</msub>"
# A browser puts an index below the tail of its letter: the s of q_s a line too low.
_TAIL = re.compile(r"(<msub(?:sup)?>\s*)(<mi>[gjpqyβγζηξρφχψμ]</mi>)")
# The bars of a norm stand beside what they hold, also the first after a sign.
_BAR = re.compile(r'<mo( stretchy="false")?>([|‖])</mo>')
# A function's name stands off its neighbours, as TeX sets it: a sin x is no asin x.
_CALL = "<mo>&ApplyFunction;</mo>"
_NAME = re.compile(
    r"(</mi>|</mn>|</msub>|</msup>|\)</mo>)(?=\s*<mi[^>]*>\w\w+</mi>\s*" + _CALL + ")"
)
_ARGUMENT = re.compile(_CALL + r"(?!\s*<mo[^>]*>[(\[])")
_THIN = '<mspace width="0.17em"/>'


def build(out: Path, shown: Collection[int] | None = None) -> None:
    """Build the site into a folder, which is made anew.

    Args:
        out: the folder.
        shown: the days whose notebooks are run and shown; all if None.

    Raises:
        Robo47Error: a warning, a link that leads nowhere, a notebook's cell that fails,
            or no packages for the arm.
    """
    if not (WASM.exists() and MATHS.exists()):
        raise Robo47Error("the arm's packages are missing: npm ci --prefix site")
    shutil.rmtree(out, ignore_errors=True)
    with tempfile.TemporaryDirectory(prefix="robo47-site-") as name:
        work = Path(name).resolve()
        days = [one for one in all_days() if shown is None or one.number in shown]
        pages.lay_out(work / "pages", films(), days)
        notebooks.write_all(days, work / "pages")
        site = Sphinx(
            work / "pages",
            None,
            out,
            work / "doctrees",
            "html",
            {**SETTINGS, "html_static_path": [str(_static(work / "static"))]},
            status=None,
            warningiserror=True,
        )
        site.build()
    if site.statuscode:
        raise Robo47Error("the site has warnings, above; each is an error")
    access.mend(out, pages.FILMS)
    if wrong := links.faults(out):
        raise Robo47Error("links that lead nowhere:\n  " + "\n  ".join(wrong))


def films() -> dict[str, Callable[[], Recording]]:
    """Return what records the film beside each picture, from `w*/dayN/films.py`."""
    some = (day.offered("films") for day in all_days())
    return {name: make for films in some for name, make in films.items()}


def _static(into: Path) -> Path:
    """Return a folder, made with the style and all that the arm's page loads."""
    (into / pages.FILMS).mkdir(parents=True)
    for path in (SOURCES / "style.css", SOURCES / "page.js", TWIN_XML, WASM, MATHS):
        shutil.copy(path, into)
    for path in ROOT.glob(f"w*/figures/*{access.TALL}.*"):
        shutil.copy(path, into)  # a narrow screen shows this one
    for name, make in films().items():
        path = into / pages.FILMS / f"{name}.html"
        path.write_text(access.film(make().page(name.replace("_", " "))), "utf-8")
        if path.stat().st_size > LARGEST_FILM:
            raise Robo47Error(f"the film {name} has {path.stat().st_size:,} bytes")
    read = {
        "ghosts.json": {**formulas.tables(), "typed": typed.table()},
        "panda.json": robot.numbers(),
    }
    for name, what in read.items():
        (into / name).write_text(json.dumps(what, separators=(",", ":")), "utf-8")
    meshes.write(into / "panda.bin")
    command = ["npm", "run", "--silent", "build", "--", f"--outdir={into}"]
    done = processes.run(command, cwd=SOURCES)
    if done.returncode:
        raise Robo47Error(f"arm.js was not built: {done.stderr.strip()[-500:]}")
    return into


def mathml(formula: str, as_block: bool = False) -> str:
    """Return a formula of LaTeX as MathML."""
    made = _BELOW.sub(_BESIDE, tex2mathml(formula, as_block=as_block))
    made = _ARGUMENT.sub(_CALL + _THIN, _NAME.sub(rf"\1{_THIN}", made))
    made = _TAIL.sub(r'\1<mpadded depth="0em">\2</mpadded>', made)
    made = _BAR.sub(r'<mo\1 lspace="0em" rspace="0em">\2</mo>', made)
    return made.replace(_MELTS, "")


def write(page: Any, node: Any, as_block: bool = False) -> None:
    """Write a formula that stands in a line, or alone."""
    formula = node.astext()
    made = mathml(formula, as_block)
    if len(formula) > LONG and not as_block:
        made = f'<span class="long">{made}</span>'
    page.body.append(made)
    raise nodes.SkipNode


def plain(*docstring: Any) -> None:
    """Set the formulas of a docstring; keep its bars, |x|, from becoming markup."""
    lines = docstring[-1]
    made = list[str]()
    for alone, part in _parts([line.rstrip() for line in lines]):
        made += _displayed(part) if alone else _prose(part)
    lines[:] = made


def _parts(lines: list[str]) -> Iterator[tuple[bool, list[str]]]:
    """Yield the parts of a docstring: what is indented after a gap stands alone."""
    above, alone = "", False  # the last line at the margin
    part = list[str]()
    for before, line in pairwise(["", *lines]):
        begins = line and not before and not alone and not above.startswith(_MARKUP)
        margin = bool(line) and not line[0].isspace()
        if (alone and margin) or (begins and not margin):
            yield alone, part
            alone, part = not alone, []
        above = line if margin else above
        part.append(line)
    yield alone, part


def _displayed(lines: list[str]) -> list[str]:
    """Return indented lines as formulas, or as they stand."""
    formulas = equations.equations(lines)
    if formulas is None:
        return [".. code-block:: text", "", *lines]
    return [line for one in formulas for line in (f".. math:: {one}", "")]


def _prose(lines: list[str]) -> list[str]:
    """Return other lines with their formulas marked up, and other bars kept."""
    pieces = _FORMULA.split(equations.inline("\n".join(lines)))
    pieces[::2] = [piece.replace("|", r"\|") for piece in pieces[::2]]
    return "".join(pieces).split("\n")


def fields(*member: Any) -> bool | None:
    """Leave out the fields of a named tuple: its own docstring tells them."""
    return True if type(member[3]).__name__ == "_tuplegetter" else None


def setup(site: Sphinx) -> dict[str, bool]:
    """Tell Sphinx of all this."""
    site.connect("autodoc-process-docstring", plain)
    site.connect("autodoc-skip-member", fields)
    alone = partial(write, as_block=True)
    site.add_html_math_renderer("mathml", (write, None), (alone, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
