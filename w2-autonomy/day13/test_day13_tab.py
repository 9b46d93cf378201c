"""Day 13: the tab Best shows what the student's own functions compute."""

import importlib.util
import re

import numpy as np
import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

DAY = find_day(13)
lab = load_script(ROOT / "w2-autonomy/src/day13_optimal.py")
TOP = 80  # steps: the top of the circle is passed


def looked(functions, steps=TOP):
    """Return the tab Best of who wrote these functions; None wrote no file."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    tab = DAY.module("inspector").Best(page)
    for _ in range(steps):
        tab.advance()
    tab._frame(0.0)
    return tab


def most(tab, name):
    """Return how far off an arm was at most, mm, as the panel says."""
    shown = re.search(
        rf"{name}: error [\d.]+ mm, at most ([\d.]+)", tab.verdict.content
    )
    return float(shown[1])


def test_right_functions_draw_what_the_lab_draws_and_the_library_beside_it():
    tab = looked(vars(lab), 110)
    off, share, _ = lab.draw_circle(tab.page.model, lab.best_step())
    np.testing.assert_allclose(tab.pens["yours"].off[1:], off[:110], atol=1e-6)
    assert most(tab, "yours") == most(tab, "the library&#x27;s") == round(off.max(), 1)
    assert most(tab, "clamped") > 4 * off.max()
    assert "r47-good" in tab.verdict.content
    assert tab.own.says()[1] == "good"
    np.testing.assert_allclose(tab.speed, share[109] / 1.0, atol=1e-9)


@pytest.mark.kit
def test_the_joint_that_pays_is_the_elbow():
    tab = looked(vars(lab), 60)  # before that no limit meets
    assert not tab.price.any()
    for _ in range(30):
        tab.advance()
    tab.frame()
    price = np.abs(tab.price)
    assert np.argmax(price) == 3
    assert 0.02 < price[3] < 1
    assert price[3] > 0.9 * price.sum()
    assert tab.price[3] < 0  # at an upper limit
    np.testing.assert_allclose(*tab.costs.show.call_args.args, atol=1e-9)


def test_a_wrong_price_is_told_before_a_limit_meets():
    def negative(*given):
        return -lab.bound_multipliers(*given)

    tab = looked({**vars(lab), "bound_multipliers": negative}, 1)
    assert "bound_multipliers by" in tab.own.says()[0]
    assert not tab.price.any()  # the way itself met none


@pytest.mark.kit
def test_a_slider_puts_all_arms_at_the_start_and_changes_what_is_asked():
    tab = looked(vars(lab))
    assert most(tab, "yours") > 12
    tab.sets("turn", "restart")(0.01)
    assert tab.steps == 0
    for _ in range(110):
        tab.advance()
    tab._frame(0.0)
    assert most(tab, "yours") < 7
