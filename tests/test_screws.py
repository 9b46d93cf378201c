"""Screws against SciPy's expm, MuJoCo, the textbook's examples and the group's laws."""

import hypothesis.extra.numpy as hnp
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from robo47 import kinematics, panda, screws, se3, verify
from robo47.rotation_log import log_pose

# The Panda's, read off its drawing with the arm at q = 0 (omega; v).
PANDA = [
    [0, 0, 1, 0, 0, 0],
    [0, 1, 0, -0.333, 0, 0],
    [0, 0, 1, 0, 0, 0],
    [0, -1, 0, 0.649, 0, -0.0825],
    [0, 0, 1, 0, 0, 0],
    [0, -1, 0, 1.033, 0, 0],
    [0, 0, -1, 0, 0.088, 0],
]
# Franka's published table: alpha, a, d; the last row is the flange.
FRANKA_DH = [
    [0, 0, 0.333],
    [-np.pi / 2, 0, 0],
    [np.pi / 2, 0, 0.316],
    [np.pi / 2, 0.0825, 0],
    [-np.pi / 2, -0.0825, 0.384],
    [np.pi / 2, 0, 0],
    [np.pi / 2, 0.088, 0],
    [0, 0, 0.107],
]
# The arm of the textbook's library (FKinSpace): a hinge, a slide, a screw with pitch.
BOOK_M = [[-1, 0, 0, 0], [0, 1, 0, 6], [0, 0, -1, 2], [0, 0, 0, 1]]
BOOK_SPACE = [[0, 0, 1, 4, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, -1, -6, 0, -0.1]]
BOOK_BODY = [[0, 0, -1, 2, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 1, 0, 0, 0.1]]
BOOK_Q = [np.pi / 2, 3, np.pi]
BOOK_T = [[0, 1, 0, -5], [1, 0, 0, 4], [0, 0, -1, 1.68584073], [0, 0, 0, 1]]

vectors = hnp.arrays(np.float64, 3, elements=st.floats(-3, 3))
twists = hnp.arrays(np.float64, 6, elements=st.floats(-3, 3))
directions = vectors.filter(lambda v: np.linalg.norm(v) > 1e-3).map(
    lambda v: v / np.linalg.norm(v)
)
angles = st.one_of(
    st.floats(-2 * np.pi, 2 * np.pi),
    st.sampled_from([0.0, 1e-300, 1e-16, 1e-9, -1e-7, np.pi, -np.pi]),
)


@st.composite
def any_screws(draw):
    """Return a hinge, a screw with pitch, or a slide."""
    omega = draw(st.one_of(directions, st.just(np.zeros(3))))
    return np.concatenate([omega, draw(vectors)])


@st.composite
def poses(draw):
    return se3.make_T(se3.axis_angle(draw(directions), draw(angles)), draw(vectors))


def bracket(S):
    """Return the 4x4 matrix of a twist, whose exponential is the motion."""
    out = np.zeros((4, 4))
    out[:3, :3], out[:3, 3] = np.cross(np.eye(3), S[:3]), S[3:]
    return out


def arm(model):
    return panda.screws(model), panda.home_pose(model)


# --- the algebra ---


@given(vectors, vectors)
def test_skew_does_the_cross_product(w, p):
    assert_same(screws.skew(w) @ p, np.cross(w, p), 1e-14)


@given(directions, angles)
def test_a_rotation_about_an_axis_agrees_with_scipy(axis, theta):
    truth = Rotation.from_rotvec(axis * theta).as_matrix()
    assert_same(screws.exp_rotation(axis, theta), truth, 2e-14)


@given(directions, vectors, angles)
def test_a_hinge_leaves_the_points_of_its_line_where_they_are(axis, point, theta):
    T = screws.exp_screw(screws.screw_axis(axis, point), theta)
    assert_same((T @ [*point, 1.0])[:3], point, 1e-13)


@given(any_screws(), angles)
def test_the_exponential_of_a_screw_agrees_with_scipy(S, theta):
    assert_same(screws.exp_screw(S, theta), expm(bracket(S) * theta), 2e-12)


@given(poses(), any_screws(), angles)
def test_the_adjoint_moves_a_screw_as_the_pose_moves_its_motion(T, S, theta):
    seen = screws.exp_screw(screws.adjoint(T) @ S, theta)
    assert_same(seen, T @ screws.exp_screw(S, theta) @ se3.inverse(T), 1e-11)


@given(twists, twists)
def test_ad_is_the_lie_bracket_of_twists(V, W):
    truth = bracket(V) @ bracket(W) - bracket(W) @ bracket(V)
    assert_same(bracket(screws.ad(V) @ W), truth, 1e-13)


# --- worked cases ---


def test_the_worked_cases_of_the_lesson():
    assert_same(screws.skew([0, 0, 1]) @ [1, 0, 0], [0, 1, 0], 0.0)
    assert_same(screws.exp_rotation([0, 0, 1], 0.3), se3.Rz(0.3), 1e-16)
    S = screws.screw_axis([0, 0, 1], [1, 0, 0])
    assert_same(S, [0, 0, 1, 0, -1, 0], 0.0)
    assert_same(screws.exp_screw(S, np.pi / 2)[:3, 3], [1, -1, 0], 1e-15)
    moved = screws.adjoint(se3.make_T(np.eye(3), [1, 0, 0])) @ [0, 0, 1, 0, 0, 0]
    assert_same(moved, [0, 0, 1, 0, -1, 0], 0.0)
    link3 = screws.dh_link(np.pi / 2, 0, 0.316, 0)
    assert_same(link3[:3, 3], [0, -0.316, 0], 1e-16)


def test_the_textbooks_example_of_forward_kinematics():
    # Modern Robotics' code library: the examples of FKinSpace and FKinBody.
    assert_same(screws.fk_space(BOOK_SPACE, BOOK_M, BOOK_Q), BOOK_T, 1e-8)
    assert_same(screws.fk_body(BOOK_BODY, BOOK_M, BOOK_Q), BOOK_T, 1e-8)
    assert_same(screws.body_screws(BOOK_SPACE, BOOK_M), BOOK_BODY, 1e-15)


# --- the Panda ---


@pytest.mark.parametrize("entry", ["panda_nohand", "panda", "scene"])
def test_the_pandas_screws_are_those_of_the_drawing(entry):
    S, M = arm(panda.load(entry))
    assert_same(S, PANDA, 1e-15)
    assert_same(M[:3, 3], [0.088, 0, 0.926], 1e-15)


def test_the_pandas_links_at_zero_give_the_same_screws(either_panda):
    T_zero = kinematics.fk_all(either_panda, np.zeros(7))
    links = [T_zero[f"body:link{i}"] for i in range(1, 8)]
    S, M = arm(either_panda)
    assert_same(screws.joint_screws(links), S, 1e-15)
    assert_same(screws.body_screws(S, M)[-1], [0, 0, 1, 0, 0, 0], 1e-15)


@pytest.mark.parametrize("entry", ["panda_nohand", "panda"])
def test_the_product_of_exponentials_is_where_mujoco_puts_the_hand(entry):
    model = panda.load(entry)
    S, M = arm(model)
    q = verify.random_q(model, 1000, seed=47)
    truth = verify.mujoco_poses(model, q)[panda.END_FRAME[entry]]
    assert_same(screws.fk_space(S, M, q[:, :7]), truth, 1e-14)
    assert_same(screws.fk_body(screws.body_screws(S, M), M, q[:, :7]), truth, 1e-14)
    product = M
    for i in reversed(range(7)):  # as the formula reads, without the batched pass
        product = screws.exp_screw(S[i], q[:, i]) @ product
    assert_same(product, truth, 1e-13)


def test_frankas_table_ends_at_the_flange(either_panda):
    q = verify.random_q(either_panda, 1000, seed=47)
    poses = verify.mujoco_poses(either_panda, q)
    T_world_flange = poses["body:link7"] @ se3.make_T(np.eye(3), [0, 0, 0.107])
    assert_same(screws.dh_fk(FRANKA_DH, q), T_world_flange, 1e-14)


@given(hnp.arrays(np.float64, (5, 4), elements=st.floats(-3, 3)))
def test_a_dh_link_is_its_four_moves_one_after_the_other(rows):
    alpha, a, d, theta = rows.T
    zero, none = np.zeros(5), np.zeros((5, 3))
    Tx = se3.make_T(np.eye(3), np.stack([a, zero, zero], axis=-1))
    Tz = se3.make_T(np.eye(3), np.stack([zero, zero, d], axis=-1))
    Rx, Rz = se3.make_T(se3.Rx(alpha), none), se3.make_T(se3.Rz(theta), none)
    assert_same(screws.dh_link(alpha, a, d, theta), Rx @ Tx @ Rz @ Tz, 1e-14)


# --- any arm, any batch ---


@settings(max_examples=50)
@given(st.lists(any_screws(), min_size=1, max_size=5), poses(), st.data())
def test_the_batched_pass_is_the_product_of_exponentials_for_any_screws(S, M, data):
    S = np.array(S)
    q = data.draw(hnp.arrays(np.float64, len(S), elements=st.floats(-4, 4)))
    truth = M
    for row, angle in zip(S[::-1], q[::-1], strict=True):
        truth = expm(bracket(row) * angle) @ truth
    assert_same(screws.fk_space(S, M, q), truth, 1e-10)
    assert_same(screws.fk_body(screws.body_screws(S, M), M, q), truth, 1e-10)


def test_leading_dimensions_broadcast():
    S, M = np.array(PANDA), np.array(BOOK_M)
    q = np.random.default_rng(47).uniform(-2, 2, (4, 5, 7))
    T = screws.fk_space(S, M, q)
    assert T.shape == (4, 5, 4, 4)
    stacked = screws.fk_space(np.stack([S, S[::-1]])[:, None, None], M, q)
    assert stacked.shape == (2, 4, 5, 4, 4)
    assert_same(stacked[0], T, 1e-13)
    assert_same(screws.fk_space(S, np.stack([M, M]), q[0, 0])[1], T[0, 0], 1e-13)
    assert screws.fk_space(S, M, np.empty((0, 7))).shape == (0, 4, 4)
    assert screws.adjoint(T).shape == (4, 5, 6, 6)
    assert screws.ad(np.zeros((4, 6))).shape == (4, 6, 6)
    assert screws.dh_fk(FRANKA_DH, q).shape == (4, 5, 4, 4)
    assert_same(screws.dh_fk(FRANKA_DH, q)[1, 2], screws.dh_fk(FRANKA_DH, q[1, 2]), 0)


# --- mistakes of the caller ---

LONG = np.array(PANDA, dtype=float)
LONG[2, :3] *= 2.0


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: screws.fk_space(LONG, BOOK_M, [0] * 7), r"screws\[2\] is no screw"),
        (lambda: screws.fk_body(LONG, BOOK_M, [0] * 7), r"body_screws\[2\] is no"),
        (lambda: screws.exp_screw(LONG[2], 1.0), "S is no screw: .* has length 2"),
        (lambda: screws.fk_space(PANDA[0], BOOK_M, [0]), r"expected \(..., n, 6\)"),
        (lambda: screws.fk_space(PANDA, BOOK_M, [0] * 6), r"q has shape \(6,\); exp"),
        (lambda: screws.fk_space(PANDA, BOOK_M, [np.nan] * 7), "q holds a number that"),
        (
            lambda: screws.fk_space(PANDA, np.ones((4, 4)), [0] * 7),
            "M_home is not a pose",
        ),
        (lambda: screws.screw_axis([0, 0, 2], [0, 0, 0]), "axis has length 2; expec"),
        (lambda: screws.exp_rotation([[0, 0, 1], [0, 3, 0]], 1), r"axis\[1\] has leng"),
        (lambda: screws.skew([1, 2]), r"w has shape \(2,\)"),
        (lambda: screws.dh_fk(FRANKA_DH[:7], [0] * 7), r"table has shape \(7, 3\) and"),
        (lambda: screws.dh_fk(FRANKA_DH, 0.0), r"q \(\); expected \(n \+ 1, 3\)"),
        (lambda: screws.dh_fk([["x"] * 3] * 8, [0] * 7), "table is not an array of n"),
    ],
)
def test_what_is_no_arm_is_named(call, words):
    with pytest.raises(ValueError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)


@given(twists)
def test_the_logarithm_of_a_pose_is_exps_inverse_by_scipys_expm(x):
    angle = np.linalg.norm(x[:3])
    if angle > np.pi - 1e-3:
        x = x * (3.0 / angle)
    T = expm(bracket(x))
    assert_same(log_pose(T), x, 1e-9)
    theta = np.linalg.norm(x[:3])
    if theta > 1e-3:
        assert_same(screws.exp_screw(x / theta, theta), T, 1e-12)


def test_the_logarithm_of_the_textbooks_pose():
    # Modern Robotics, example 3.26: s = (0, 0, 1), v = (3.37, -3.37, 0), theta pi / 6.
    near = se3.make_T(se3.Rz(np.radians(30)), [1.0, 2.0, 0.0])
    far = se3.make_T(se3.Rz(np.radians(60)), [2.0, 1.0, 0.0])
    x = log_pose(far @ se3.inverse(near))
    assert_same(x / np.radians(30), [0, 0, 1, 3.37, -3.37, 0], 0.005)


@pytest.mark.parametrize("theta", [0.0, 1e-300, 1e-12, 1e-5, 0.029, 0.031, 3.0, np.pi])
def test_the_logarithm_of_a_pose_keeps_its_digits_at_every_angle(theta):
    S = np.array([0.6, 0.0, 0.8, 0.3, -1.2, 0.5])
    T = screws.exp_screw(S, theta)
    assert_same(log_pose(T), theta * S, 1e-14)


def test_the_logarithm_of_a_slide_is_its_way():
    T = se3.make_T(np.eye(3), [[1.0, 2.0, 3.0], [0.0, 0.0, -4.0]])
    assert_same(log_pose(T), [[0, 0, 0, 1, 2, 3], [0, 0, 0, 0, 0, -4]], 0.0)
    with pytest.raises(ValueError, match="T is not a pose"):
        log_pose(np.ones((4, 4)))
