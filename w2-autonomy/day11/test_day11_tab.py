"""Day 11: the tab Near shows what the student's own functions compute."""

import importlib.util

import numpy as np
import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda, shapes

pytestmark = pytest.mark.kit

DAY = find_day(11)
lab = load_script(ROOT / "w2-autonomy/src/day11_distance.py")


def near(functions):
    """Return the tab Near of who wrote these functions; None wrote no file."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    page.bars.side_effect = lambda *_: Marks()
    tab = DAY.module("inspector").Near(page)
    tab.on_move(page.q)
    return tab


class Marks:
    """Seven bars that keep what they show."""

    def show(self, values, wanted):
        """Keep both."""
        self.values, self.wanted = values, wanted

    def clear(self):
        """Keep nothing."""
        self.values = self.wanted = None


def said(tab):
    """Return the panel's text."""
    return tab.verdict.content


def pushed(tab, how, steps=40):
    """Push, and return the smallest distance that the library sees, m."""
    tab.sets("y")(10.0)
    tab.sets("how", "press")(how)
    least = np.inf
    for k in range(steps):
        tab.advance(k / 20)
        least = min(least, tab.pairs[2].far)
        tab.page.q = tab.next
    return least


def test_the_distance_on_the_panel_follows_the_post():
    tab = near(vars(lab))
    before = tab._reference.far
    tab.sets("radius")(60.0)
    assert f"Your distance is {1000 * (before - 0.02):.1f} mm" in said(tab)


def test_a_push_goes_in_and_a_slowed_one_stays_out():
    assert pushed(near(vars(lab)), "push") < -0.01
    tab = near(vars(lab))
    least = pushed(tab, "push with damper", 80)
    assert 0.003 < least < 3 * lab.MARGIN  # two pairs are near in places


def test_a_save_plays_a_slowed_push_from_where_the_last_one_began():
    tab = near(vars(lab))
    start = tab.page.q
    tab.page.move = lambda q: setattr(tab.page, "q", q)
    for _ in range(2):  # opened, then saved
        tab.begin()
        assert np.array_equal(tab.page.q, start)
        assert tab.how == "push with damper"
        tab.advance(0.0)
        tab.frame(0.0)
        assert not np.array_equal(tab.page.q, start)
    tab.page.q = elsewhere = start + 0.1  # by a person
    tab.begin()
    assert np.array_equal(tab.page.q, elsewhere)


def test_an_arm_with_a_hand_shows_the_hands_capsules():
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    model = panda.load("panda")
    page = paper(model, panda.home_q(model), vars(lab))
    page.bars.side_effect = lambda *_: Marks()
    tab = DAY.module("inspector").Near(page)
    assert len(tab.arm.capsules) == len(shapes.LINKS) + len(shapes.HAND)
