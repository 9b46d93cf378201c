"""Day 9: the tab Feel shows what the student's own observer finds."""

import importlib.util

import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

DAY = find_day(9)
lab = load_script(ROOT / "w2-autonomy/src/day9_estimation.py")


def feel(functions):
    """Return the tab Feel of who wrote these functions."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    tab = DAY.module("inspector").Feel(page)
    tab.on_move(page.q)
    return tab


def pulled(tab, seconds=0.6):
    """Pull at the flange with 10 N downwards for some seconds."""
    tab.sets("does", "press")("10 N down")
    for _ in range(round(25 * seconds)):
        tab.advance(0.0)
    tab._frame(0.0)
    return tab


def said(tab):
    """Return the panel's text."""
    tab.tell()
    return tab.verdict.content


def test_the_bars_are_the_push_and_the_ball_stands_at_the_link():
    tab = feel(vars(lab))
    assert "no contact" in said(tab)
    assert not tab.named.visible
    pulled(tab)
    residual, truth = tab.bars.show.call_args.args
    assert_same(residual, truth, 0.02)
    assert truth[3] == pytest.approx(-4.7, abs=0.1)
    assert "contact on link 6" in said(tab)
    assert tab.named.visible
    assert_same(tab.named.position, tab.arm.at(tab.data.qpos[:7]).coms_world[5], 1e-12)
    assert tab.own.says()[1] == "good"
    tab.let_go()
    assert not tab.force.any()
    T = np.eye(4)
    T[:3, 3] = tab.point() + np.array([0.0, 0.2, 0.0])
    tab.drag(T)  # the handle: 20 N along y
    assert_same(tab.force, [0.0, 20.0, 0.0], 1e-9)


def test_a_link_is_pulled_at_its_own_centre():
    tab = feel(vars(lab))
    tab.sets("place", "let_go")("link4")
    assert_same(tab.point(), tab.arm.at(panda.READY_Q).coms_world[3], 1e-12)
