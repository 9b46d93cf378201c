"""Day 7's tabs, without a browser."""

import importlib.util
from unittest.mock import MagicMock

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


def tab_of(name, functions, monkeypatch):
    for module in ("viser", "labkit.inspector.tab"):
        need(importlib.util.find_spec(module) is not None, f"{module}: make view")
    inspector = DAY.module("inspector")
    monkeypatch.setattr(inspector, "Robot", MagicMock())
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return inspector, getattr(inspector, name)(page)


def test_the_tab_plans_the_labs_move_with_ones_own_functions(monkeypatch):
    inspector, tab = tab_of("Plan", vars(lab), monkeypatch)
    assert_same(inspector.GOAL_Q, lab.GOAL_Q)
    tab.on_move(panda.READY_Q)
    tab.go(0.5)
    assert "0.50 of 0.995 s; at most 100% of a velocity limit" in tab.numbers.content
    assert tab.own.says()[1] == "good"
    tab.sets("kind")(inspector.TRAPEZOID)
    assert "of 0.803 s" in tab.numbers.content
    tab.sets("hurry")(1.5)
    assert "150% of a velocity limit" in tab.numbers.content
    assert_same(tab.q[-1], lab.GOAL_Q, 1e-12)
    assert_same(tab.qd[-1], np.zeros(7), 1e-12)
    assert tab.play(10.0) is False


def test_the_tab_shows_what_a_wrong_duration_does(monkeypatch):
    half = {"quintic_duration": lambda *args: lab.quintic_duration(*args) / 2}
    _, tab = tab_of("Plan", {**vars(lab), **half}, monkeypatch)
    tab.on_move(panda.READY_Q)
    assert "200% of a velocity limit" in tab.numbers.content
    assert "quintic_duration by" in tab.own.says()[0]
