"""Day 5 in the inspector: one's own controllers, without a browser."""

import importlib.util

import numpy as np
import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

SCRIPT = "w1-foundations/src/day5_control.py"

lab = load_script(ROOT / SCRIPT)


@pytest.fixture
def tab():
    """Return the tab on a page that only listens; the lab is the student's file."""
    return tab_of(vars(lab))


def tab_of(functions):
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return find_day(5).module("inspector").Control(page)


def frames(tab, seconds):
    for k in range(round(25 * seconds)):
        tab.advance(k / 25)
        tab._frame(k / 25)
    return tab.plot.add.call_args.args


def test_the_tab_shows_the_measured_error_on_the_predicted_one(tab):
    tab.sets("does", "press")("0.1 rad off")
    t, (measured, predicted) = frames(tab, 0.16)
    assert t == pytest.approx(0.16)
    assert predicted == pytest.approx(1e2 * lab.error_response(np.array([t]), 20, 1)[0])
    assert measured == pytest.approx(predicted, abs=4.0)
    assert tab.own.says()[1] == "good"
    tab.sets("controller", "choose")("PD")
    assert frames(tab, 0.4)[1][0] > 50


def test_the_tab_swings_hangs_and_integrates(tab):
    tab.sets("does", "press")("swing")
    assert frames(tab, 0.4)[1][0] < 1.5
    assert np.isnan(tab.predicted)  # nobody predicts it
    tab.sets("heavy", "hang")(True)
    assert frames(tab, 0.4)[1][0] > 2.0
    tab.sets("does", "press")("0.1 rad off")
    tab.sets("controller", "choose")("with an integral (PID)")
    assert frames(tab, 2.0)[1][0] < 0.2


def test_the_tab_says_where_the_loop_breaks_and_that_it_chatters(tab):
    tab.on_move(panda.READY_Q)
    tab.sets("omega", "tell")(200)
    assert "every 4 ms the loop is unstable from 224 rad/s on" in tab.verdict.content
    assert "your max_stable_omega(0.004) returns 207" in tab.verdict.content
    assert "r47-bad" not in tab.verdict.content
    tab.sets("omega", "tell")(290)
    assert "r47-bad" in tab.verdict.content
    tab.sets("does", "press")("0.1 rad off")
    frames(tab, 1.0)
    assert "The loop CHATTERS: joint" in tab.verdict.content
