"""One wrong link or joint anywhere in the arm is found; so is where two begin."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robo47 import se3
from robo47.diagnose import Answer, calls, judge
from robo47.diagnose.arm import product, whole
from robo47.diagnose.cases import configurations
from robo47.diagnose.localise import first_wrong_joint
from robo47.diagnose.truth import right_answers

LINKS, JOINTS = range(8), range(7)


def told(S):
    return judge("1.6", [Answer(T) for T in S])


def with_changed(changes):
    """Return the arm's poses with factors changed: {index in L1, J1, L2, ...: f}."""
    q = configurations()
    factors = [factor for step in whole().steps(q) for factor in step]
    for i, change in changes.items():
        factors[i] = change(factors[i])
    return product(factors, len(q))


def random_pose(rng):
    return se3.make_T(
        se3.axis_angle(rng.normal(size=3), rng.uniform(0.2, 2.0)),
        rng.uniform(0.05, 0.3, 3),
    )


@pytest.mark.parametrize("k", LINKS)
def test_a_wrong_link_is_named(k):
    E = random_pose(np.random.default_rng(k))
    verdict = told(with_changed({2 * k: lambda L: L @ E}))
    assert verdict.mistake == "one-link-off"
    assert whole().names[k] in verdict.message
    metres, radians = se3.pose_error(E, np.eye(4))
    assert f"{np.rad2deg(radians):.1f} deg" in verdict.message
    assert f"{1000 * metres:.0f}" in verdict.message


@pytest.mark.parametrize("k", JOINTS)
@pytest.mark.parametrize(
    ("change", "slug"),
    [
        (lambda J: np.broadcast_to(np.eye(4), J.shape), "joint-skipped"),
        (se3.inverse, "turns-backwards"),
        (lambda J: J @ J, "double-angle"),
    ],
)
def test_a_wrong_joint_is_named(k, change, slug):
    verdict = told(with_changed({2 * k + 1: change}))
    assert verdict.mistake == slug
    assert f"joint{k + 1}" in verdict.message


@pytest.mark.parametrize("k", JOINTS)
def test_a_joint_at_a_wrong_angle_without_a_name_is_said_to_be_just_that(k):
    q = configurations()
    turned = se3.make_T(se3.Rz(np.sin(3 * q[:, k])), np.zeros(3))
    verdict = told(with_changed({2 * k + 1: lambda J: turned}))
    assert verdict.mistake == "joint-angle-off"
    assert f"joint{k + 1} turns about its axis, but by the wrong" in verdict.message


@settings(max_examples=20, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    first=st.integers(0, 4),
    apart=st.integers(2, 3),
)
def test_two_wrong_links_get_no_name_and_the_first_is_pointed_at(seed, first, apart):
    rng = np.random.default_rng(seed)
    A, B = random_pose(rng), random_pose(rng)
    S = with_changed({2 * first: lambda L: L @ A, 2 * (first + apart): lambda L: L @ B})
    verdict = told(S)
    assert verdict.mistake in ("pose-off", "rotation-off", "translation-off")
    assert f"link{first + 1}" in verdict.message


def test_a_shift_along_a_joints_axis_shows_at_the_next_and_both_steps_are_named():
    along = se3.make_T(np.eye(3), [0.0, 0.0, 0.1])
    bent = se3.make_T(se3.Rx(0.3), np.zeros(3))
    S = with_changed({4: lambda L: L @ along, 10: lambda L: L @ bent})
    where = first_wrong_joint(S, right_answers("compose_fk"), whole())
    assert where.startswith("Turned alone, joints 1 to 3 move it as it should")
    assert "link3 and link4" in where


def test_a_right_arm_has_no_wrong_joint():
    T = right_answers("compose_fk")
    assert first_wrong_joint(T, T, whole()) == ""


def test_two_mistakes_at_once_are_told_as_two():
    q = np.array([call.args[1] for call in calls("1.6")])
    short = whole().upto(7).fk(q, turn=lambda a: whole_turn(-a))
    assert told(short).mistake == "turns-backwards+stops-at-link7"
    half_turned = whole().fk(q[:, ::-1]) @ se3.make_T(se3.Rz(np.pi), np.zeros(3))
    assert told(half_turned).mistake == "joints-in-reverse+hand-for-attachment-site"


def whole_turn(angle):
    return se3.make_T(se3.Rz(angle), np.zeros(3))
