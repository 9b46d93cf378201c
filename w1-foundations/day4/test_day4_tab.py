"""Day 4's tab, without a browser."""

import importlib.util
import re

import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

lab = load_script(ROOT / "w1-foundations/src/day4_dynamics.py")


@pytest.fixture(scope="module")
def arm():
    return panda.arm(panda.load("panda_nohand"))


def test_the_heat_map_shows_every_entry_of_M_and_its_sign(arm):
    pytest.importorskip("viser")
    heat_map = find_day(4).module("inspector").heat_map
    M = arm.at(panda.READY_Q).M
    shown = [float(x) for x in re.findall(r">([-\d.]+)</td>", heat_map(M))]
    assert_same(np.reshape(shown, (7, 7)), M, 0.0051)


def forces(functions):
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return find_day(4).module("inspector").Forces(page)


def fallen(tab, seconds=1.0):
    """Return how far the hand is from where it was after a while of floating."""
    tab.sets("does", "press")("float")
    for _ in range(round(25 * seconds)):
        tab.advance(1.0)
    hand = [tab.rig.at(q).T_world_ee[:3, 3] for q in (panda.READY_Q, tab.data.qpos)]
    return np.linalg.norm(hand[1] - hand[0])


def test_the_tab_floats_on_ones_own_torque_and_falls_with_a_wrong_sign():
    tab = forces(vars(lab))
    assert fallen(tab) < 1e-3
    assert tab.own.says()[1] == "good"
    tab.on_move(panda.READY_Q)
    assert_same(*tab.bars.show.call_args.args, 1e-9)  # the bars and the marks
    negative = {"gravity_torque": lambda *args: -lab.gravity_torque(*args)}
    tab = forces({**vars(lab), **negative})
    assert fallen(tab) > 0.3
    says, kind = tab.own.says()
    assert (kind, "gravity_torque by" in says) == ("bad", True)
