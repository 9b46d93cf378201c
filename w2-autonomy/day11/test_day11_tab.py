"""Day 11: the tab Near shows what the student's own functions compute."""

import importlib.util

import numpy as np
import pytest

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import panda, shapes

pytestmark = pytest.mark.kit

DAY = find_day(11)
lab = load_script(ROOT / "w2-autonomy/src/day11_distance.py")


def near(functions):
    """Return the tab Near of who wrote these functions; None wrote no file."""
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    page.bars.side_effect = lambda *_: Marks()
    return DAY.module("inspector").Near(page)


class Marks:
    """Seven bars that keep what they show."""

    def show(self, values, wanted):
        """Keep both."""
        self.values, self.wanted = values, wanted

    def clear(self):
        """Keep nothing."""
        self.values = self.wanted = None


def said(tab):
    """Return the panel's text."""
    return tab.text.content


def pushed(tab, how, steps=40):
    """Push, and return the smallest distance that the library sees, m."""
    tab.sets("y")(10.0)
    tab.press(how)
    least = np.inf
    for k in range(steps):
        tab.step(k / 20)
        least = min(least, tab.look(tab.page.q[:7]).far)
        tab.page.q = tab.next
    return least


def test_right_functions_meet_the_librarys_line_and_slopes():
    tab = near(vars(lab))
    assert "your gradient equals the library" in said(tab)
    assert "r47-bad" not in said(tab)
    assert np.allclose(tab.line.points, tab.right.points)
    assert np.allclose(tab.bars.values, tab.bars.wanted)
    p, o = tab.right.points[0]
    assert np.linalg.norm(p - o) > 0.045  # axes: both radii lie between
    assert tab.own.says()[1] == "good"


def test_the_distance_on_the_panel_follows_the_post():
    tab = near(vars(lab))
    before = tab.look(tab.page.q[:7]).far
    tab.sets("radius")(60.0)
    assert f"yours {1000 * (before - 0.02):.1f} mm" in said(tab)


def test_a_wrong_sign_turns_the_bars_away_from_their_marks():
    def towards(*given):
        return -lab.distance_gradient(*given)

    tab = near({**vars(lab), "distance_gradient": towards})
    assert "your gradient differs from the library" in said(tab)
    assert np.allclose(tab.bars.values, -tab.bars.wanted)
    assert np.abs(tab.bars.wanted).max() > 0.1
    assert tab.own.says()[1] == "bad"


def test_points_that_are_swapped_turn_the_slopes_round_and_no_distance():
    def swapped(*given):
        return lab.closest_points_segments(*given)[::-1]

    tab = near({**vars(lab), "closest_points_segments": swapped})
    assert "your gradient differs from the library" in said(tab)
    assert said(tab).count("r47-bad") == 1
    assert np.allclose(tab.line.points, tab.right.points[:, ::-1])


def test_ends_only_draws_another_line_than_the_librarys():
    def ends(a0, a1, b0, b1):
        return np.array([a1, b0])

    tab = near({**vars(lab), "closest_points_segments": ends})
    assert not np.allclose(tab.line.points, tab.right.points)


def test_a_push_goes_in_and_a_slowed_one_stays_out():
    assert pushed(near(vars(lab)), "push") < -0.01
    tab = near(vars(lab))
    least = pushed(tab, "push with damper", 80)
    assert 0.003 < least < 3 * lab.MARGIN  # two pairs are near in places


def test_a_save_plays_a_slowed_push_from_where_the_last_one_began():
    tab = near(vars(lab))
    start = tab.page.q
    tab.page.move = lambda q: setattr(tab.page, "q", q)
    for _ in range(2):  # opened, then saved
        tab.begin()
        assert np.array_equal(tab.page.q, start)
        assert tab.how == "push with damper"
        tab.step(0.0)
        tab.shown(0.0)
        assert not np.array_equal(tab.page.q, start)
    tab.page.q = elsewhere = start + 0.1  # by a person
    tab.begin()
    assert np.array_equal(tab.page.q, elsewhere)


def test_a_push_that_is_slowed_the_wrong_way_goes_in():
    def pushed_in(qd, slope, distance, gain):
        return 2 * qd - lab.velocity_damper(qd, slope, distance, gain)

    assert (
        pushed(near({**vars(lab), "velocity_damper": pushed_in}), "push with damper")
        < -0.01
    )


def test_a_function_that_stops_shows_no_line():
    tab = near(vars(lab))
    tab.lost()
    assert not np.any(tab.line.points)
    assert said(tab) == ""


def test_without_a_file_the_tab_says_that_it_is_the_librarys():
    assert "there is no file yet" in near(None).own.says()[0]


def test_an_arm_with_a_hand_shows_the_hands_capsules():
    need(importlib.util.find_spec("viser") is not None, "viser: make view")
    model = panda.load("panda")
    page = paper(model, panda.home_q(model), vars(lab))
    page.bars.side_effect = lambda *_: Marks()
    tab = DAY.module("inspector").Near(page)
    assert len(tab.arm.capsules) == len(shapes.LINKS) + len(shapes.HAND)
