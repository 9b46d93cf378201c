"""Sphinx run on the pages, and the files that the page with the arm needs."""

import json
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

from labkit.base import processes
from labkit.inspector.recording import Recording
from labkit.lesson.day import all_days
from labkit.site import formulas, links, pages
from robo47.errors import Robo47Error
from robo47.paths import ROOT, TWIN_XML

SOURCES = ROOT / "site"
WASM = SOURCES / "node_modules" / "@mujoco" / "mujoco" / "mujoco.wasm"
LARGEST_FILM = 2_000_000  # bytes of a page
SETTINGS: dict[str, Any] = {
    "project": "robo47",
    "html_title": "robo47",
    "html_theme": "furo",
    "html_css_files": ["style.css"],
    "html_js_files": [("film.js", {"defer": "defer"})],
    "html_favicon": str(SOURCES / "icon.svg"),
    "html_copy_source": False,
    "html_show_sphinx": False,
    "html_show_copyright": False,
    "html_math_renderer": "mathml",
    "extensions": [
        "myst_parser",  # the documents are Markdown
        "sphinx.ext.autodoc",  # the library's pages, from its docstrings
        "sphinx.ext.napoleon",  # which say Args and Returns
        "labkit.site.extension",
    ],
    "myst_enable_extensions": ["dollarmath", "tasklist"],
    "myst_heading_anchors": 4,
    "autodoc_typehints": "none",  # the docstrings tell shapes and units
    "autodoc_member_order": "bysource",
    "napoleon_use_ivar": True,  # a class's attributes are listed once
    "napoleon_attr_annotations": False,  # and, as elsewhere, without types
    "default_role": "code",  # `q` in a docstring
}


def build(out: Path) -> None:
    """Build the site into a folder, which is made anew.

    Raises:
        Robo47Error: a warning, a link that leads nowhere, or no packages for the arm.
    """
    if not WASM.exists():
        raise Robo47Error("the arm's packages are missing: npm ci --prefix site")
    shutil.rmtree(out, ignore_errors=True)
    with tempfile.TemporaryDirectory(prefix="robo47-site-") as name:
        work = Path(name).resolve()
        pages.lay_out(work / "pages", filmed=films())
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
    if wrong := links.faults(out):
        raise Robo47Error("links that lead nowhere:\n  " + "\n  ".join(wrong))


def films() -> dict[str, Callable[[], Recording]]:
    """Return what records the film beside each picture, from `w*/dayN/films.py`."""
    some = (day.offered("films") for day in all_days())
    return {name: make for films in some for name, make in films.items()}


def _static(into: Path) -> Path:
    """Return a folder, made with the style and all that the arm's page loads."""
    (into / pages.FILMS).mkdir(parents=True)
    for path in (SOURCES / "style.css", SOURCES / "film.js", TWIN_XML, WASM):
        shutil.copy(path, into)
    for name, make in films().items():
        path = into / pages.FILMS / f"{name}.html"
        path.write_text(make().page(name.replace("_", " ")), "utf-8")
        if path.stat().st_size > LARGEST_FILM:
            raise Robo47Error(f"the film {name} has {path.stat().st_size:,} bytes")
    (into / "ghosts.json").write_text(
        json.dumps(formulas.tables(), separators=(",", ":")), "utf-8"
    )
    command = ["npm", "run", "--silent", "build", "--", f"--outfile={into}/arm.js"]
    done = processes.run(command, cwd=SOURCES)
    if done.returncode:
        raise Robo47Error(f"arm.js was not built: {done.stderr.strip()[-500:]}")
    return into
