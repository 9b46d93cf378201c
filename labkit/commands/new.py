"""Write the skeleton of a new day, which passes its own tests; or move a day.

    make new DAY=8 WEEK=w2-autonomy NAME=identification
    python3 scripts/new_day.py 8 w2-autonomy identification
    make new DAY=12 FROM=9                    day 9 becomes day 12
    make new DAY=12 FROM=9 WEEK=w3-x NAME=imitation   there, with this name

If the week is new, the command also writes the week's files. It overwrites nothing.
The next steps are in docs/authors.md.
"""

import re
from pathlib import Path
from string import Template
from typing import Any

from labkit.author import renumber
from labkit.author.blank import worksheet_of
from labkit.base import cli
from labkit.commands import docs
from labkit.lesson.day import day_numbers, find_day, load_day
from labkit.lesson.week import weeks
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

# The files contain $number, $name and $week.
TEMPLATES = Path(__file__).parent / "templates"
# These files are copied from another week.
COPIED = ("Makefile", "src/kit.py")
LAST_DAY = 47


def new_day(number: int, week: str, name: str) -> list[Path]:
    """Write a day's skeleton, and its week's where that is new; return the files.

    Args:
        number: of the day.
        week: its week's folder, "w2-autonomy", or the number of one that is there.
        name: of its script, "identification" for src/dayN_identification.py.
    """
    _refuse(number, name)
    folder, values, begun = _week(number, week, name)
    files = {
        f"day{number}/day.toml": "day.toml",
        f"day{number}/reach.py": "function.py",
        f"day{number}/constants.py": "constants.py",
        f"day{number}/test_day{number}.py": "test.py",
        f"src/{values['script']}.py": "lab.py",
        f"docs/day{number}-lab.md": "guide.md",
    }
    written = [_write(folder / to, of, values) for to, of in files.items()]
    sheet = folder / "docs" / f"day{number}.md"
    sheet.write_text(worksheet_of(load_day(written[0])), "utf-8", newline="\n")
    if not begun:
        _list(folder / "week.toml", number)
    return [*begun, *written, sheet]


def move_day(
    old: int, number: int, week: str = "", name: str = ""
) -> renumber.Renumbering:
    """Give a day another number, and where asked for another week and name.

    Args:
        old: its number now.
        number: the new one.
        week: as for `new_day`; "" for the week that it is in.
        name: of its script; "" for the one it has.
    """
    day = find_day(old)
    name = name or Path(day.script).stem.partition("_")[2]
    _refuse(number, name)
    here = day.folder / "week.toml"
    others = [n for n in day.week.days if n != old]
    folder, _, begun = _week(number, week or day.folder.name, name)
    if folder != day.folder and not others:
        raise Robo47Error(
            f"day {old} is all that week {day.week.number} has; a week needs a day"
        )
    done = renumber.move(day, number, folder, name)
    _unlist(here, old)
    if not begun:
        _list(folder / "week.toml", number)
    return done


def _refuse(number: int, name: str) -> None:
    """Refuse a number that is taken or none, and a name that is none."""
    if not 1 <= number <= LAST_DAY or number in day_numbers():
        why = "is there already" if number in day_numbers() else "cannot be"
        raise Robo47Error(f"day {number} {why}; expected a new one, 1 to {LAST_DAY}")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
        raise Robo47Error(f"{name!r} is no name of a script; expected one like my_day")


def _week(number: int, week: str, name: str) -> tuple[Path, dict[str, str], list[Path]]:
    """Return a week's folder, what templates are filled with, and files it begins with.

    Args:
        number: of a day that it is to have.
        week: its folder, or the number of one that is there.
        name: of the day's script.
    """
    known = {str(one.number): one.folder.name for one in weeks()}
    folder = ROOT / known.get(week, week)
    values = {"number": str(number), "name": name, "script": f"day{number}_{name}"}
    values |= {"title": name.replace("_", " ").capitalize(), "week": folder.name}
    begun = [] if folder.name in known.values() else _new_week(folder, values)
    return folder, values, begun


def _new_week(folder: Path, values: dict[str, str]) -> list[Path]:
    """Write a week's own files."""
    parts = re.fullmatch(r"w(\d+)-([a-z0-9-]+)", folder.name)
    if not parts:
        raise Robo47Error(
            f"{folder.name} is no folder of a week; expected one like w2-autonomy"
        )
    if any(one.number == int(parts[1]) for one in weeks()):
        raise Robo47Error(f"week {parts[1]} is there already, in another folder")
    other = weeks()[-1]
    values |= {"weeknumber": parts[1], "weekname": parts[2]}
    values |= {"other": other.folder.name, "otherweek": str(other.number)}
    retro = f"docs/RETRO_w{parts[1]}.md"
    files = {"week.toml": "week.toml", "README.md": "README.md", retro: "RETRO.md"}
    written = [_write(folder / to, of, values) for to, of in files.items()]
    for name in COPIED:
        written.append(folder / name)
        written[-1].parent.mkdir(parents=True, exist_ok=True)
        text = (other.folder / name).read_text("utf-8")
        written[-1].write_text(text, "utf-8", newline="\n")
    return written


def _write(path: Path, template: str, values: dict[str, str]) -> Path:
    """Write a file from its template."""
    if path.exists():
        raise Robo47Error(f"{shown(path)} is there already and stays as it is")
    text = (TEMPLATES / f"{template}.txt").read_text("utf-8")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(Template(text).substitute(values), "utf-8", newline="\n")
    return path


def _list(manifest: Path, number: int) -> None:
    """Add a day to its week's, and take it from what is announced."""
    text = manifest.read_text("utf-8")
    days = re.search(r"^days = \[(.*?)\]", text, re.MULTILINE | re.DOTALL)
    if not days:
        raise Robo47Error(f"{shown(manifest)} has no line like: days = [8, 9]")
    numbers = sorted({*map(int, re.findall(r"\d+", days[1])), number})
    text = text.replace(days[0], f"days = {numbers}")
    text = re.sub(rf"\n *\{{ *number = {number}\b.*?\}},?", "", text)
    manifest.write_text(text, "utf-8", newline="\n")


def _unlist(manifest: Path, number: int) -> None:
    """Take a day from its week's."""
    text = manifest.read_text("utf-8")
    days = re.search(r"^days = \[(.*?)\]", text, re.MULTILINE | re.DOTALL)
    if days:
        numbers = sorted({*map(int, re.findall(r"\d+", days[1]))} - {number})
        text = text.replace(days[0], f"days = {numbers}")
        manifest.write_text(text, "utf-8", newline="\n")


def tell_moved(old: int, options: Any) -> int:
    """Move a day; say what was moved, and what names it and was not touched."""
    before = find_day(old).folder / "README.md"
    done = move_day(old, options.day, options.week, options.name)
    for path, to in done.files:
        print(f"moved {shown(path)} to {shown(to)}")
    day = find_day(options.day)
    listed = dict.fromkeys(filter(Path.is_file, [before]), True)
    docs.renew({**docs.documents_of(day), **listed})
    if done.left:
        print("Not touched; look at each:")
    for place in done.left:
        print(f"  {place}")
    print(f"Not touched: work/, metrics/, and files that import {day.script}.")
    print("A student's make update follows the script by its former name, was = [...].")
    print(f"Now: make author DAY={options.day}")
    return cli.EXIT_OK


def main() -> int:
    """Write the files and fill their outputs in, or move those of a day."""
    parser = cli.parser(__doc__)
    add = parser.add_argument
    add("day", type=cli.day, help="its number")
    add("week", nargs="?", default="", help="its week's folder, or a week's number")
    add("name", nargs="?", default="", help="of its script: identification")
    add("--from", dest="old", type=cli.day, metavar="N", help="the day to move")
    options = parser.parse_args()
    if options.old:
        return tell_moved(options.old, options)
    for path in new_day(options.day, options.week, options.name):
        print(f"wrote {shown(path)}")
    docs.renew(docs.documents_of(find_day(options.day)))
    n = options.day
    print(f"Now: make author DAY={n}, and docs/authors.md")
    return cli.EXIT_OK
