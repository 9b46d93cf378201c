"""Every file of the catalogue through the real checker: sandbox, judge, second look."""

import pytest
from submissions.catalogue import submissions

from robo47.checker.sandbox import Sandbox
from robo47.checker.tasks import check_tasks
from robo47.lesson.day import find_day

DAY = find_day(1)
# Where the checker knows more than the judge, who sees numbers alone.
KNOWS_MORE = {
    "right/general_inverse 1.3": ("close", "general-inverse"),
    "wrong/fk_never_filled 1.6": ("wrong", "not-by-hand"),
}
STATUS = {"right": "passed", "close": "close", "wrong": "wrong"}


@pytest.mark.parametrize(
    "submission", submissions("right", "close", "wrong"), ids=lambda s: s.name
)
def test_the_checker_says_of_a_file_what_the_catalogue_says(submission):
    with Sandbox() as sandbox:
        (result,) = check_tasks(DAY, submission.path, sandbox, submission.task)
    mistake = "" if submission.expected == "passed" else submission.expected
    status = STATUS[submission.path.parent.name]
    if mistake == "unwritten":
        status = "todo"
    expected = KNOWS_MORE.get(submission.name, (status, mistake))
    assert (result.verdict.status, result.verdict.mistake) == expected
