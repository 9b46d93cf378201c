"""Each statement of a lab's task functions has a gloss: a noun phrase of what it is."""

import ast
import re

import pytest

from conftest import days
from labkit.judge.mutant import glosses
from labkit.lesson.starter import find_regions

# A gloss stands in "... in this step: the velocity of link i": it is no clause.
CLAUSE = re.compile(r"^(and|or|but|so|because|where|when|of|in|as|for) ", re.IGNORECASE)
# It also stands alone in "Your code for ... omits a factor": it names no other line, no
# state of a loop, and nothing by what it is not.
POINTS = re.compile(
    r"\b(these|this|those|such|it|them|they|so far|(is|are) (not|left))\b"
    r"|^(from|without) "
)
# To return a variable needs none: the line that made it has one.
STEPS = (ast.Assign, ast.AugAssign, ast.Return)


def points(gloss):
    """Return whether what a message says of a gloss points at another line."""
    return bool(POINTS.search(re.split(r"[:;] ", gloss)[0]))


def glossed(day):
    """Return the statements of a lab's regions, and the glosses of the lab."""
    text = day.source.read_text("utf-8")
    inside = {
        number
        for region in find_regions(text, day.source.name)
        for number in range(region.start + 1, region.end + 1)
    }
    steps = [
        one
        for one in ast.walk(ast.parse(text))
        if isinstance(one, STEPS) and one.lineno in inside
    ]
    return steps, {n: g for n, g in glosses(text).items() if n in inside}


def has_glosses(day):
    """Return whether a lab has glosses, and not only a comment here and there."""
    steps, found = glossed(day)
    return len(found) > len(steps) / 2


LABS = [day for day in days() if has_glosses(day)]


def test_the_labs_of_at_least_a_week_have_glosses():
    assert len(LABS) >= 7


@pytest.mark.parametrize("day", LABS, ids=lambda day: f"day{day.number}")
def test_a_lab_with_glosses_has_them_all(day):
    steps, found = glossed(day)
    bare = [
        one.lineno
        for one in steps
        if not (isinstance(one, ast.Return) and isinstance(one.value, ast.Name))
        and not any(n in found for n in range(one.lineno, one.end_lineno + 1))
    ]
    assert bare == []
    assert [gloss for gloss in found.values() if CLAUSE.match(gloss)] == []
    assert [gloss for gloss in found.values() if points(gloss)] == []


@pytest.mark.parametrize(
    ("gloss", "is_one"),
    [
        ("the sum so far", True),
        ("f at these times", True),
        ("weights that are not normalised", True),
        ("from a wrench to an acceleration", True),
        ("the accumulated sum", False),
        ("unnormalised weights", False),
        ("the exponents; these are never positive", False),
    ],
)
def test_a_gloss_that_points_at_another_line_does_not_stand_alone(gloss, is_one):
    assert points(gloss) == is_one


def test_a_gloss_on_the_first_line_belongs_to_the_whole_statement():
    text = "x = (  # the sum\n    a + b\n    + c  # the rest\n)\nreturn_ = 1\n"
    assert glosses(text) == {1: "the sum", 2: "the sum", 3: "the rest", 4: "the sum"}
