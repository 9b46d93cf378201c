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
    return DAY.module("inspector").Touch(page)


def margins(tab):
    """Return the least margin that is the student's, and the library's, N."""
    shown = r"closed: (-?[\d.]+) N; by the library (-?[\d.]+)"
    return [float(x) for x in re.search(shown, tab.text.content).groups()]


def test_right_functions_have_the_librarys_margin_and_a_cone_about_the_force():
    tab = looked(vars(lab))
    yours, right = margins(tab)
    assert yours == right
    assert tab.own.says()[1] == "good"
    times, least = tab.plot.show.call_args[0]
    assert len(times) == np.shape(least)[1] > 15
    rise = tab.cones.points[:, 1] - tab.cones.points[:, 0]
    flat = np.linalg.norm(rise[:, [0, 2]], axis=1) / np.abs(rise[:, 1])
    assert np.allclose(flat, tab.mu, atol=1e-4)


def test_a_margin_without_its_mu_is_another_number_and_another_curve():
    wrong = {"cone_margin": lambda f, n, mu: lab.cone_margin(f, n, 1 + 0 * mu)}
    tab = looked({**vars(lab), **wrong})
    yours, right = margins(tab)
    assert yours > right + 0.1
    _, least = tab.plot.show.call_args[0]
    assert np.max(np.subtract(*least)) > 0.1
    assert tab.own.says()[1] == "bad"
    assert "r47-bad" in tab.text.content


def test_edges_of_another_mu_are_another_cone():
    right = looked(vars(lab)).cones.points
    wrong = {"cone_edges": lambda n, mu, k: lab.cone_edges(n, 2 * mu, k)}
    tab = looked({**vars(lab), **wrong})
    assert np.abs(tab.cones.points - right).max() > 0.003
    assert tab.own.says()[1] == "bad"


def test_with_a_reflex_the_cube_is_held_and_one_that_opens_drops_it():
    tab = looked(vars(lab))
    assert "not held" in tab.text.content
    tab.sets("feels")(True)
    assert "the cube is held" in tab.text.content

    def opens(opening, *more):
        return 2 * opening - lab.grip_reflex_step(opening, *more)

    tab = looked({**vars(lab), "grip_reflex_step": opens})
    tab.sets("feels")(True)
    assert "not held" in tab.text.content
    assert tab.own.says()[1] == "bad"


@pytest.mark.kit
def test_a_round_is_the_students_and_dots_come_in_on_theta_s_line():
    module = DAY.module("inspector")
    tab = looked(vars(lab))
    tab.press(module.ROUND)
    assert "generation 1:" in tab.learned.content
    first = tab.mean
    assert np.abs(first - lab.START).max() > 1e-3
    tab.press(module.TRY)
    assert len(tab.tries) == 20
    shown = tab.image.image
    assert (shown == module.BLUE).all(axis=2).any() or (shown == module.RED).any()
    tab.press(module.NEW)
    assert not tab.tries
    kept = {"cem_step": lambda mean, std, *more: (mean, std)}
    tab = looked({**vars(lab), **kept})
    tab.press(module.ROUND)
    assert np.array_equal(tab.mean, lab.START)
    assert tab.own.says()[1] == "bad"


def test_without_a_file_the_tab_says_that_it_is_the_librarys():
    assert "there is no file yet" in looked(None).own.says()[0]
