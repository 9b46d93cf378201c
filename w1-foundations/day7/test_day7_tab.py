"""Day 7's tabs, without a browser."""

import importlib.util

import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

SCRIPT = "w1-foundations/src/day7_trajectory.py"
DAY = find_day(7)
lab = load_script(ROOT / SCRIPT)


def tab_of(name, functions):
    for module in ("viser", "labkit.inspector.tab"):
        need(importlib.util.find_spec(module) is not None, f"{module}: make view")
    inspector = DAY.module("inspector")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return inspector, getattr(inspector, name)(page)


def test_the_tab_plans_the_labs_move_with_ones_own_functions():
    inspector, tab = tab_of("Plan", vars(lab))
    assert_same(inspector.GOAL_Q, lab.GOAL_Q)
    tab.on_move(panda.READY_Q)
    tab.go(0.5)
    assert "0.50 of 0.995 s; at most 100% of a velocity limit" in tab.verdict.content
    assert tab.own.says()[1] == "good"
    tab.sets("kind")(inspector.TRAPEZOID)
    assert "of 0.803 s" in tab.verdict.content
    tab.sets("hurry")(1.5)
    assert "150% of a velocity limit" in tab.verdict.content
    assert_same(tab.q[-1], lab.GOAL_Q, 1e-12)
    assert_same(tab.qd[-1], np.zeros(7), 1e-12)
    assert tab.frame(10.0) is False
