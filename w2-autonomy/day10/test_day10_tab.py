"""Day 10: the tab Eye shows what the student's own functions compute."""

import importlib.util

import numpy as np
import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

DAY = find_day(10)
lab = load_script(ROOT / "w2-autonomy/src/day10_camera.py")


def looked():
    """Return the tab Eye of a student with correct functions."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, vars(lab))
    tab = DAY.module("inspector").Eye(page)
    tab.on_move(page.q)
    return tab


def test_right_functions_meet_mujocos_corners_and_are_off_by_about_sigma():
    tab = looked()
    assert "error of your corners: less than 0.01 px" in tab.verdict.content
    seen, _ = tab._found
    assert 0.0 < abs(seen.off[2]) < 3 * seen.sigma[2]
    tab.sets("noise")(2 * tab.noise)
    np.testing.assert_allclose(tab._found[0].sigma, 2 * seen.sigma, rtol=0.05)
    assert tab.own.says()[1] == "good"


def test_the_picture_has_the_students_corners_on_the_cubes():
    tab = looked()
    seen, right = tab._found
    shown = tab.picture(seen, right)
    assert shown.shape == (480, 640, 3)
    bare = tab.picture(None, right)
    rows, columns = np.nonzero((shown != bare).any(axis=2)[:270])
    u, v = 2 * right.truth.mean(axis=0)
    assert abs(columns.mean() - u) < 4
    assert abs(rows.mean() - v) < 4
