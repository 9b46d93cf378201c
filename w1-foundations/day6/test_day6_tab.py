"""Day 6 in the inspector, without a browser: one's own impedance pushed and pressed."""

import importlib.util

import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

DAY = find_day(6)
lab = load_script(ROOT / "w1-foundations/src/day6_task_space.py")


def touch(functions):
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    inspector = DAY.module("inspector")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return inspector, inspector.Touch(page)


def seconds(tab, count):
    for k in range(round(count * tab.hz)):
        tab.advance(k / tab.hz)
    tab._frame(0.0)


def test_the_tab_shows_the_push_that_was_predicted_and_the_table():
    inspector, tab = touch(vars(lab))
    tab.on_move(tab.page.q)
    T = tab.page.pose.return_value
    T[0, 3] += 0.1  # the handle: 10 N along x
    tab.drag(T)
    tab._frame(0.0)
    assert "F / k = (25.0, 0.0, 0.0) mm, moved (0.0, 0.0, 0.0)" in tab.verdict.content
    seconds(tab, 3)
    assert "moved (25.0, " in tab.verdict.content
    assert tab.own.says()[1] == "good"
    tab.sets("does", "press")(inspector.READY)
    seconds(tab, 2)
    assert tab.bars.show.call_args.args[0][0] == pytest.approx(19.6, abs=0.4)
    tab.sets("does", "press")(inspector.LET_GO)
    assert not tab.force.any()
