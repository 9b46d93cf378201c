"""The checker's verdicts as the page shows them: the parts of a card."""

import pytest

pytest.importorskip("viser", reason="the extra view")

from labkit.check.tasks import TaskResult
from labkit.inspector import words
from labkit.inspector.standing import standing
from labkit.judge.mistake import Verdict
from labkit.lesson.day import find_day

pytestmark = pytest.mark.kit

TASKS = find_day(1).tasks
PASSED = TaskResult(TASKS[0], Verdict("passed"))
SWAPPED = "sin and cos are swapped"
WRONG = TaskResult(TASKS[1], Verdict("wrong", "swapped", SWAPPED, function="Rz"))
TODO = TaskResult(TASKS[2], Verdict("todo", "unwritten", "not written yet"))
NEXT, TITLE = ", ".join(TASKS[2].functions), TASKS[2].title


@pytest.mark.parametrize(
    ("tasks", "kind", "says"),
    [
        ((PASSED,), "good", ("make check", "1 of 1 pass", "All tasks pass.")),
        ((PASSED, WRONG, TODO), "bad", ("1.2 Rz", "1 of 3 pass", SWAPPED)),
        ((PASSED, TODO), "quiet", (f"Next: 1.3 {NEXT}", "1 of 2 pass", TITLE)),
    ],
)
def test_a_title_a_count_and_a_sentence_say_how_the_day_stands(tasks, kind, says):
    found = standing(tasks)
    assert found.kind == kind
    assert (found.title, found.count, found.sentence) == says
    assert found.tasks == tasks


def test_the_card_sets_code_as_code_and_escapes_what_students_wrote():
    html = words.card("1.2 Rz", "1 of 3 pass", "`a < b` is <i>.", "bad")
    assert "<b>✗ 1.2 Rz</b> <span>1 of 3 pass</span>" in html
    assert "<div><code>a &lt; b</code> is &lt;i&gt;.</div>" in html
    assert words.card("make check", "", "", "quiet") == ""  # no file yet


def test_a_file_that_does_not_load_is_one_line_and_no_list_of_the_same():
    why = Verdict("todo", "does-not-load", "day.py, line 3: SyntaxError")
    broken = [TaskResult(task, why) for task in TASKS[:3]]
    found = standing(broken)
    assert found.sentence == "day.py, line 3: SyntaxError"
    assert [result.verdict.message for result in found.tasks] == ["", "", ""]
