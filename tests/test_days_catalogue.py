"""Everything in the days' catalogues: its verdict, and what it does as a lab."""

import inprocess
import pytest
from catalogue import STATUS, Entry, entries, run_as_lab, told

from conftest import days

pytestmark = pytest.mark.kit

DAYS = days()
FILES = [
    pytest.param(day, one, id=f"day{day.number}/{one.name}")
    for day in DAYS
    for one in entries(day)
]
SHOWN = [
    pytest.param(day, one, id=f"day{day.number}/{one.name}")
    for day in DAYS
    for one in entries(day, "wrong")
    if one.runs
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


@pytest.mark.parametrize(("day", "entry"), FILES)
def test_a_file_is_told_what_the_catalogue_says(day, entry):
    status = STATUS[entry.status]
    for task, verdict in told(day, entry).items():
        assert entry.is_told(verdict), (task, verdict.mistake, verdict.message)
        assert verdict.status in (status, "todo" if status == "wrong" else status)


@pytest.mark.parametrize(("day", "entry"), SHOWN)
def test_a_wrong_file_run_as_a_lab_fails(day, entry):
    # Nearly all show at once; what shows in few places alone needs more of them.
    assert 1 in (run_as_lab(day, entry, trials) for trials in (2, 15, 50))


@pytest.mark.parametrize("day", DAYS, ids=lambda day: f"day{day.number}")
def test_a_lab_passes_without_its_side_quests(day, tmp_path):
    undone = tmp_path / "undone.py"
    gap = "def {}(*_):\n    raise NotImplementedError('task {}')\n"
    optional = [task for task in day.tasks if task.optional]
    gaps = [gap.format(name, task.id) for task in optional for name in task.functions]
    undone.write_text("".join(gaps))
    assert run_as_lab(day, Entry("undone", "right", (), "", True, undone)) == 0
