"""Poses against SciPy's Rotation and the axioms of the group."""

import hypothesis.extra.numpy as hnp
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from robo47 import se3

metres = hnp.arrays(np.float64, 3, elements=st.floats(-10, 10))
# Angles from nothing to a full turn, with the hard places visited on purpose.
angles = st.one_of(
    st.floats(-2 * np.pi, 2 * np.pi),
    st.sampled_from([0.0, 1e-300, 1e-16, 1e-9, -1e-9, 1e-7, np.pi, -np.pi]),
    st.floats(1e-12, 1e-6).map(lambda small: np.pi - small),
)
directions = hnp.arrays(np.float64, 3, elements=st.floats(-1, 1)).filter(
    lambda v: np.linalg.norm(v) > 1e-3
)


@st.composite
def rotations(draw):
    return se3.axis_angle(draw(directions), draw(angles))


@st.composite
def poses(draw):
    return se3.make_T(draw(rotations()), draw(metres))


@given(poses())
def test_the_inverse_agrees_with_a_general_matrix_inverse(T):
    assert_same(se3.inverse(T), np.linalg.inv(T), 1e-12)


@given(poses(), poses())
def test_a_product_of_poses_is_a_pose(A, B):
    assert se3.is_pose(A @ B)


@given(rotations(), metres, metres)
def test_a_pose_turns_a_point_and_then_moves_it(R, t, p):
    assert_same((se3.make_T(R, t) @ [*p, 1.0])[:3], R @ p + t, 1e-12)


@given(directions, angles)
def test_axis_angle_agrees_with_scipy(axis, theta):
    truth = Rotation.from_rotvec(axis / np.linalg.norm(axis) * theta).as_matrix()
    assert_same(se3.axis_angle(axis, theta), truth, 1e-14)


@pytest.mark.parametrize("name", ["x", "y", "z"])
@given(theta=angles)
def test_turns_about_the_axes_agree_with_scipy(name, theta):
    ours = getattr(se3, f"R{name}")(theta)
    assert_same(ours, Rotation.from_euler(name, theta).as_matrix(), 1e-15)


@given(hnp.arrays(np.float64, 4, elements=st.floats(-5, 5)))
def test_quaternions_of_any_length_agree_with_scipy(q):
    if np.linalg.norm(q) < 1e-6:
        return
    truth = Rotation.from_quat(q, scalar_first=True).as_matrix()
    assert_same(se3.quat_to_R(q), truth, 1e-14)


@given(rotations())
def test_a_rotation_survives_the_round_trip_through_a_quaternion(R):
    q = se3.R_to_quat(R)
    assert q[0] >= 0.0
    assert_same(np.linalg.norm(q), 1.0, 1e-15)
    assert_same(se3.quat_to_R(q), R, 2e-15)


@given(poses(), metres, directions, angles)
def test_pose_distance_gives_back_the_distance_and_the_angle(T, d, axis, theta):
    moved = T @ se3.make_T(se3.axis_angle(axis, theta), d)
    distance, angle = se3.pose_distance(T, moved)
    assert_same(distance, np.linalg.norm(d), 1e-13)
    wrapped = abs((theta + np.pi) % (2 * np.pi) - np.pi)
    assert_same(angle, wrapped, 5e-15)


def test_pose_distance_is_exact_where_the_arccosine_loses_half_its_digits():
    for theta in (1e-9, 1e-12, np.pi - 1e-9):
        turned = se3.make_T(se3.Rx(theta), np.zeros(3))
        assert_same(se3.pose_distance(np.eye(4), turned)[1], theta, 1e-15)
    eps = np.eye(4) + np.diag([4e-16, 4e-16, 4e-16, 0.0])  # trace > 3: arccos is NaN
    assert se3.pose_distance(eps, np.eye(4))[1] == 0.0


def test_leading_dimensions_broadcast():
    rng = np.random.default_rng(47)
    q, t = rng.normal(size=(5, 1, 4)), rng.normal(size=(7, 3))
    T = se3.make_T(se3.quat_to_R(q), t)
    assert T.shape == (5, 7, 4, 4)
    assert_same(se3.inverse(T)[3, 2], se3.inverse(T[3, 2]), 0.0)
    assert_same(se3.R_to_quat(T[..., :3, :3])[4, 6], se3.R_to_quat(T[4, 6, :3, :3]), 0)
    assert_same(se3.axis_angle(t, 0.3)[2], se3.axis_angle(t[2], 0.3), 0.0)
    assert se3.Rz(np.zeros((2, 3))).shape == (2, 3, 3, 3)
    distance, angle = se3.pose_distance(T, np.eye(4))
    assert distance.shape == angle.shape == (5, 7)


def test_results_are_copies_that_share_no_memory_with_their_input():
    T = np.eye(4)
    se3.inverse(T)[0, 3] = 9.0
    assert T[0, 3] == 0.0


NOT_RIGID = np.diag([1.0, 1.0, 1.1])
MIRROR = np.diag([1.0, 1.0, -1.0])
LAST_ROW = np.eye(4)
LAST_ROW[3, :3] = [1, 2, 3]


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: se3.make_T(np.eye(4), np.zeros(3)), r"R has shape \(4, 4\)"),
        (lambda: se3.make_T(np.eye(3), np.zeros(4)), r"t has shape \(4,\)"),
        (lambda: se3.make_T(np.eye(3), 1.0), r"t has shape \(\)"),
        (lambda: se3.make_T(NOT_RIGID, np.zeros(3)), r"R is not a rotation.*0\.21"),
        (lambda: se3.make_T(MIRROR, np.zeros(3)), "left-handed"),
        (lambda: se3.make_T(np.eye(3), [0, np.nan, 0]), "t holds .* not finite"),
        (lambda: se3.make_T("R", np.zeros(3)), "R is not an array of numbers"),
        (lambda: se3.inverse(LAST_ROW), r"bottom row is \[1.0, 2.0, 3.0, 1.0\]"),
        (lambda: se3.inverse(2 * np.eye(4)), "bottom row"),
        (lambda: se3.quat_to_R(np.zeros(4)), "q_wxyz has length 0"),
        (lambda: se3.quat_to_R([1, 0, 0]), r"q_wxyz has shape \(3,\)"),
        (lambda: se3.axis_angle(np.zeros(3), 1.0), "axis has length 0"),
        (lambda: se3.Rx(np.inf), "theta holds .* not finite"),
        (lambda: se3.R_to_quat(NOT_RIGID), "R is not a rotation"),
        (lambda: se3.pose_distance(np.eye(4), np.eye(3)), r"T_b has shape \(3, 3\)"),
    ],
)
def test_bad_input_is_refused_and_named(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_is_rotation_and_is_pose_tell_right_from_wrong():
    assert se3.is_rotation(np.eye(3))
    assert se3.is_rotation(np.stack([np.eye(3)] * 4))
    assert se3.is_pose(np.eye(4))
    wrong = [NOT_RIGID, MIRROR, np.full((3, 3), np.nan), np.eye(2), np.eye(4)]
    assert not any(se3.is_rotation(R) for R in wrong)
    assert not any(se3.is_pose(T) for T in [LAST_ROW, 2 * np.eye(4), np.eye(3)])

    nearly = se3.Rz(0.3).astype(np.float32)
    assert se3.is_rotation(nearly, 1e-6)
    assert not se3.is_rotation(nearly, 1e-12)
