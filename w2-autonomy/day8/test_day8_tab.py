"""Day 8: the tab Weigh shows what the student's own functions compute."""

import importlib.util

import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need, paper
from labkit.inspector.own import Library
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

DAY = find_day(8)
lab = load_script(ROOT / "w2-autonomy/src/day8_identification.py")
lab_as_fns = Library(vars(lab))
LOAD = np.append(lab.LOAD, lab.LOAD * lab.AT)


def weigh(functions):
    """Return the tab Weigh of who wrote these functions; None wrote no file."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return DAY.module("inspector").Weigh(page)


def press(tab, text):
    """Press a button."""
    tab.sets("does", "press")(text)


def test_the_tab_weighs_and_shows_what_has_no_sigma():
    tab = weigh(vars(lab))
    assert "No pose was held yet" in tab.table.content
    press(tab, "hold here")
    assert "1 pose was held: 3 of 4 parameters are identifiable" in tab.verdict.content
    one = tab.ask(lab_as_fns, tab.at())[-1]
    assert abs(one.load[3]) < 0.001 < 0.02 < LOAD[3]  # far off, and says it is sure
    assert 1000 * one.sigma[3] / one.load[0] < 0.25
    press(tab, "five poses")
    _, either, both = tab.ask(lab_as_fns, tab.at())
    assert_same(both.load, LOAD, 2e-3)
    assert both.sigma[0] < 0.001
    assert either.sigma[0] > 0.02
    assert tab.own.says()[1] == "good"
    tab.sets("grams", "forget")(1000.0)
    assert not tab.held
    assert "No pose was held yet" in tab.table.content


def test_the_tab_draws_no_centre_of_what_weighs_nothing():
    tab = weigh({**vars(lab), "identify_payload": lambda *given: np.zeros(4)})
    press(tab, "hold here")
    assert "nan, nan, nan" in tab.table.content
    assert not tab.centre.visible
