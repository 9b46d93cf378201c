"""The contract: questions, answers and verdicts."""

import subprocess
import sys

import numpy as np
import pytest

from robo47.diagnose import MODEL, TASK_FUNCTIONS, Answer, calls, judge
from robo47.diagnose.truth import right_answers

TASKS = list(TASK_FUNCTIONS)


def right(task):
    """Return the right answers to a task's calls."""
    names = TASK_FUNCTIONS[task]
    return [Answer(value.copy()) for name in names for value in right_answers(name)]


@pytest.mark.parametrize("task", TASKS)
def test_right_answers_pass_without_a_word(task):
    verdict = judge(task, right(task))
    assert (verdict.status, verdict.mistake, verdict.message) == ("passed", "", "")


@pytest.mark.parametrize("task", TASKS)
def test_the_questions_are_the_same_every_time_and_may_be_written_to(task):
    first, again = calls(task), calls(task)
    for call, same in zip(first, again, strict=True):
        assert call.function == same.function
        for arg, equal in zip(call.args, same.args, strict=True):
            assert type(arg) is type(equal)
            if isinstance(arg, np.ndarray):
                assert arg.dtype == np.float64
                np.testing.assert_array_equal(arg, equal)
                arg += 1.0  # a student's function may do this
    for call, fresh in zip(again, calls(task), strict=True):
        for arg, equal in zip(call.args, fresh.args, strict=True):
            if isinstance(arg, np.ndarray):
                np.testing.assert_array_equal(arg, equal)
    assert judge(task, right(task)).status == "passed"


def test_configurations_are_the_tutorials_and_random_ones_within_the_limits():
    asked = np.array([call.args[1] for call in calls("1.6")])
    assert all(call.args[0] == MODEL for call in calls("1.6"))
    np.testing.assert_array_equal(asked[0], np.zeros(7))
    np.testing.assert_array_equal(asked[1], [0, -0.785, 0, -2.356, 0, 1.571, 0.785])
    low = [-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973]
    high = [2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973]
    assert ((asked[1:] >= low) & (asked[1:] <= high)).all()
    np.testing.assert_array_equal(asked[3:10] != asked[2], np.eye(7, dtype=bool))


def test_importing_it_does_not_load_the_simulator():
    code = "import sys, robo47.diagnose; sys.exit('mujoco' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_a_task_that_raises_its_own_error_is_to_do():
    answers = right("1.4")
    answers[0] = Answer(None, "NotImplementedError: task 1.4: quat_to_R (line 61)")
    verdict = judge("1.4", answers)
    assert verdict.status == "todo"
    assert "task 1.4" in verdict.message


def test_an_exception_is_told_with_how_often_it_happens():
    answers = right("1.4")
    answers[3] = Answer(None, "ZeroDivisionError: float division by zero (line 31)")
    verdict = judge("1.4", answers)
    assert (verdict.status, verdict.mistake) == ("wrong", "raises")
    assert "ZeroDivisionError" in verdict.message
    assert "line 31" in verdict.message
    assert "1 of 10" in verdict.message


@pytest.mark.parametrize(
    ("value", "slug", "word"),
    [
        (None, "nothing-returned", "None"),
        (np.eye(3), "shape", "(3, 3)"),
        (np.array("T"), "not-numbers", "real numbers"),
        (np.eye(4) * 1j, "not-numbers", "complex"),
        ((np.eye(3), np.zeros(3)), "shape", "(3, 3), (3,)"),
        (np.full((4, 4), np.nan), "not-finite", "NaN"),
        (np.zeros((4, 4)), "all-zeros", "not even the identity"),
        (np.eye(4), "always-the-identity", "identity"),
        (np.diag([2.0, 2.0, 2.0, 1.0]), "ignores-its-input", "same"),
        ((), "shape", "(0,)"),
    ],
)
def test_what_is_no_pose_at_all_is_told_by_its_form(value, slug, word):
    verdict = judge("1.1", [Answer(value)] * len(calls("1.1")))
    assert (verdict.status, verdict.mistake) == ("wrong", slug)
    assert word in verdict.message


def test_two_predictions_may_come_as_a_tuple_or_as_one_array():
    stacked = right("1.7")
    pairs = [Answer((a.value[0], a.value[1])) for a in stacked]
    assert judge("1.7", pairs).status == judge("1.7", stacked).status == "passed"


def test_the_function_is_named_where_a_task_has_two():
    answers = right("1.5")
    answers[-1] = Answer(None)
    assert judge("1.5", answers).message.startswith("joint_T: ")


def test_a_missing_answer_is_the_callers_error():
    with pytest.raises(ValueError, match="5 answers to 6 calls"):
        judge("1.1", right("1.1")[:-1])


def test_right_answers_in_float32_pass_and_are_told_so():
    answers = [Answer(a.value.astype(np.float32)) for a in right("1.6")]
    verdict = judge("1.6", answers)
    assert verdict.status == "passed"
    assert "float32" in verdict.message


@pytest.mark.parametrize(("decimals", "status"), [(2, "wrong"), (6, "close")])
def test_rounding_is_named(decimals, status):
    answers = [Answer(np.round(a.value, decimals)) for a in right("1.8")]
    verdict = judge("1.8", answers)
    assert (verdict.status, verdict.mistake) == (status, "rounded")
    assert f"{decimals} decimals" in verdict.message


def test_explaining_says_what_was_measured():
    answers = [Answer(a.value @ np.diag([1, -1, -1, 1])) for a in right("1.6")]
    measured = "\n".join(judge("1.6", answers).measured)
    assert "R off by 180.0 deg" in measured
    assert "t off by 0" in measured
    assert "at home by 180.0 deg" in measured
