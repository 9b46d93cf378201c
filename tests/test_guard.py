"""A search of the checker that stops costs a student the name, and nothing else."""

import warnings

import numpy as np
import pytest
from inprocess import verdicts
from judged import judged, judged_replies, right

from labkit.base.exchange import Reply
from labkit.check import tasks
from labkit.judge import judge as judging
from labkit.judge.ask import Ask
from labkit.judge.guard import LOUD, REPORT, attempt
from labkit.judge.judge import judge
from labkit.judge.kinds import Scalar, Vector
from labkit.judge.matrix_kinds import Symmetric
from labkit.judge.other_kinds import Count, Points, Word
from labkit.lesson.day import find_day
from robo47.errors import FaultError

SPOTS = (
    *("_explained", "_located", "what_is_wrong", "failing_call"),
    *("_further", "_measured", "_case"),
)
# Trimmed ICP: only the nearer half of the pairs is fitted.
TRIMMED = """kabsch(
        source[away.min(axis=1) <= np.median(away.min(axis=1))],
        target[np.argmin(away, axis=1)][
            away.min(axis=1) <= np.median(away.min(axis=1))
        ],
    )"""


def stops(*_):
    """Stop as a search does that meets an answer of which nobody thought."""
    return int(np.inf)


def asking(**hooks):
    """Return the row of a function that doubles a number."""
    return Ask(
        inputs=lambda rng: [(np.array(float(i)),) for i in range(1, 7)],
        kind=Scalar(),
        truth=lambda x: 2.0 * x,
        **hooks,
    )


@pytest.fixture
def student(monkeypatch):
    """Let the checker run as a student runs it."""
    monkeypatch.delenv(LOUD)


@pytest.mark.parametrize("hook", ["unnamed", "measured"])
def test_a_hook_that_stops_leaves_the_general_finding(student, hook):
    ask = asking(**{hook: stops})
    found = judged(ask, right(ask)[0] + np.array([0.3, -0.1, 0.7, 0.2, 0.9, 0.4]))
    assert found.status == "wrong"
    assert "Largest error: 0.9." in found.message
    assert "OverflowError in tests/test_guard.py, line" in found.message
    assert found.message.endswith(REPORT)
    assert found.call


def test_the_same_hook_stops_the_check_of_an_author():
    ask = asking(unnamed=stops)
    with pytest.raises(OverflowError):
        judged(ask, right(ask)[0] + np.array([0.3, -0.1, 0.7, 0.2, 0.9, 0.4]))


@pytest.mark.parametrize("spot", SPOTS)
def test_wherever_the_search_stops_a_wrong_answer_is_wrong(student, monkeypatch, spot):
    monkeypatch.setattr(judging, spot, stops)
    ask = asking()
    found = judged(ask, right(ask)[0] + np.array([0.3, -0.1, 0.7, 0.2, 0.9, 0.4]))
    assert found.status == "wrong"
    assert found.message.endswith(REPORT)


def test_what_cannot_be_compared_is_not_judged(student, monkeypatch):
    monkeypatch.setattr(judging, "right_answers", stops)
    found = judged(asking(), np.ones(6))
    assert (found.status, found.mistake) == ("todo", "unjudged")
    assert found.message.endswith(REPORT)


def test_a_right_answer_is_told_of_no_search():
    ask = asking(unnamed=stops, measured=None)
    assert judged(ask, right(ask)[0]).message == ""


def test_one_task_without_a_verdict_leaves_the_others_theirs(student, monkeypatch):
    day = find_day(1)

    def some(asked, *rest):
        return stops() if asked.function == "quat_to_R" else judge(asked, *rest)

    monkeypatch.setattr(tasks, "judge", some)
    found = verdicts(day, day.source, fresh=8)
    assert found["1.4"].mistake == "unjudged"
    others = {one.status for id, one in found.items() if id != "1.4"}
    assert others == {"passed"}


def test_a_machine_that_fails_is_no_search_that_stops(student):
    def fails():
        raise FaultError("no process")

    with pytest.raises(FaultError):
        attempt(fails)


def test_code_that_the_checker_tries_warns_nobody(monkeypatch):
    def loud(*_):
        compile("3 is 3", "tried", "eval")
        warnings.warn("Casting complex values to real", stacklevel=2)

    ask = asking(unnamed=loud)
    with warnings.catch_warnings(action="error"):
        found = judged(ask, right(ask)[0] + np.array([0.3, -0.1, 0.7, 0.2, 0.9, 0.4]))
    assert found.status == "wrong"


@pytest.mark.parametrize("value", [np.inf, -np.inf, np.nan, 1e300])
def test_a_count_that_is_no_number_can_be_shown(value):
    assert isinstance(Count().sent(np.array(value)), float | int)
    assert Word(words=("yes", "no")).sent(np.array(value)) == "?"


def test_truth_values_are_numbers_before_a_row_sees_them():
    (read,) = Vector((2,)).read([np.array([True, False])])
    assert read.dtype == np.float64


def test_a_matrix_of_the_largest_numbers_has_no_eigenvalue():
    S = np.full((1, 3, 3), 1e308)
    with np.errstate(all="ignore"):
        assert Symmetric((3, 3)).measured(S, np.eye(3)[None])[-1].endswith("nan")


@pytest.mark.parametrize(
    ("number", "function", "old", "new"),
    [
        (12, "segment_free_of_discs", "axis=1) > discs", "axis=1) >= discs"),
        (
            12,
            "segment_free_of_discs",
            "np.clip(part, 0.0, 1.0)[:, None]",
            "part[:, None]",
        ),
        (10, "icp_step", "kabsch(source, target[np.argmin(away, axis=1)])", TRIMMED),
    ],
)
def test_a_world_without_numbers_and_an_empty_choice_are_judged(
    tmp_path, number, function, old, new
):
    day = find_day(number)
    text = day.source.read_text("utf-8")
    assert old in text
    file = tmp_path / day.source.name
    file.write_text(text.replace(old, new, 1), "utf-8")
    found = verdicts(day, file)
    wrong = next(task.id for task in day.tasks if function in task.functions)
    assert found[wrong].status == "wrong"
    assert all(v.status in ("passed", "todo") for t, v in found.items() if t != wrong)


def told_of(ask, values):
    found = judged(ask, values)
    return f"{found.message} {found.call}"


def test_the_entry_that_is_shown_is_one_that_differs():
    right_one = np.array([np.inf, -np.inf])
    ask = Ask(
        inputs=lambda rng: [(np.array(float(i)),) for i in range(4)],
        kind=Vector((2,)),
        truth=lambda x: np.broadcast_to(right_one, (len(x), 2)),
    )
    says = told_of(ask, np.tile([np.inf, 4.0], (4, 1)))
    assert "f(1)[1] returned 4; expected -inf." in says
    assert "is inf, and inf" not in says


def test_a_small_difference_has_a_digit_and_rounding_has_none():
    kind = Scalar()
    assert kind.apart(np.array([1.0 + 6.2e-6]), np.ones(1)) == "6e-06"
    assert kind.apart(np.array([1.0 + 2e-16]), np.ones(1)) == "0"
    off = np.array([[0.0, 0.0, 6.2e-6]])
    assert Points((1, 3)).apart(off[None], np.zeros((1, 1, 3))).startswith("6e-06")


def test_one_array_is_not_a_number_of_results():
    ask = Ask(
        inputs=lambda rng: [(np.array(float(i)),) for i in range(4)],
        kind=(Scalar(), Scalar()),
        truth=lambda x: (x, x),
    )
    found = judged_replies(ask, [Reply(value=np.ones(7), again=np.ones(7))] * 4)
    assert "returns one array of shape (7,); expected 2 results" in found.message
