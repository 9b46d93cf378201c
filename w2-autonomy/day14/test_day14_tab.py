"""Day 14: the tab Touch shows what the student's own functions compute."""

import importlib.util
import re

import numpy as np
import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

DAY = find_day(14)
lab = load_script(ROOT / "w2-autonomy/src/day14_touch.py")


def looked(functions):
    """Return the tab Touch of who wrote these functions; None wrote no file."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    tab = DAY.module("inspector").Touch(page)
    tab.on_move(page.q)
    return tab


def margins(tab):
    """Return the least margin that is the student's, and the library's, N."""
    shown = r"closed pads is (-?[\d.]+) N; by the library (-?[\d.]+)"
    return [float(x) for x in re.search(shown, tab.verdict.content).groups()]


def test_right_functions_have_the_librarys_margin_and_a_cone_about_the_force():
    tab = looked(vars(lab))
    yours, right = margins(tab)
    assert yours == right
    assert tab.own.says()[1] == "good"
    times, least = tab.plot.show.call_args[0]
    assert len(times) == np.shape(least)[1] > 15
    np.testing.assert_allclose(least[0], least[1])  # the library's, and with the reflex
    rise = tab.cones.points[:, 1] - tab.cones.points[:, 0]
    flat = np.linalg.norm(rise[:, [0, 2]], axis=1) / np.abs(rise[:, 1])
    assert np.allclose(flat, tab.mu, atol=1e-4)


def test_with_a_reflex_the_cube_is_held_and_one_that_opens_drops_it():
    tab = looked(vars(lab))
    assert "With a constant opening the cube is not held" in tab.verdict.content
    assert "With your grip_reflex_step the cube is held" in tab.verdict.content
    fingers = tab.hand.pose.call_args.args[0]

    def opens(opening, *more):
        return 2 * opening - lab.grip_reflex_step(opening, *more)

    wrong = looked({**vars(lab), "grip_reflex_step": opens})
    assert "With your grip_reflex_step the cube is not held" in wrong.verdict.content
    assert wrong.own.says()[1] == "bad"
    for one in (tab, wrong):
        one.frame(99.0)  # the end of the film
    assert tab.box.position[2] > 0.05 > wrong.box.position[2]
    assert set(fingers) == {"hand", "left_finger", "right_finger"}


def press(tab, text):
    """Press a button."""
    tab.sets("does", "press")(text)


@pytest.mark.kit
def test_a_round_is_the_students_and_dots_come_in_on_theta_s_line():
    tab = looked(vars(lab))
    press(tab, "one generation")
    assert "Generation 1:" in tab.learned.content
    first = tab.mean
    assert np.abs(first - lab.START).max() > 1e-3
    press(tab, "test 20 cubes")
    assert len(tab.tries) == 20
    assert "cubes; your success_rate is" in tab.learned.content
    press(tab, "start over")
    assert not tab.tries
    kept = {"cem_step": lambda mean, std, *more: (mean, std)}
    tab = looked({**vars(lab), **kept})
    press(tab, "one generation")
    assert np.array_equal(tab.mean, lab.START)
    assert tab.own.says()[1] == "bad"
