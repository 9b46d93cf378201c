"""Jacobians against MuJoCo, finite differences and the textbook; logs against SciPy."""

import json
from pathlib import Path

import hypothesis.extra.numpy as hnp
import numpy as np
import pytest
from compare import assert_same
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.linalg import null_space
from scipy.spatial.transform import Rotation
from test_screws import BOOK_M, PANDA, any_screws, arm, directions, poses

from robo47 import jacobian, panda, screws, se3, verify

READY = panda.READY_Q
# What Pinocchio and the textbook's own package said; scripts/make_oracle.py asks them.
ORACLE = Path(__file__).parent / "data" / "kinematics_oracle.json"
# Rounded, since NumPy's own determinant warns of numbers like 1e-311.
numbers = st.floats(-2, 2).map(lambda x: round(x, 9))
matrices = hnp.arrays(np.float64, (6, 7), elements=numbers)
steps = hnp.arrays(np.float64, 7, elements=numbers)


# --- the three Jacobians ---


def test_the_site_jacobian_is_mujocos(either_panda):
    S, M = arm(either_panda)
    q = verify.random_q(either_panda, 300, seed=47)
    p = screws.fk_space(S, M, q)[:, :3, 3]
    ours = jacobian.site_jacobian(jacobian.space_jacobian(S, q), p)
    assert_same(ours, verify.mujoco_site_jacobian(either_panda, q), 1e-14)


@settings(max_examples=50)
@given(st.lists(any_screws(), min_size=1, max_size=5), poses(), st.data())
def test_the_three_jacobians_of_any_arm_are_one_motion_seen_three_ways(S, M, data):
    S = np.array(S)
    q = data.draw(hnp.arrays(np.float64, len(S), elements=st.floats(-4, 4)))
    T = screws.fk_space(S, M, q)
    J_space = jacobian.space_jacobian(S, q)
    formula, so_far = [], np.eye(4)
    for row, angle in zip(S, q, strict=True):
        formula.append(screws.adjoint(so_far) @ row)
        so_far = so_far @ screws.exp_screw(row, angle)
    assert_same(J_space, np.transpose(formula), 1e-10)
    J_body = jacobian.body_jacobian(J_space, T)
    assert_same(screws.adjoint(T) @ J_body, J_space, 1e-9)
    J_site = jacobian.site_jacobian(J_space, T[:3, 3])
    turned = np.kron(np.eye(2), T[:3, :3])  # R on both halves
    assert_same(turned @ J_body, J_site, 1e-9)


@pytest.mark.parametrize("length", [5e-324, 2.3e-160, 1e200])
def test_a_slide_of_any_length_is_a_slide(length):
    S = np.array([[0, 0, 0, 0, length, -length], [0, 0, 1, 0.3, 0, 0]])
    J = jacobian.space_jacobian(S, [1.0, 0.5])
    assert_same(J[:, 0] / length, S[0] / length, 1e-15)
    assert_same(J[3:, 1] - S[1, 3:], [length, 0, 0], 1e-15 * max(1.0, length))


def test_the_worked_cases_of_the_lesson():
    assert_same(jacobian.space_jacobian(PANDA, np.zeros(7)), np.transpose(PANDA), 1e-16)
    spin = np.reshape([0, 0, 1, 0, 0, 0], (6, 1))
    moved = jacobian.site_jacobian(spin, [1, 0, 0])
    assert_same(moved[:, 0], [0, 0, 1, 0, 1, 0], 0.0)
    assert_same(jacobian.log_rotation(se3.Rz(np.pi / 2)), [0, 0, np.pi / 2], 1e-15)
    up = se3.make_T(np.eye(3), [0, 0, 0.1])
    assert_same(jacobian.pose_error(np.eye(4), up), [0, 0, 0, 0, 0, 0.1], 0.0)
    e = np.arange(6.0)
    assert_same(jacobian.dls_step(np.eye(6), e, 1.0), e / 2, 1e-15)
    assert_same(jacobian.manipulability(np.diag([1.0, 2.0, 3.0])), 6.0, 1e-15)
    assert_same(jacobian.nullspace_projection([[1.0, 0.0]], [1.0, 1.0]), [0, 1], 1e-15)


def test_the_zero_pose_is_singular_and_ready_is_not():
    at_zero, at_ready = jacobian.space_jacobian(PANDA, [np.zeros(7), READY])
    assert jacobian.manipulability(at_zero) < 1e-16
    assert jacobian.manipulability(at_ready) > 0.05
    assert jacobian.manipulability(np.ones((3, 2))) == 0.0


@pytest.mark.parametrize(
    ("theirs", "ours"),
    [
        ("WORLD", "J_space"),
        ("LOCAL", "J_body"),
        ("LOCAL_WORLD_ALIGNED", "J_site"),
        ("JacobianSpace", "J_space"),
        ("JacobianBody", "J_body"),
        ("FKinSpace", "T"),
        ("FKinBody", "T"),
    ],
)
def test_whose_jacobian_is_which(either_panda, theirs, ours):
    oracle = json.loads(ORACLE.read_text("utf-8"))
    S, M = arm(either_panda)
    q = np.array(oracle["q"])
    T, J = screws.fk_space(S, M, q), jacobian.space_jacobian(S, q)
    answers = {
        "T": T[:, :3],
        "J_space": J,
        "J_site": jacobian.site_jacobian(J, T[:, :3, 3]),
        "J_body": jacobian.body_jacobian(J, T),
    }
    rows = oracle["answers"][theirs]
    assert_same(answers.pop(ours).reshape(len(q), -1), rows, 3e-14)
    for other in answers.values():  # and no other one of ours would do
        if other.size == np.size(rows):
            assert np.abs(other.reshape(len(q), -1) - rows).max() > 0.1


# --- the logarithm ---

around_pi = st.one_of(
    st.sampled_from([0.0, 1e-16, 1e-15, 1e-12, 1e-9, 1e-8, 1e-7, 1e-4, 0.1]),
    st.floats(0.0, 1e-6),
).map(lambda below: np.pi - below)
all_angles = st.one_of(
    st.floats(0, np.pi),
    around_pi,
    st.sampled_from([0.0, 1e-300, 1e-160, 1e-16, 1e-9, 1e-7]),
)


@given(directions, all_angles)
@example(np.array([0.0, 0.0, 1.0]), np.pi)
@example(np.array([0.6, 0.0, -0.8]), np.pi - 1e-12)
def test_the_log_gives_back_axis_and_angle_from_0_to_pi(axis, theta):
    R = se3.axis_angle(axis, theta)
    found = jacobian.log_rotation(R)
    for truth in (axis * theta, Rotation.from_matrix(R).as_rotvec()):  # SciPy's
        same = np.pi - theta >= 1e-15 or found @ truth > 0  # at pi both signs are right
        assert_same(found, truth if same else -truth, 4e-15)


@pytest.mark.parametrize("axis", [[1, 0, 0], [0, -1, 0], [0, 0, -1], [-0.8, 0, 0.6]])
def test_at_exactly_pi_the_largest_entry_is_positive(axis):
    R = 2.0 * np.outer(axis, axis) - np.eye(3)  # half a turn, without rounding of pi
    found = jacobian.log_rotation(R)
    assert_same(found * np.sign(found @ axis), np.pi * np.array(axis), 1e-15)
    assert found[np.argmax(np.abs(axis))] > 0


@given(poses(), poses())
def test_the_pose_error_leads_to_the_goal(T, T_goal):
    e = jacobian.pose_error(T, T_goal)
    assert_same(
        Rotation.from_rotvec(e[:3]).as_matrix() @ T[:3, :3], T_goal[:3, :3], 1e-13
    )
    assert_same(T[:3, 3] + e[3:], T_goal[:3, 3], 1e-14)
    metres, radians = se3.pose_distance(T, T_goal)
    assert_same(np.linalg.norm(e[3:]), metres, 1e-14)
    assert_same(np.linalg.norm(e[:3]), radians, 1e-13)


# --- steps ---


@given(
    matrices, hnp.arrays(np.float64, 6, elements=st.floats(-2, 2)), st.floats(0.01, 2)
)
def test_the_damped_step_is_least_squares_with_the_damping_as_more_rows(J, e, damping):
    rows = np.vstack([J, damping * np.eye(7)])
    truth = np.linalg.lstsq(rows, np.concatenate([e, np.zeros(7)]))[0]
    assert_same(jacobian.dls_step(J, e, damping), truth, 1e-9)


def test_without_damping_the_step_is_the_pseudo_inverses():
    J, e = jacobian.space_jacobian(PANDA, READY), np.arange(6.0)
    assert_same(jacobian.dls_step(J, e, 0.0), np.linalg.pinv(J) @ e, 1e-12)


@given(matrices, steps)
def test_the_hand_does_not_feel_the_null_step(J, dq):
    part = jacobian.nullspace_projection(J, dq)
    if np.linalg.svd(J, compute_uv=False).min() < 1e-3:
        return  # what counts as singular is ours to say
    assert_same(J @ part, np.zeros(6), 1e-9)
    assert_same(jacobian.nullspace_projection(J, part), part, 1e-9)
    N = null_space(J)
    assert_same(part, N @ N.T @ dq, 1e-9)


def test_at_the_zero_pose_the_three_equal_screws_leave_two_more_ways():
    J = jacobian.space_jacobian(PANDA, np.zeros(7))
    ways = np.array([jacobian.nullspace_projection(J, dq) for dq in np.eye(7)])
    assert_same(J @ ways.T, np.zeros((6, 7)), 1e-14)
    assert np.linalg.matrix_rank(ways) == 7 - np.linalg.matrix_rank(J) > 1


@given(matrices)
def test_manipulability_squared_is_the_determinant(J):
    size = max(np.linalg.norm(J), 1.0)  # the determinant's rounding grows with it
    squared = jacobian.manipulability(J) ** 2
    assert_same(squared, np.linalg.det(J @ J.T), 1e-14 * size**12)
    scaled = jacobian.manipulability(np.diag([2.0] * 6) @ J)
    assert_same(scaled, 64 * jacobian.manipulability(J), 1e-12 * size**6)


# --- batches and mistakes ---


def test_leading_dimensions_broadcast():
    q = np.random.default_rng(47).uniform(-2, 2, (4, 300, 7))
    J = jacobian.space_jacobian(PANDA, q)
    assert J.shape == (4, 300, 6, 7)
    assert_same(J[3, 299], jacobian.space_jacobian(PANDA, q[3, 299]), 1e-15)
    stacked = jacobian.space_jacobian(np.stack([PANDA, PANDA])[:, None], q[0])
    assert_same(stacked[1], J[0], 1e-13)
    T = screws.fk_space(PANDA, BOOK_M, q)
    assert jacobian.body_jacobian(J, T).shape == J.shape
    assert jacobian.site_jacobian(J, T[..., :3, 3]).shape == J.shape
    e = jacobian.pose_error(T, T[0, 0])
    assert e.shape == (4, 300, 6)
    assert jacobian.dls_step(J, e, 0.1).shape == q.shape
    assert jacobian.nullspace_projection(J, q).shape == q.shape
    assert jacobian.manipulability(J).shape == (4, 300)
    assert jacobian.space_jacobian(PANDA, np.empty((0, 7))).shape == (0, 6, 7)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: jacobian.space_jacobian(PANDA, [0] * 6), r"q has shape \(6,\)"),
        (lambda: jacobian.site_jacobian(np.eye(5), [0] * 3), r"expected \(..., 6, n\)"),
        (lambda: jacobian.log_rotation(2 * np.eye(3)), "R is not a rotation"),
        (lambda: jacobian.pose_error(np.eye(4), np.ones((4, 4))), "T_goal is not a po"),
        (lambda: jacobian.dls_step(np.eye(6), [0] * 5, 0.1), r"e has shape \(5,\)"),
        (
            lambda: jacobian.dls_step(np.ones((2, 3)), [1, 1], 0),
            "J is singular and dam",
        ),
        (
            lambda: jacobian.nullspace_projection(np.eye(6), [np.nan] * 6),
            "dq holds a number that",
        ),
        (lambda: jacobian.manipulability([1, 2]), r"expected \(..., m, n\)"),
    ],
)
def test_what_does_not_fit_is_named(call, words):
    with pytest.raises(ValueError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_what_a_push_costs_is_what_mujoco_puts_in_its_place():
    model = panda.load("panda_nohand")
    q = verify.random_q(model, 20, seed=5)
    F = np.random.default_rng(6).normal(size=(20, 6))
    J = jacobian.space_jacobian(panda.screws(model), q)
    p = verify.mujoco_poses(model, q)["site:attachment_site"][:, :3, 3]
    tau = jacobian.joint_torques(J, p, F)
    assert_same(tau, verify.mujoco_external_torque(model, q, F), 1e-12)
    # About the origin the same wrench has another moment.
    about_0 = np.hstack([F[:, :3] + np.cross(p, F[:, 3:]), F[:, 3:]])
    assert_same(tau, jacobian.joint_torques(J, np.zeros(3), about_0), 1e-12)
