"""Consistency of a day's files: regions, rows, headings, links, hints, sections."""

import inspect
import re
from collections.abc import Iterator

from labkit.author import hints
from labkit.author.blank import worksheet_of
from labkit.base import git
from labkit.base.exchange import Exchange, Question
from labkit.handin.worksheet import split_sections
from labkit.judge.answers import InTurn
from labkit.judge.ask import Draw, stacked
from labkit.judge.row import Row, row_of
from labkit.judge.written import faults as row_faults
from labkit.lesson.day import Day, all_days
from labkit.lesson.lab_module import definition, read_script
from labkit.lesson.starter import find_regions
from robo47.paths import ROOT, shown

# `make new` writes these texts for an author to replace, by the file's ending.
SKELETON = {
    "day.toml": ("the method of the day, then what its lab shows",),
    "-lab.md": (
        "Begin with something that the reader can see",
        "A book with its chapter",
        "The answer that you would like to read",
    ),
    ".md": ("What do you want to ask?", ": what it shows"),
    "week.toml": ("what the arm can do at the end of the week",),
    "README.md": ("what this week adds to the week before",),
}


def faults_of(day: Day) -> Iterator[str]:
    """Yield what is missing or does not fit between a day's files, with its remedy."""
    parts = (
        _regions,
        _names,
        _functions,
        _guide,
        hints.faults_of,
        _links,
        _worksheet,
        _pictures,
        _library,
        _committed,
    )
    for part in parts:
        yield from part(day)


def write_worksheet(day: Day) -> bool:
    """Write a worksheet where there is none; return whether that was so."""
    path = day.folder / day.worksheet
    if not day.worksheet or path.is_file():
        return False
    path.write_text(worksheet_of(day), "utf-8", newline="\n")
    return True


def unwritten(day: Day) -> Iterator[str]:
    """Yield the files in which the skeleton's words stand for the author's."""
    own = day.own / "day.toml", day.folder / day.guide, day.folder / day.worksheet
    for path in (*own, day.folder / "week.toml", day.folder / "README.md"):
        text = " ".join(path.read_text("utf-8").split()) if path.is_file() else ""
        for ending, words in SKELETON.items():
            left = [one for one in words if path.name.endswith(ending) and one in text]
            for one in left:
                yield f'{shown(path)} still has the words of the skeleton: "{one}"'


def _regions(day: Day) -> Iterator[str]:
    manifest = shown(day.own / "day.toml")
    source = shown(day.source)
    wanted = {(task.id, name) for task in day.tasks for name in task.functions}
    text = read_script(day.source)
    regions = find_regions(text, source)
    found = {(region.task, region.function): region.start + 1 for region in regions}
    written = {one for one in wanted if definition(text, one[1])}
    for task, name in sorted(written - set(found)):
        yield (
            f"{source}: no region {task} in {name}, which {manifest} asks for. Put "
            f"`# region {task}` and `# endregion {task}` around its body"
        )
    for task, name in sorted(set(found) - wanted):
        yield (
            f"{source}, line {found[task, name]}: region {task} in {name}, which "
            f"{manifest} does not know. Add it to the functions of task {task}"
        )


def _names(day: Day) -> Iterator[str]:
    """Yield the functions that another day has too: `own_functions` holds all."""
    own = {name for task in day.tasks for name in task.functions}
    for other in all_days():
        if other.number != day.number:
            theirs = {name for task in other.tasks for name in task.functions}
            for name in sorted(own & theirs):
                yield (
                    f"{shown(day.own / 'day.toml')}: day {other.number} has a function "
                    f"{name} too; give this one another name"
                )


def _functions(day: Day) -> Iterator[str]:
    names = [name for task in day.tasks for name in task.functions]
    missing = [name for name in names if not day.has(name)]
    for name in missing:
        yield (
            f"{shown(day.own / name)}.py is missing: the questions for {name} and its "
            "mistakes (docs/authors.md, section 3)"
        )
    for name in (one for one in names if one not in missing):
        row = row_of(day, name)
        if not callable(getattr(row.lab, name, None)):
            yield (
                f"{shown(day.source)}: no function {name}, which "
                f"{shown(day.own / 'day.toml')} asks for"
            )
            continue
        calls = row.ask.inputs
        file = f"{shown(day.own)}/{name}.py"
        first = next(iter(calls(Draw(0))))
        if not _needed(row) <= len(first) <= len(row.arguments):
            yield (
                f"{file}: @row.inputs yields {len(first)} arguments; "
                f"{name} takes {len(row.arguments)}: {', '.join(row.arguments)}"
            )
            continue
        if isinstance(row.ask.truth, InTurn):  # it reports what does not fit
            row.ask.truth(*stacked([Exchange(Question("", name, tuple(first)))]))
        task = next(one for one in day.tasks if name in one.functions)
        for says in row_faults(row.ask, task.seconds / len(task.functions)):
            yield f"{file}: {says}"


def _needed(row: Row) -> int:
    """Return how many arguments a function has to be given."""
    taken = inspect.signature(getattr(row.lab, row.function)).parameters.values()
    return sum(one.default is inspect.Parameter.empty for one in taken)


def _guide(day: Day) -> Iterator[str]:
    path = day.folder / day.guide
    if not path.is_file():
        yield f"{shown(path)} is not there; it is the guide"
        return
    headings = re.findall(r"^#+ (.+)$", path.read_text("utf-8"), re.MULTILINE)
    for task in day.tasks:
        section = task.read.partition(";")[0].removeprefix("Lab guide, ")
        if section not in headings:
            yield (
                f"{shown(day.own / 'day.toml')}, task {task.id}: {shown(path)} has no "
                f"heading {section!r}; it has {', '.join(map(repr, headings[1:]))}"
            )


def _links(day: Day) -> Iterator[str]:
    """Yield what the guide links to and is not there."""
    path = day.folder / day.guide
    text = path.read_text("utf-8") if path.is_file() else ""
    for link in re.findall(r"\]\((?!\w+:|#)([^)#\s]+)", text):
        if not (path.parent / link).exists():
            yield f"{shown(path)}: {link} is not there"


def _committed(day: Day) -> Iterator[str]:
    """Yield a student's file in the repository: the next clone would begin with it."""
    work = shown(day.work.parent)
    try:
        done = git.run("ls-files", "--", work, folder=ROOT, seconds=git.SECONDS)
    except git.GitError:
        return
    if names := done.stdout.split():
        yield f"git holds {names[0]}; take it out: git rm -r --cached {work}"


def _worksheet(day: Day) -> Iterator[str]:
    """Yield the sections that a worksheet lacks."""
    if not day.worksheet:
        return
    path = day.folder / day.worksheet
    there = split_sections(path.read_text("utf-8"))
    for name in split_sections(worksheet_of(day)):
        asked = [one for one in there if one.startswith(name.partition(":")[0])]
        if name and name != "predictions" and not asked:
            yield f"{shown(path)}: no section {name!r}, which day.toml asks for"


def _pictures(day: Day) -> Iterator[str]:
    file = day.own / "figures.py"
    if day.draw and f'"{day.draw}"' not in (file.read_text() if file.is_file() else ""):
        yield f"{shown(file)}: FIGURES has no {day.draw!r}, which day.toml draws"


def _library(day: Day) -> Iterator[str]:
    """Yield the modules of the day's answers that no file of tests is about."""
    tests = [path.read_text("utf-8") for path in (ROOT / "tests").glob("test_*.py")]
    for module in day.library:
        name = module.rpartition(".")[2]
        file = f"robo47/{module.replace('.', '/')}.py"
        if not any(re.search(rf"\b{name}\b", text) for text in tests):
            yield (
                f"no test is about {file}, which students are judged by. Hold it "
                f"against what somebody else wrote, in tests/test_{name}.py"
            )
