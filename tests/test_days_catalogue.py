"""What is in the days' catalogues: its verdict, and what it does as a lab.

All of a day that has changed, and a sample of another one: `whole.py`.
"""

import itertools
import re

import inprocess
import pytest
from catalogue import STATUS, entries, run_as_lab, told
from whole import asked, changed

from conftest import days
from labkit.author import stops
from labkit.judge.guard import quiet
from labkit.judge.row import rows_of

pytestmark = pytest.mark.kit

DAYS = days()
# A word with a capital letter after a colon, and not the text of an exception.
CAPITAL = re.compile(r": (?!True |False |None )[A-Z][a-z]+ [a-z]")
CODE = re.compile(r"`[^`]*`")


def functions(day):
    """Return the entries of each function of a day, and its files."""
    groups = itertools.groupby(entries(day), lambda one: one.group)
    return [(name, list(some)) for name, some in groups]


FUNCTIONS = [
    pytest.param(day, some, id=f"day{day.number}/{name}")
    for day in DAYS
    for name, some in asked(day, functions(day), "verdicts")
]


@pytest.fixture(scope="module", autouse=True)
def _once():
    with inprocess.worked_out_once():
        yield


@pytest.mark.parametrize("day", DAYS, ids=lambda day: f"day{day.number}")
def test_the_catalogue_has_files_of_every_task(day):
    asked = {task.id for task in day.tasks}
    judged = {t for one in entries(day, "wrong", "close") for t in one.tasks}
    assert judged == asked


@pytest.mark.parametrize("day", DAYS, ids=lambda day: f"day{day.number}")
def test_each_line_of_a_table_of_mistakes_has_a_sentence_and_an_answer(day):
    names = [name for name, _ in asked(day, functions(day), "verdicts")]
    rows = rows_of(day)
    with quiet():
        faults = [
            f"{name}: {fault}"
            for name in names
            if name in rows
            for table in rows[name].tables
            for fault, _ in stops.of_table(table, rows[name].ask.main)
        ]
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize(("day", "some"), FUNCTIONS)
def test_a_file_is_told_what_the_catalogue_says(day, some):
    differ = []
    for one in some:
        status = STATUS[one.status]
        fine = (status, "todo" if status == "wrong" else status)
        for task, verdict in told(day, one).items():
            if not (one.is_told(verdict) and verdict.status in fine):
                said = verdict.mistake or verdict.status
                differ.append(f"{one.name} ({task}): {said}. {verdict.message}")
            if CAPITAL.search(CODE.sub("", verdict.message)):
                differ.append(f"{one.name} ({task}): a capital. {verdict.message}")
    assert not differ, "\n".join(differ)


@pytest.mark.parametrize("day", DAYS, ids=lambda day: f"day{day.number}")
def test_a_wrong_file_run_as_a_lab_fails(day, run):
    # In a process of its own: it forks, and what ran before may hold much memory.
    which = "--labs" if changed(day) else "--some-labs"
    done = run("tests/catalogue.py", day.number, which, timeout=900)
    assert done.returncode == 0, f"the lab passes: {done.stdout}{done.stderr[-500:]}"


@pytest.mark.parametrize("day", DAYS, ids=lambda day: f"day{day.number}")
def test_a_lab_passes_without_its_side_quests(day):
    def undo(lab):
        for task in day.tasks:
            if task.optional:
                vars(lab).update(dict.fromkeys(task.functions, undone))

    def undone(*_):
        raise NotImplementedError("a task")

    assert run_as_lab(day, undo) == 0
