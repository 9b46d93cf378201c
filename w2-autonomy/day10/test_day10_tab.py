"""Day 10: the tab Eye shows what the student's own functions compute."""

import importlib.util
import re

import numpy as np
import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda

pytestmark = pytest.mark.kit

DAY = find_day(10)
lab = load_script(ROOT / "w2-autonomy/src/day10_camera.py")


def looked(functions):
    """Return the tab Eye of who wrote these functions; None wrote no file."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return DAY.module("inspector").Eye(page)


def millimetres(tab, key):
    """Return the error of a fit and its sigma, mm, from a line of the panel."""
    shown = re.search(f'{key}".*?>[^<]*?([0-9.]+) mm, sigma ([0-9.]+)', said(tab))
    return [float(x) for x in shown.groups()]


def said(tab):
    """Return the panel's text."""
    return tab.text.content


def test_right_functions_meet_mujocos_corners_and_are_off_by_about_sigma():
    tab = looked(vars(lab))
    assert "error of your corners: less than 0.01 px" in said(tab)
    off, sigma = millimetres(tab, "along")
    assert 0.0 < off < 3 * sigma
    tab.sets("noise")(2 * tab.noise)
    assert abs(millimetres(tab, "along")[1] - 2 * sigma) < 0.11
    assert tab.own.says()[1] == "good"


def test_a_wrong_sign_moves_the_students_corners_in_the_picture():
    flip = np.array([[1, 1, 1], [1, -1, 1], [1, 1, 1]])  # y upwards
    upside = {"project": lambda K, *more: lab.project(K * flip, *more)}
    tab = looked({**vars(lab), **upside})
    assert "less than" not in said(tab)
    tab.sets("x")(380.0)  # away from the picture's middle
    seen = tab.ask(tab.place(), tab.noise)
    shown = DAY.module("inspector").picture(seen)
    red, white = (
        np.nonzero((shown == colour).all(axis=2))[0].mean()
        for colour in ((230, 60, 40), (255, 255, 255))
    )
    assert abs(red + white - 480) < 8  # mirrored about the picture's middle line
    assert abs(red - white) > 20
    assert tab.own.says()[1] == "bad"


def test_the_picture_has_red_on_white_where_both_are_right():
    tab = looked(vars(lab))
    seen = tab.ask(tab.place(), tab.noise)
    shown = DAY.module("inspector").picture(seen)
    assert shown.shape == (480, 640, 3)
    rows, columns = np.nonzero((shown == (230, 60, 40)).all(axis=2))
    u, v = 2 * seen.truth.mean(axis=0)
    assert abs(columns.mean() - u) < 4
    assert abs(rows.mean() - v) < 4


def test_a_fit_that_runs_away_shows_no_cube_and_what_stopped_it():
    tab = looked(vars(lab))
    tab.lost()
    assert not np.any(tab.found.points)
    assert said(tab) == ""


def test_without_a_file_the_tab_says_that_it_is_the_librarys():
    tab = looked(None)
    assert "there is no file yet" in tab.own.says()[0]
