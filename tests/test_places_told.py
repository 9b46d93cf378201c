"""Where a mistake is said to be: which result, which steps, which rows."""

import inprocess
import numpy as np
import pytest
from test_own_line import told as told_of_a_file
from toyrows import row_of
from toyrows import told as judged

from labkit.judge import Scalar
from labkit.judge.sentence import for_steps
from labkit.lesson.day import find_day
from labkit.lesson.starter import function_lines


def told(task, name, student, body):
    """Return what a file of Day 15 is told, one function of which is a student's."""
    day = find_day(15)
    text = day.source.read_text("utf-8")
    lines = function_lines(text, name)[2]
    head = "\n".join(lines[: next(i for i, x in enumerate(lines) if '"""' in x)])
    own = f"{head}\n    " + body.replace("\n", "\n    ")
    file = student(text.replace("\n".join(lines), own), day.source.name)
    return inprocess.verdicts(day, file, task)[task]


@pytest.mark.kit
@pytest.mark.parametrize(
    ("task", "name", "body", "slug", "says"),
    [
        (
            "15.4",
            "mlp",
            "h = np.tanh(x @ W1) + b1\nh = np.tanh(h @ W2) + b2\nreturn h @ W3 + b3",
            "slip-bracket",
            "a solution whose code for the outputs of the first layer and for the "
            "outputs of the second layer contains a mistake.",
        ),
        (
            "15.5",
            "mse",
            "e = pred - target\nreturn np.mean(e) ** 2, 2 * e / e.size",
            "slip-bracket",
            "`return (np.mean(e) ** 2, 2 * e / e.size)`. Largest error",
        ),
        (
            "15.3",
            "normalise",
            "return (x - scaler[1]) / scaler[0]",
            "argument-shifted",
            "shift",
        ),
    ],
)
def test_a_slip_is_told_with_its_place(student, task, name, body, slug, says):
    verdict = told(task, name, student, body)
    assert (verdict.status, verdict.mistake) == ("wrong", slug)
    assert says in verdict.message


def products(rng):
    return [(rng.numbers(-2, 2, n, 3), rng.numbers(-2, 2, n, 2)) for n in (4, 5, 1, 3)]


def test_one_result_that_a_mistake_only_nearly_gives_is_not_told_by_it():
    kind = Scalar(called="the mean"), Scalar(called="the square")
    row = row_of(kind, lambda x, d: (x.mean(), np.mean(d**2)), products)

    @row.wrong
    def summed(x, d):
        """the numbers are summed up"""
        return x.sum(), np.sum(d**2)

    exact = judged(row, lambda x, d: (x.sum(), np.max(d) ** 3))
    near = judged(row, lambda x, d: (1.001 * x.sum(), np.max(d) ** 3))
    assert exact.mistake == "summed+other"
    assert "summed" not in near.message


@pytest.mark.parametrize(
    ("function", "slug", "says"),
    [
        (
            lambda x, d: (x.sum(), np.max(d) ** 3),
            "summed+other",
            "One mistake would explain the mean: the numbers are summed up. The square "
            "is wrong in all 4 calls, too.",
        ),
        (
            lambda x, d: (x.sum(), np.mean(d) ** 2),
            "summed+squared-mean",
            "One mistake would explain the mean: the numbers are summed up. Another "
            "mistake would explain the square: the mean is squared.",
        ),
        (lambda x, d: (x.sum() + (len(x) == 5), np.max(d) ** 3), "off", "The mean is"),
        # The mistake is about both results, and one is right.
        (lambda x, d: (x.sum(), np.mean(d**2)), "off", "The square is correct."),
    ],
)
def test_a_mistake_in_one_result_says_what_is_with_the_other(function, slug, says):
    kind = Scalar(called="the mean"), Scalar(called="the square")
    row = row_of(kind, lambda x, d: (x.mean(), np.mean(d**2)), products)

    @row.wrong
    def summed(x, d):
        """the numbers are summed up"""
        return x.sum(), np.sum(d**2)

    @row.wrong
    def squared_mean(x, d):
        """the mean is squared"""
        return x.mean(), np.mean(d) ** 2

    verdict = judged(row, function)
    assert verdict.mistake == slug
    assert verdict.message.startswith(says)


def test_the_comma_of_an_index_ends_no_clause():
    assert for_steps(["entry [a, b] of the windows"]) == (
        "for the entry [a, b] of the windows"
    )
    assert for_steps(["limits, from small to large"]).endswith("large,")


INVERTED = """
def project(K, T_cam_world, points):
    R, t = T_cam_world[:3, :3], T_cam_world[:3, 3]
    p = (points - t) @ R
    return np.array([(K @ one)[:2] / one[2] for one in p])
"""


def test_a_change_of_an_argument_that_the_library_refuses_is_found(student):
    """An inverted pose puts points behind the camera, which the lab's code projects."""
    says = told_of_a_file(10, "10.2", "project", student, INVERTED)
    assert "acts as if `T_cam_world` were replaced with its inverse." in says
