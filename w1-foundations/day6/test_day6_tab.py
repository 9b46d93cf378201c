"""Day 6 in the inspector, without a browser: one's own impedance pushed and pressed."""

import importlib.util
from unittest.mock import MagicMock

import numpy as np
import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

DAY = find_day(6)
lab = load_script(ROOT / "w1-foundations/src/day6_task_space.py")


def touch(functions, monkeypatch):
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    inspector = DAY.module("inspector")
    monkeypatch.setattr(inspector, "Robot", MagicMock())
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return inspector, inspector.Touch(page)


def seconds(inspector, tab, count):
    for k in range(round(count * inspector.HZ)):
        tab.step(k / inspector.HZ)
    tab.show()


def test_the_tab_shows_the_push_that_was_predicted_and_the_table(monkeypatch):
    inspector, tab = touch(vars(lab), monkeypatch)
    tab.on_move(tab.page.q)
    T = tab.page.pose.return_value
    T[0, 3] += 0.1  # the handle: 10 N along x
    tab.drag(T)
    assert "F / k = (25.0, 0.0, 0.0) mm, moved (0.0, 0.0, 0.0)" in tab.numbers.content
    seconds(inspector, tab, 3)
    assert "moved (25.0, " in tab.numbers.content
    assert tab.own.says()[1] == "good"
    tab.press(inspector.READY)
    seconds(inspector, tab, 2)
    assert tab.bars.show.call_args.args[0][0] == pytest.approx(19.6, abs=0.4)
    tab.press(inspector.LET_GO)
    assert not tab.force.any()


def test_the_tab_is_pushed_away_with_a_wrong_sign(monkeypatch):
    negative = {"impedance_wrench": lambda *args: -lab.impedance_wrench(*args)}
    inspector, tab = touch({**vars(lab), **negative}, monkeypatch)
    tab.force[0] = 1.0
    seconds(inspector, tab, 1)
    hand = tab.arm.at(tab.data.qpos[:7]).T_world_ee[:3, 3]
    assert np.linalg.norm(hand - tab.arm.at(tab.goal_q).T_world_ee[:3, 3]) > 0.1
    assert "impedance_wrench by" in tab.own.says()[0]
