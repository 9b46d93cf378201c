"""Day 8: the tab Weigh shows what the student's own functions compute."""

import importlib.util
import re

import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

DAY = find_day(8)
lab = load_script(ROOT / "w2-autonomy/src/day8_identification.py")
LOAD = np.append(lab.LOAD, lab.LOAD * lab.AT)


def weigh(functions):
    """Return the tab Weigh of who wrote these functions; None wrote no file."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return DAY.module("inspector").Weigh(page)


def test_the_tab_weighs_and_shows_what_has_no_sigma():
    tab = weigh(vars(lab))
    assert "No pose was held yet" in tab.table.content
    tab.press("hold here")
    assert "3 of 4 parameters are identifiable" in tab.table.content
    one = tab.ask(tab.held).own["both, averaged"]
    assert abs(one.load[3]) < 0.001 < 0.02 < LOAD[3]  # far off, and says it is sure
    assert 1000 * one.sigma[3] / one.load[0] < 0.25
    tab.press("five poses")
    found = tab.ask(tab.held).own
    assert_same(found["both, averaged"].load, LOAD, 2e-3)
    assert found["both, averaged"].sigma[0] < 0.001
    assert found["one from either side"].sigma[0] > 0.02
    assert tab.own.says()[1] == "good"
    tab.hang(1000)
    assert not tab.held
    assert "No pose was held yet" in tab.table.content


def test_a_wrong_sign_in_ones_own_function_changes_what_the_tab_shows():
    negative = {"identify_payload": lambda *given: -lab.identify_payload(*given)}
    shown = {}
    for name, functions in (("right", {}), ("wrong", negative)):
        tab = weigh({**vars(lab), **functions})
        tab.press("hold here")
        shown[name] = re.findall(r"[a-z, ']+: (-?\d+)\.\d g", tab.table.content)
    assert shown["right"][::2] == shown["right"][1::2]  # one's own and the library's
    assert shown["wrong"][::2] == [f"-{grams}" for grams in shown["right"][::2]]
    assert shown["wrong"][1::2] == shown["right"][1::2]
    says, kind = tab.own.says()
    assert (kind, "identify_payload by" in says) == ("bad", True)


def test_without_a_file_the_tab_says_that_it_is_the_librarys():
    tab = weigh(None)
    tab.press("hold here")
    says, _ = tab.own.says()
    assert "the library's identify_payload" in says
    assert "there is no file yet" in says
    ways = tab.ask(tab.held)
    for name, found in ways.own.items():
        assert_same(found.load, ways.library[name].load, 0.0)


def test_the_tab_draws_no_centre_of_what_weighs_nothing():
    tab = weigh({**vars(lab), "identify_payload": lambda *given: np.zeros(4)})
    tab.press("hold here")
    assert "centre nan" in tab.table.content
    assert not tab.found.visible
