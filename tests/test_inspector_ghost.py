"""The student's poses against MuJoCo's: the sentence, and what is drawn."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from labkit.inspector.ghost import Ghost, compare, nearest_pose, no_pose
from robo47 import se3

pytestmark = pytest.mark.kit

FRAMES = ("link0", "link1", "ee")
GHOST = Ghost("my_fk", FRAMES, lambda model, q: [()] * 3)
TRUTH = {
    "link0": np.eye(4),
    "link1": se3.make_T(se3.Rz(0.3), [0, 0, 0.333]),
    "ee": se3.make_T(se3.Rx(1.0), [0.3, 0.1, 0.6]),
}


def said(**wrong):
    return compare(GHOST, {**TRUTH, **wrong}, "", TRUTH)


def test_the_right_poses_are_said_to_agree_in_the_students_name():
    apart = said()
    assert apart.kind == "good"
    assert apart.drawn == {}
    assert apart.sentence.startswith("YOUR my_fk agrees with MuJoCo at every frame")


def test_a_wrong_end_is_told_in_millimetres_with_the_first_frame_that_differs():
    moved = TRUTH["ee"].copy()
    moved[0, 3] += 0.744
    turned = TRUTH["link1"] @ se3.make_T(se3.Rz(0.1), [0, 0, 0])
    apart = said(ee=moved, link1=turned)
    assert apart.kind == "bad"
    assert "off by 744 mm at ee; first frame that differs: link1" in apart.sentence
    assert set(apart.drawn) == {"link1", "ee"}


def test_a_frame_in_its_place_but_turned_is_told_in_degrees():
    turned = TRUTH["ee"] @ se3.make_T(se3.Rz(np.radians(12.5)), [0, 0, 0])
    assert "off by 12.5 degrees at ee" in said(ee=turned).sentence


def test_a_difference_in_the_last_digits_is_not_agreement():
    moved = TRUTH["ee"].copy()
    moved[0, 3] += 2e-8
    assert said(ee=moved).kind == "bad"
    assert "2.0e-08" in said(ee=moved).sentence


def test_a_matrix_without_a_rotation_is_drawn_as_the_nearest_one_and_said():
    bent = TRUTH["ee"].copy()
    bent[:3, :3] *= 1.3
    apart = said(ee=bent)
    assert "ee has no rotation in it" in apart.sentence
    assert se3.is_pose(apart.drawn["ee"])


def test_without_the_last_frame_the_reason_is_said_and_nothing_agrees():
    some = {"link0": TRUTH["link0"]}
    apart = compare(GHOST, some, "my_fk stops with X.", TRUTH)
    assert apart.kind == "bad"
    assert apart.sentence == "my_fk stops with X."


def test_an_end_alone_agrees_here_and_not_everywhere():
    end, why = {"ee": TRUTH["ee"]}, "Only ee is drawn: no path."
    apart = compare(GHOST, end, why, TRUTH)
    assert apart.kind == "good"
    assert "agrees with MuJoCo here" in apart.sentence
    assert "Only ee is drawn" in apart.sentence


@given(st.lists(st.floats(-5, 5), min_size=16, max_size=16))
def test_whatever_the_matrix_what_is_drawn_is_rigid(entries):
    assert se3.is_pose(nearest_pose(np.reshape(entries, (4, 4))))


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1.0, np.pi])
def test_a_rigid_pose_is_its_own_nearest(angle):
    T = se3.make_T(se3.Rx(angle), [1, 2, 3])
    np.testing.assert_allclose(nearest_pose(T), T, atol=1e-14)


@pytest.mark.parametrize(
    ("value", "says"),
    [
        (None, "nothing"),
        (np.eye(3), r"shape \(3, 3\)"),
        (np.full((4, 4), np.nan), "not finite"),
        (1e9 * np.eye(4)[:, ::-1], "over a kilometre"),
        (np.eye(4) + 1j, "complex128"),
        ((np.eye(4), np.eye(4)), "tuple"),
    ],
)
def test_what_is_no_pose_is_said_in_a_line(value, says):
    assert re.search(says, no_pose("my_fk", value))
    assert no_pose("my_fk", np.eye(4)) == ""
