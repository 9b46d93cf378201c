"""Insert fresh outputs into the documents, or check that the ones there still hold.

    make docs                                run the commands, rewrite outputs
    python3 scripts/build_docs.py            the same
    python3 scripts/build_docs.py --check    change nothing, exit 1 at a drift
    make docs DAY=8                          its own, and what lists it

A document asks for an output between two comments:

    <!-- run: python src/LAB.py --no-log | step 2 -->
    <!-- end -->

`| step N` keeps one numbered step of it, `| head N` and `| tail N` its ends; `| table`
takes it for a table, not for text. And for the list of a week's days, from their
manifests (`w*`: of every week), or a table for authors, of the code (`kinds` or
`limits`):

    <!-- days: w1-foundations -->
    <!-- end -->
    <!-- table: kinds -->
    <!-- end -->

`functions: by day` lists the library's functions, `functions: simulate` a module's.
"""

import functools
import math
import os
import re
import shlex
import sys
from collections.abc import Mapping, Sequence
from fnmatch import fnmatch
from pathlib import Path

from labkit.author.tables import TABLES
from labkit.base import cli, processes
from labkit.base.text import Maker, refill
from labkit.lesson.day import Day, days_of, find_day
from labkit.lesson.functions import functions_list
from labkit.lesson.week import weeks
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

SMALL = "figures/day{}_small.png"  # a day's thumbnail in its week's folder
COLUMNS = 4  # of the table of thumbnails: as many as a README on GitHub has room for
FUNCTIONS = ROOT / "docs" / "library.md"  # the page of the library, by day
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
TABLE = "table"  # asks for an output that is Markdown already
ROUNDING = 1e-9  # errors this small differ between processors, and should
OLD_ZERO = re.compile(r"(?<![\d.])0(?:\.0+)?e[-+]?\d+")  # a lab prints such as 0
# These lines depend on the source of the robot, and on which of equal errors is first.
VARIES = re.compile(r"^robot: .*|worst at \S+|where q = .*", re.MULTILINE)


@functools.cache
def output_of(command: str) -> str:
    """Return what a command prints; `python` and `make` are this environment's."""
    words = shlex.split(command)
    known = {"python": [sys.executable], "make": ["make", "--no-print-directory"]}
    words[:1] = known[words[0]]
    # A lab is named as from its week's folder, and runs there.
    folders = (week.folder for week in weeks() if words[1].startswith("src/"))
    there = next((path for path in folders if (path / words[1]).is_file()), ROOT)
    variables = {**os.environ, "COLUMNS": "80"}
    done = processes.run(words, env=variables, cwd=there)
    # A check of a wrong file ends with 1, and that is the output that is wanted.
    if done.returncode not in (0, *([1] if "check_day" in command else [])):
        raise Robo47Error(f"`{command}` failed: {done.stderr.strip()[-300:]}")
    return done.stdout


def requested_output(request: str) -> str:
    """Return the output that a document asks for."""
    command, _, part = (piece.strip() for piece in request.partition("|"))
    text = output_of(command)
    if part in ("", TABLE):
        return text
    kind, number = part.split()
    lines = text.splitlines(keepends=True)
    if kind == "step":
        found = re.search(rf"^{number}\. .*?(?=^\d+\. |^\n|\Z)", text, re.M | re.DOTALL)
        if not found:
            raise Robo47Error(f"`{command}` prints no step {number}")
        return found.group()
    return "".join(lines[: int(number)] if kind == "head" else lines[-int(number) :])


def same(old: str, new: str) -> bool:
    """Return whether two outputs say the same, but for rounding and for the source."""
    old, new = VARIES.sub("", old), VARIES.sub("", new)
    if NUMBER.sub("#", old).split() != NUMBER.sub("#", new).split():
        return False
    if OLD_ZERO.search(old) and not OLD_ZERO.search(new):
        return False
    numbers = (map(float, NUMBER.findall(each)) for each in (old, new))
    close = functools.partial(math.isclose, rel_tol=1e-9, abs_tol=ROUNDING)
    return all(map(close, *numbers))


def days_list(wanted: str, folder: Path) -> str:
    """Return a table of captioned pictures, one per day, with links to the guides.

    A document that lists one week alone also has a line for each of its days.

    Args:
        wanted: the name of its folder; `w*` is every week.
        folder: of the document.
    """
    parts, soon = [], []
    for week in (w for w in weeks() if fnmatch(w.folder.name, wanted)):
        unwritten = {one.number: one.title for one in week.soon}
        alone = week.folder.name == wanted
        cards, lines = [], []
        for day in days_of(week):
            unwritten.pop(day.number, None)
            guide = _between(folder, day.folder / day.guide)
            cards += _card(day, guide, folder, _method(day) if alone else day.see)
            lines.append(
                f"- **[Day {day.number}: {day.title}]({guide})**: {_says(day)}"
            )
        soon += [f"Day {n}, {title}" for n, title in sorted(unwritten.items())]
        if cards:
            parts += [*([] if alone else [f"**{week.heading}**"]), _grid(cards)]
        if not cards or alone:
            parts.append("\n".join(lines))
    parts += [f"- Not written yet: {'; '.join(soon)}"] if soon else []
    return "\n\n".join(parts) + "\n"


def _method(day: Day) -> str:
    """Return a day's method, or "" if the title begins with it."""
    named = day.title.lower().startswith(day.method.lower())
    return "" if named else day.method


def _says(day: Day) -> str:
    """Return what a day shows, without a method that the title has named."""
    return day.see if _method(day) else day.result


def _between(folder: Path, path: Path) -> str:
    """Return how a document in a folder names a file."""
    return Path(os.path.relpath(path, folder)).as_posix()


def _card(day: Day, guide: str, folder: Path, says: str) -> list[tuple[str, str]]:
    """Return a day's picture and the words below it, or none without a picture."""
    small = _between(folder, day.folder / SMALL.format(day.number))
    if not (folder / small).is_file():
        return []
    picture = f"[![A picture of day {day.number}]({small})]({guide})"
    title = f"**[Day {day.number}: {day.title}]({guide})**"
    return [(picture, f"{title}<br>{says[0].upper()}{says[1:]}" if says else title)]


def _grid(cards: Sequence[tuple[str, str]]) -> str:
    """Return cards as a table, a row of pictures above a row of their words."""
    full = [*cards, *[("", "")] * (-len(cards) % COLUMNS)]
    groups = [full[i : i + COLUMNS] for i in range(0, len(full), COLUMNS)]
    rows = [row for group in groups for row in zip(*group, strict=True)]
    lines = [f"| {' | '.join(row)} |" for row in rows]
    return "\n".join([lines[0], "|" + "---|" * COLUMNS, *lines[1:]])


def rebuilt(
    document: str, folder: Path = ROOT, *, tables: bool = False
) -> tuple[str, list[str]]:
    """Return the document with fresh outputs, and the requests that had drifted.

    Args:
        document: its text.
        folder: where it is, for the links in it.
        tables: run nothing, renew the tables of days alone.
    """
    drifted = []

    def renewed(request: str, old: str, body: str) -> str:
        if same(old, body):
            return old
        drifted.append(request)
        return body

    def run(request: str, old: str) -> str:
        text = requested_output(request).rstrip()
        whole = request.endswith(f"| {TABLE}")
        return renewed(
            request, old, f"{text}\n" if whole else f"```text\n{text}\n```\n"
        )

    def days(request: str, old: str) -> str:
        return renewed(request, old, days_list(request, folder))

    def functions(request: str, old: str) -> str:
        return renewed(request, old, functions_list(request))

    def table(request: str, old: str) -> str:
        return renewed(request, old, TABLES[request.strip()]())

    makers: dict[str, Maker] = {"days": days, "functions": functions, "table": table}
    return refill(document, makers if tables else makers | {"run": run}), drifted


def documents() -> list[Path]:
    """Return every document in which an output may stand."""
    paths = [ROOT / "README.md", ROOT / "bench" / "README.md", FUNCTIONS]
    paths += [ROOT / "docs" / "authors.md"]
    paths += [path for week in weeks() for path in sorted(week.folder.rglob("*.md"))]
    return [path for path in paths if path.is_file()]


def documents_of(day: Day) -> dict[Path, bool]:
    """Return a day's documents and those that list it, and whether in a table alone."""
    names = filter(None, (day.guide, day.worksheet, "README.md"))
    own = [path for name in names if (path := day.folder / name).is_file()]
    shared = filter(Path.is_file, (ROOT / "README.md", FUNCTIONS))
    return dict.fromkeys(own, False) | dict.fromkeys(shared, True)


def renew(asked: Mapping[Path, bool], check: bool = False) -> int:
    """Rebuild or check documents; return how many outputs were not as they are today.

    Args:
        asked: the documents, and whether their tables alone.
        check: write nothing.
    """
    drift = 0
    for path, tables in asked.items():
        text, drifted = rebuilt(path.read_text("utf-8"), path.parent, tables=tables)
        for request in drifted:
            print(f"{shown(path)}: {'drifted' if check else 'new'}: {request}")
        drift += len(drifted)
        if drifted and not check:
            # The same line ends on every platform.
            path.write_text(text, "utf-8", newline="\n")
    return drift


def main() -> int:
    """Rebuild or check every document, or a day's."""
    parser = cli.parser(__doc__)
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    parser.add_argument("--day", type=cli.day, metavar="N", help="its documents alone")
    options = parser.parse_args()
    if options.day is not None:
        asked = documents_of(find_day(options.day))
    else:
        asked = dict.fromkeys(documents(), False)
    drift = renew(asked, options.check)
    state = "drifted" if options.check else "renewed"
    print(f"{len(asked)} documents, {drift} outputs {state}")
    return cli.EXIT_FAILED if drift and options.check else cli.EXIT_OK
