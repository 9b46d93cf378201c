"""Write the skeleton of a new day, which passes its own tests as it is.

    make new DAY=8 WEEK=w2-autonomy NAME=identification
    python3 scripts/new_day.py 8 w2-autonomy identification

A week that is not there yet gets its own files too. Nothing is overwritten. What to do
next: docs/teaching.md.
"""

import re
from pathlib import Path
from string import Template

from labkit.base import cli
from labkit.commands import docs
from labkit.lesson.day import Day, day_numbers, find_day, load_day
from labkit.lesson.week import weeks
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

TEMPLATES = Path(__file__).parent / "templates"  # with $number, $name, $week
COPIED = ("Makefile", "src/kit.py", "docs/RETRO_w{}.md")  # from another week
LAST_DAY = 47
HEAD = """\
# Day {number} worksheet

Write below each heading; what is in *(italics)* is yours to replace. `make check
DAY={number}` looks at what you have so far.
"""
PREDICTIONS = """\
## Predictions

Write the first column before you run anything: `make run` then writes what it measures
beside it, and leaves what you wrote alone. The last column is yours; if your prediction
was right, say why it could be.

| number | predicted | measured | why apart |
|---|---|---|---|
"""
PREDICTION = "| {} | *(your prediction)* | *(your number)* | *(your reason)* |\n"


def new_day(number: int, week: str, name: str) -> list[Path]:
    """Write a day's skeleton, and its week's where that is new; return the files.

    Args:
        number: of the day.
        week: its week's folder, "w2-autonomy", or the number of one that is there.
        name: of its script, "identification" for src/dayN_identification.py.
    """
    if not 1 <= number <= LAST_DAY or number in day_numbers():
        why = "is there already" if number in day_numbers() else "cannot be"
        raise Robo47Error(f"day {number} {why}; expected a new one, 1 to {LAST_DAY}")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", name):
        raise Robo47Error(f"{name!r} is no name of a script; expected one like my_day")
    known = {str(one.number): one.folder.name for one in weeks()}
    folder = ROOT / known.get(week, week)
    values = {"number": str(number), "name": name, "script": f"day{number}_{name}"}
    values |= {"title": name.replace("_", " ").capitalize(), "week": folder.name}
    begun = [] if folder.name in known.values() else _new_week(folder, values)
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
    files = [_write(folder / name, name, values) for name in ("week.toml", "README.md")]
    for name in COPIED:
        files.append(folder / name.format(parts[1]))
        files[-1].parent.mkdir(parents=True, exist_ok=True)
        text = (other.folder / name.format(other.number)).read_text("utf-8")
        text = text.replace(f"# Week {other.number}:", f"# Week {parts[1]}:")
        files[-1].write_text(text, "utf-8", newline="\n")
    return files


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


def worksheet_of(day: Day) -> str:
    """Return an empty worksheet: its terms, drawings, numbers, questions, checklist."""
    parts = [HEAD.format(number=day.number), "## Glossary\n"]
    parts += [f"### {term}\n\n*(your words)*\n" for term in day.terms]
    parts += ["## Drawings\n"] * (day.drawings > 0)
    drawn = "### Drawing {}: what it shows\n\n*(your drawing)*\n"
    parts += [drawn.format(i + 1) for i in range(day.drawings)]
    checks = dict.fromkeys(metric.check for metric in day.metrics)
    parts.append(PREDICTIONS + "".join(map(PREDICTION.format, checks)))
    parts.append("## Can you explain?\n")
    asked = "{}. What do you want to ask?\n\n   *(your answer)*\n"
    parts += [asked.format(i + 1) for i in range(day.questions)]
    boxes = [f"I ran `make run DAY={day.number}` and saw `All checks PASSED.`"]
    boxes.append(f"All tasks of `make check DAY={day.number}` pass")
    boxes += [f"My picture is `{day.files['figure']}`"] if day.figure else []
    boxes.append("The words above are mine")
    boxes += ["`metrics/metrics.csv` has my rows for the day"] if day.metrics else []
    lines = "".join(f"- [ ] {box}\n" for box in [*boxes, "I committed all of it"])
    return "\n".join([*parts, f"## Checklist\n\n{lines}"])


def main() -> int:
    """Write the files and fill their outputs in."""
    parser = cli.parser(__doc__)
    add = parser.add_argument
    add("day", type=cli.day, help="its number")
    add("week", help="its week's folder, or the number of one that is there")
    add("name", help="of its script: identification")
    options = parser.parse_args()
    for path in new_day(options.day, options.week, options.name):
        print(f"wrote {shown(path)}")
    docs.renew(docs.documents_of(find_day(options.day)))
    n = options.day
    print(f"Now: make author DAY={n}, and docs/teaching.md")
    return cli.EXIT_OK
