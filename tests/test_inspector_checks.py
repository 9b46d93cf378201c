"""The checker's verdicts as the page has them in one line."""

import pytest

pytest.importorskip("viser", reason="the extra view")

from labkit.check.tasks import TaskResult
from labkit.inspector.common_tabs import standing
from labkit.judge.mistake import Verdict
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit

TASKS = find_day(1).tasks
PASSED = TaskResult(TASKS[0], Verdict("passed"))
WRONG = TaskResult(TASKS[1], Verdict("wrong", "swapped", "sin and cos are swapped"))
TODO = TaskResult(TASKS[2], Verdict("todo", "unwritten", "not written yet"))


@pytest.mark.parametrize(
    ("tasks", "kind", "says"),
    [
        ((PASSED,), "good", "1 of 1 tasks pass"),
        ((PASSED, WRONG, TODO), "bad", "1 of 3 tasks pass. 1.2: sin and cos"),
        ((PASSED, TODO), "quiet", "1 of 2 tasks pass; next is 1.3 The inverse"),
    ],
)
def test_one_line_says_how_the_day_stands(tasks, kind, says):
    found = standing(tasks)
    assert found.kind == kind
    assert says in found.headline
    assert found.tasks == tasks


def test_a_file_that_does_not_load_is_one_line_and_no_list_of_the_same():
    why = Verdict("todo", "does-not-load", "day.py, line 3: SyntaxError")
    broken = [TaskResult(task, why) for task in TASKS[:3]]
    found = standing(broken)
    assert found.headline == "make check: day.py, line 3: SyntaxError"
    assert [result.verdict.message for result in found.tasks] == ["", "", ""]
