"""Functions and arguments that have another name now, in labs that have the old one."""

import re

import pytest

from labkit.lesson.day import all_days, find_day
from labkit.lesson.lab_module import read_script
from labkit.lesson.merge import renewed
from labkit.lesson.renames import arguments_as_now, called_as_now

RENAMED = [day for day in all_days() if any(task.renamed for task in day.tasks)]


def solved(text):
    """Return a complete lab as a student has it in the end: without markers."""
    return re.sub(r"^ *# (end)?region.*\n", "", text, flags=re.MULTILINE)


@pytest.mark.parametrize("day", RENAMED, ids=lambda day: day.number)
def test_a_finished_lab_becomes_the_kits_with_its_names_of_now(day):
    now = read_script(day.source)
    older = now
    for task in day.tasks:
        for was, name in task.renamed:
            older = re.sub(rf"(?<![\w.]){name}(?!\w)", was, older)
    assert older != now
    assert renewed(day, solved(older), [older], now) == solved(now)


def test_a_variable_with_a_functions_old_name_stays():
    text = (
        "def moved(T, xi):\n    return T  # moved (by xi), moved(T)\n\n\n"
        "def own(T):\n    moved = T.copy()\n    return moved, T.moved(2)\n\n\n"
        "def other(T):\n    return moved(T, [moved for moved in T]), moved\n"
    )
    found = called_as_now(find_day(10), text)
    assert found.startswith("def apply_twist(T, xi):\n    return T  # moved (by xi)")
    assert "    moved = T.copy()\n    return moved, T.moved(2)\n" in found


def test_functions_of_other_days_follow_where_they_are_imported():
    text = (
        "from robo47 import control, grasp\n"
        "from robo47.planning import nearest, wilson\n\n\n"
        "def own(gains):\n    return wilson(3, 4), control.gains(1, 2), gains.gains\n"
    )
    found = called_as_now(find_day(14), text)
    assert "import nearest, wilson_interval\n" in found
    assert "wilson_interval(3, 4), control.pd_gains(1, 2), gains.gains" in found


def test_a_file_that_does_not_load_follows_where_it_is_certain():
    text = "def reaches(offsets, far):\n    return (\n\n\nx = reaches(1, 2), reaches\n"
    found = called_as_now(find_day(11), text)
    assert found.startswith("def distal_radii(offsets, far):")
    assert found.endswith("x = distal_radii(1, 2), reaches\n")


OLD = "def f(far, g):\n    ...\n"
NOW = "def f(link_radii, c):\n    ...\n"


@pytest.mark.parametrize(
    ("mine", "follows"),
    [
        (
            "def f(far, g):\n    return [far * x for x in g], 'far'\n",
            "def f(link_radii, c):\n    return [link_radii * x for x in c], 'far'\n",
        ),
        # A name is taken.
        ("def f(far, g):\n    c = 2\n    return c * far\n",) * 2,
        # The student has called one otherwise.
        (
            "def f(far, mine):\n    return far * mine\n",
            "def f(link_radii, mine):\n    return link_radii * mine\n",
        ),
        ("def own(far):\n    return far\n",) * 2,
        ("def f(far, g):\n    return (\n",) * 2,
    ],
)
def test_arguments_follow_where_no_name_is_taken(mine, follows):
    assert arguments_as_now(mine, OLD, NOW) == follows


def test_older_names_follow_the_last_ones():
    found = dict(find_day(5).task("5.9").renamed)
    assert found["stiffest_omega"] == found["fastest"] == "max_stable_omega"
    assert found["servo_ctrl"] == "servo_ctrl"
