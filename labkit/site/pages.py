"""Pages of the site: every document as it stands, and what a document links to.

The documents are copied beside each other as they are in the repository, so that their
links hold. A link to a file that is no page (a lab, a test) leads to a page that shows
the file; a link to a folder leads to nothing, and the build says so.
"""

import os
import re
import shutil
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

from labkit.lesson.day import Day, days_of
from labkit.lesson.week import weeks
from labkit.site import home
from robo47.paths import ROOT

DOCUMENTS = (
    "*.md",
    "w*/README.md",
    "w*/docs/*.md",
    "docs/*.md",
    "metrics/README.md",
    "bench/README.md",
)
PICTURES = {".png", ".jpg", ".gif", ".svg", ".webp"}
# HTML that GitHub shows, with another picture on a phone: a page here has the first.
BY_WIDTH = re.compile(
    r'<picture>.*?<img src="([^"]+)"[^>]* alt="([^"]*)"[^>]*>\s*</picture>', re.DOTALL
)
LINK = re.compile(r"(?<=\]\()(?!https?:|#|mailto:)([^)#\s]+)(?=[)#])")
PICTURE = re.compile(r"^!\[[^\]]*\]\([^)\s]*?(\w+)\.\w+\)$", re.MULTILINE)
LIVE = re.compile(
    r"^<!-- live: (\w+) -->$", re.MULTILINE
)  # a figure of site/figures.js
FIGURE = '```{raw} html\n<figure class="live" data-figure="\\1"></figure>\n```'
COLAB = "https://colab.research.google.com/github"
BRANCH = "notebooks"  # a branch of the repository with nothing but the days' notebooks
FILMS = "films"  # their folder among the site's static files
VERB = re.compile(
    r"^([a-z-]+)%?:.*?##(\d?) (.+)$", re.MULTILINE
)  # a line of `make help`
TYPED = re.compile(r"\b[A-Z]+=[^\s,;]*[^\s,;:]|\B--[\w-]+|\b\w+/[\w.-]*\w")
COMMANDS = """\
# What to type: the commands

Type these commands in a clone of the kit. `DAY=2` selects a day, `WEEK=1` a week and
`TASK=1.4` a task; without it, a command takes the last one you worked on. The first ten
commands are those of a day, in the order of its work.

"""
TABLE = """\
## {}

```{{eval-rst}}
.. list-table::
   :widths: 1 3
   :header-rows: 1

   * - command
     - what it does
{}```
"""
ROW = """\
   * - .. index:: ! make {0}
          :name: make-{0}

       ``make {0}``
     - {1}
"""
LANGUAGE = {".py": "python", ".toml": "toml"}
HOME = Path("index.md")  # has no document of its own: see labkit.site.home
README = Path("README.md")
ARM = Path("site", "arm.md")
LIBRARY = "docs/library"  # the list of the library's functions
REFERENCE = """\
# robo47.{0}

```{{eval-rst}}
.. automodule:: robo47.{0}
   :members:
```
"""
CONTENTS = """
```{{toctree}}
:hidden:
{}

{}
```
"""
MODULES = (
    (
        "Poses and chains",
        ("se3", "kinematics", "screws", "dh", "rotation_log", "orientation"),
    ),
    ("Velocities and forces", ("jacobian", "fast.jacobians", "fast.ik", "dynamics")),
    ("Control and motion", ("control", "task_space", "trajectory")),
    ("The robot and its world", ("panda", "scenes", "simulate", "verify", "arm")),
    ("The weeks' ends", ("capstone", "delivery", "pushing")),
)


def lay_out(folder: Path, filmed: Collection[str], ran: Sequence[Day]) -> None:
    """Write the site's source into a new folder.

    Args:
        folder: the new folder.
        filmed: names of the pictures that have a film.
        ran: days whose notebook has a page, which `labkit.site.notebooks` writes.
    """
    notebooks = {Path(day.folder.name, day.guide): day for day in ran}
    pages = documents()
    for page in pages:
        text = BY_WIDTH.sub(r"![\2](\1)", (ROOT / page).read_text("utf-8"))
        text = _with_films(text, page, filmed)
        text = LIVE.sub(FIGURE, _with_notebook(text, notebooks.get(page)))
        _write(folder / page, linked(text, page, pages, folder))
    front = home.page((ROOT / README).read_text("utf-8"))
    _write(folder / HOME, linked(front, HOME, pages, folder))
    for owner, caption, names in _contents(pages):
        above = f":caption: {caption}" if caption else ""
        with (folder / owner).open("a", encoding="utf-8") as file:
            file.write(CONTENTS.format(above, "\n".join(map(_entry, names))))
    shutil.copy(ROOT / ARM, folder / ARM.name)
    _write(folder / "commands.md", _commands((ROOT / "Makefile").read_text("utf-8")))
    for module in (module for _, modules in _modules() for module in modules):
        _write(folder / "library" / f"{module}.md", REFERENCE.format(module))


def _entry(name: str) -> str:
    """Return a page, or a title and a page, as a line of a table of contents."""
    return name.replace("<", "</") if "<" in name else f"/{name}"


def documents() -> set[Path]:
    """Return the documents that are pages of the site, from the repository's top."""
    return {p.relative_to(ROOT) for each in DOCUMENTS for p in ROOT.glob(each)}


def linked(text: str, page: Path, pages: set[Path], folder: Path) -> str:
    """Return a document whose links to files lead to pages of theirs.

    Args:
        text: Markdown.
        page: where the document is, from the repository's top.
        pages: the documents that are pages.
        folder: the site's source, where a page is written for each other file.
    """

    def lead(found: re.Match[str]) -> str:
        target = (ROOT / page.parent / found[1]).resolve()
        name = target.relative_to(ROOT)
        if name in pages or not target.is_file():
            return found[1]  # Sphinx says what leads nowhere
        if name == ARM:  # a page at the site's top
            return "../" * (len(page.parts) - 1) + name.name
        copy = folder / name
        if target.suffix in PICTURES:
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(target, copy)
            return found[1]
        _write(copy.with_name(copy.name + ".md"), _file_page(target, name))
        return found[1] + ".md"

    return LINK.sub(lead, text)


def _with_films(text: str, page: Path, filmed: Collection[str]) -> str:
    """Return a document with a link below each picture that has a film.

    page.js plays it in the picture's place; without WebGL the picture stays alone.
    """
    up = "../" * (len(page.parts) - 1)

    def add(found: re.Match[str]) -> str:
        if found[1] not in filmed:
            return found[0]
        link = f'<a href="{up}_static/{FILMS}/{found[1]}.html">Play it in 3D</a>'
        return f'{found[0]}\n\n```{{raw}} html\n<p class="film">{link}</p>\n```'

    return PICTURE.sub(add, text)


def _with_notebook(text: str, day: Day | None) -> str:
    """Return a day's guide with a link to its notebook below the title."""
    if day is None:
        return text
    title, rest = text.split("\n\n", 1)
    link = f"[The lab as a notebook, run from top to bottom](../{notebook_of(day)})"
    if address := colab_of(day, os.environ.get("GITHUB_REPOSITORY", "")):
        link = f"[Do this day in Colab, without set-up]({address}), or read it: {link}"
    return f"{title}\n\n{link}\n\n{rest}"


def colab_of(day: Day, repository: str) -> str:
    """Return the address at which Colab opens a day's notebook, "" if there is none.

    Args:
        day: from its manifest.
        repository: "owner/name" on GitHub; its branch has the notebooks of all days,
            which the site's workflow writes.
    """
    if not repository:
        return ""
    return f"{COLAB}/{repository}/blob/{BRANCH}/{day.notebook.name}"


def notebook_of(day: Day) -> Path:
    """Return where the page of a day's notebook is, in its week's folder."""
    return Path("notebooks", Path(day.script).stem + ".md")


def _file_page(file: Path, name: Path) -> str:
    """Return a page that shows a file of the repository."""
    fence = "`" * 8
    language = LANGUAGE.get(file.suffix, "text")
    body = file.read_text("utf-8")
    head = f"---\norphan: true\n---\n# `{name.as_posix()}`\n"
    return f"{head}{fence}{language}\n{body}{fence}\n"


def _commands(makefile: str) -> str:
    """Return a page with a table of the commands of `make`, which a search finds.

    Each row has an entry in the index, so that a search for `make hint` leads to it.
    """
    found = VERB.findall(makefile)
    verbs = sorted(found, key=lambda verb: (verb[1] == "", verb[1]))
    parts = [COMMANDS]
    for heading, some in (
        ("The commands of a day", [verb for verb in verbs if verb[1]]),
        ("All other commands", [verb for verb in verbs if not verb[1]]),
    ):
        rows = "".join(_row(name, says) for name, _, says in some)
        parts.append(TABLE.format(heading, rows))
    return "\n".join(parts)


def _row(name: str, says: str) -> str:
    """Return a row of the table of commands, with an anchor of its own."""
    return ROW.format(name, _sentence(says).replace("`", "``"))


def _sentence(words: str) -> str:
    """Return words with a capital and a full stop; what is typed becomes code."""
    first = words.split()[0]
    start = words[0].upper() if "/" not in first else words[0]
    said = TYPED.sub(r"`\g<0>`", start + words[1:])
    return said if words.endswith((".", "?")) else f"{said}."


def _modules() -> Iterator[tuple[str, Sequence[str]]]:
    """Yield the library's modules by what they are about, then a later week's."""
    yield from MODULES
    named = {module for _, modules in MODULES for module in modules}
    for week in weeks():
        new = [m for day in days_of(week) for m in day.library if m not in named]
        if new:
            yield week.heading, new


def _contents(pages: set[Path]) -> Iterator[tuple[str, str, Sequence[str]]]:
    """Yield page, caption and pages below it, as the site's margin folds them.

    A week's days are below its page, a day's worksheet is below its guide, and the
    library's modules are below its list.
    """
    rest = {page.with_suffix("").as_posix() for page in pages - {README}}
    front = HOME.name
    yield front, "", [f"Start <{README.with_suffix('')}>", "arm", "commands"]
    top = []
    for week in weeks():
        start = f"{week.folder.name}/"
        own = start + "README"
        guides = []
        for day in days_of(week):
            guide, sheet = (
                start + n.removesuffix(".md") for n in (day.guide, day.worksheet)
            )
            guides += [guide] if guide in rest else []
            if {guide, sheet} <= rest:
                yield f"{guide}.md", "", [sheet]
            rest -= {guide, sheet}
        more = sorted(page for page in rest if page.startswith(start) and page != own)
        rest -= {own, *more}
        yield f"{own}.md", "", [*guides, *more]
        top.append(own)
    yield front, "Days", top
    modules = [f"library/{module}" for _, some in _modules() for module in some]
    yield f"{LIBRARY}.md", "", modules
    yield front, "Reference", [LIBRARY]
    yield front, "Teaching and making", sorted(rest - {LIBRARY})


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, "utf-8", newline="\n")
