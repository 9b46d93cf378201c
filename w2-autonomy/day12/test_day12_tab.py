"""Day 12: the tab Way shows what the student's own functions compute."""

import html
import importlib.util
import re

import numpy as np
import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda, planning

pytestmark = pytest.mark.kit

DAY = find_day(12)
lab = load_script(ROOT / "w2-autonomy/src/day12_planning.py")


def looked(functions):
    """Return the tab Way of who wrote these functions; None wrote no file."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    tab = DAY.module("inspector").Way(page)
    tab.on_move(page.q)
    return tab


def said(tab):
    """Return the panel's text, without its marks."""
    return html.unescape(re.sub(r"<[^>]+>", " ", tab.verdict.content))


def test_right_functions_find_the_librarys_way_with_trees_that_grow():
    tab = looked(vars(lab))
    tab.sets("n")(100.0)
    assert "Your path equals the library's" in said(tab)
    many = [
        int(x) for x in re.search(r"have (\d+) and (\d+) nodes", said(tab)).groups()
    ]
    tab.sets("n")(4.0)
    few = [int(x) for x in re.search(r"have (\d+) and (\d+) nodes", said(tab)).groups()]
    assert sum(few) < sum(many)
    assert tab.own.says()[1] == "good"


def test_a_count_of_draws_has_the_students_interval():
    tab = looked(vars(lab))
    k, n, low, high = re.search(
        r"(\d+) of (\d+) sets of samples find a path: ([\d.]+) to ([\d.]+)\.", said(tab)
    ).groups()
    assert [float(low), float(high)] == pytest.approx(
        planning.wilson_interval(int(k), int(n)), abs=0.006
    )
    half = {"wilson_interval": lambda k, n: np.array([k / n, k / n])}
    tab = looked({**vars(lab), **half})
    assert f"{int(k) / 20:.2f} to {int(k) / 20:.2f}" in said(tab)
    assert tab.own.says()[1] == "bad"


def test_another_planners_way_is_drawn_beside_the_librarys():
    planners = DAY.module("planners")
    wrong = {"rrt_connect": lambda *given: planners.planner(*given, turn="never")}
    tab = looked({**vars(lab), **wrong})
    tab.sets("n")(100.0)
    right = looked(vars(lab))
    right.sets("n")(100.0)
    assert "Your path is valid, by another planner: it differs from" in said(tab)
    assert "rrt_connect (valid, by another planner)" in tab.own.says()[0]
    assert np.any(tab.image.image != right.image.image)
    # A path through the discs is not valid, whoever planned it.
    blind = {"rrt_connect": lambda *given: planners.planner(*given, free=True)}
    tab = looked({**vars(lab), **blind})
    tab.sets("n")(100.0)
    assert "valid" not in said(tab)
    assert "Your path differs from the library's from waypoint" in said(tab)
    assert "rrt_connect (another path)" in tab.own.says()[0]


def test_an_extend_that_checks_nothing_grows_through_the_discs():
    def unchecked(tree, sample, step, world):
        i, q, _ = lab.extend(tree, sample, step, world)
        return i, q, True

    tab = looked({**vars(lab), "extend": unchecked})
    seen, _ = tab._found
    hit = [
        not planning.segment_free_of_discs(a, b, seen.discs)
        for edges in seen.edges
        for a, b in edges
    ]
    assert any(hit)
    assert tab.own.says()[1] == "bad"


def test_a_wrong_timing_is_played_beside_the_librarys_seconds():
    tab = looked(vars(lab))
    tab.begin()
    times = r"wall: ([\d.]+) s with your timing, ([\d.]+) s"
    tab.tell()
    yours, truth = re.search(times, said(tab)).groups()
    assert yours == truth

    def slow(*given):
        return 0.25 * lab.time_optimal_profile(*given)

    tab = looked({**vars(lab), "time_optimal_profile": slow})
    tab.begin()
    tab.tell()
    twice = re.search(times, said(tab))[1]
    assert float(twice) == pytest.approx(2 * float(truth), abs=0.02)
