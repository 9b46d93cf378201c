"""Day 3's lab: its functions against oracles; the numbers in the guide's sentences."""

import importlib.util
import json
import re

import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from conftest import ROOT, load_script, need, paper
from labkit.judge.row import row_of
from labkit.lesson import folder
from labkit.lesson.day import find_day
from robo47 import jacobian, panda, screws, verify

GUIDE = " ".join((ROOT / "w1-foundations/docs/day3-lab.md").read_text("utf-8").split())
# What Pinocchio and the textbook's own package said, their rows swapped to (omega; v).
ORACLE = ROOT / "tests" / "data" / "kinematics_oracle.json"
DAY = find_day(3)
WHOSE = (ROOT / "w1-foundations/docs/which-jacobian-is-whose.md").read_text("utf-8")
WHOSE = " ".join(WHOSE.split())
ARM = folder.load(DAY, "jacobians").arm()  # screws, M and limits
ARMS = ARM[:2], ARM[2]
LOOP = folder.load(DAY, "loop")

lab = load_script(ROOT / "w1-foundations/src/day3_jacobian_ik.py")


@pytest.fixture
def arm(either_panda):
    return panda.screws(either_panda), panda.home_pose(either_panda)


def own_jacobians(arm, q):
    """Return the lab's three Jacobians at q, (n, 7)."""
    T = screws.fk_space(*arm, q)
    J_space = verify.each(lambda x: lab.space_jacobian(arm[0], x), q)
    return {
        "J_space": J_space,
        "J_site": verify.each(lab.site_jacobian, J_space, T[:, :3, 3]),
        "J_body": verify.each(lab.body_jacobian, J_space, T),
    }


@pytest.mark.parametrize(
    ("theirs", "ours"),
    [
        ("WORLD", "J_space"),
        ("LOCAL", "J_body"),
        ("LOCAL_WORLD_ALIGNED", "J_site"),
        ("JacobianSpace", "J_space"),
        ("JacobianBody", "J_body"),
    ],
)
def test_whose_jacobian_is_which(arm, theirs, ours):
    oracle = json.loads(ORACLE.read_text("utf-8"))
    q = np.array(oracle["q"])
    rows = np.reshape(oracle["answers"][theirs], (len(q), 6, 7))
    answers = own_jacobians(arm, q)
    assert_same(answers.pop(ours), rows, 1e-8)
    assert all(np.abs(other - rows).max() > 0.1 for other in answers.values())


def test_mujocos_jacobian_is_j_site(either_panda, arm):
    q = verify.random_q(either_panda, 20, seed=3)
    if either_panda.nq > 7 or either_panda.nsite == 0:
        pytest.skip("this entry has no attachment_site")
    ours = own_jacobians(arm, q)["J_site"]
    assert_same(ours, verify.mujoco_site_jacobian(either_panda, q), 1e-12)


def test_mj_jac_site_is_silent_about_what_it_lacks():
    model = panda.load("panda_nohand")
    data = mujoco.MjData(model)
    data.qpos[:] = panda.READY_Q
    jacp, jacr = np.ones((3, 7)), np.ones((3, 7))
    mujoco.mj_kinematics(model, data)  # mj_comPos is missing
    mujoco.mj_jacSite(model, data, jacp, jacr, model.site("attachment_site").id)
    assert not jacp.any()
    assert not jacr.any()


def test_the_jacobian_is_the_slope_of_the_pose(arm):
    q, h = panda.READY_Q, 1e-6
    J = own_jacobians(arm, q[None])["J_site"][0]
    for i, d in enumerate(h * np.eye(7)):
        e = lab.pose_error(screws.fk_space(*arm, q - d), screws.fk_space(*arm, q + d))
        assert_same(e / (2 * h), J[:, i], 1e-8)


@given(st.integers(0, 2**32 - 1), st.floats(0.0, np.pi))
def test_the_logarithm_is_scipys_from_0_to_pi(seed, angle):
    axis = np.random.default_rng(seed).normal(size=3)
    axis /= np.linalg.norm(axis)
    angle = min(angle, np.pi - 1e-12)
    R = Rotation.from_rotvec(angle * axis).as_matrix()
    assert_same(lab.log_rotation(R), angle * axis, 1e-9 if angle > 3 else 1e-12)


@pytest.mark.parametrize(("before", "fails"), [(1e-9, True), (0.1, False)])
def test_the_formula_of_most_books_fails_near_pi(before, fails):
    angle, axis = np.pi - before, np.array([0.6, 0.0, 0.8])
    R = screws.exp_rotation(axis, angle)
    theta = np.arccos((np.trace(R) - 1) / 2)
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    with np.errstate(all="ignore"):
        off = np.abs(theta / (2 * np.sin(theta)) * a - angle * axis).max()
    assert (not off < 1.0) if fails else off < 1e-12
    assert "off by more than 1 rad" in GUIDE
    assert_same(lab.log_rotation(R), angle * axis, 1e-9)


def test_most_mistakes_in_a_jacobian_are_right_at_zero(arm):
    S = arm[0]
    named = [way for way in row_of(DAY, "space_jacobian").ways if way.named]
    right = {way.slug for way in named
             if np.abs(way.code(S, np.zeros(7)) - S.T).max() < 1e-12}  # fmt: skip
    assert right == {way.slug for way in named} - {"columns-reversed"}


@pytest.fixture(scope="module")
def targets():
    """Return 200 targets within 0.3 rad of their starts, and these."""
    S, M, limits = ARM
    middle, rng = limits.mean(axis=1), np.random.default_rng(47)
    drawn = verify.random_q(panda.load("panda_nohand"), 200, 47)
    start = middle + 0.8 * (drawn - middle)
    near = np.clip(start + rng.uniform(-0.3, 0.3, start.shape), *limits.T)
    return screws.fk_space(S, M, near), start


def sine_for_angle(T, T_goal):
    e = jacobian.pose_error(T, T_goal)
    R = T_goal[:, :3, :3] @ np.swapaxes(T[:, :3, :3], 1, 2)
    K = (R - np.swapaxes(R, 1, 2)) / 2
    return np.hstack([K[:, [2, 0, 1], [1, 2, 0]], e[:, 3:]])


def of_the_start(start):
    S, M, _ = ARM
    J = LOOP.at_hand(jacobian.space_jacobian(S, start), screws.fk_space(S, M, start))
    return {"seen": lambda J_space, T: J}


LOOPS = {
    "all right": {},
    "`J_space` instead of `J_site`": {"seen": lambda J_space, T: J_space},
    "the sine instead of the angle in the error": {"gap": sine_for_angle},
    "J computed once, at the start": of_the_start,
    "`J_body` with the error in world axes": {"seen": jacobian.body_jacobian},
    "the error's sign wrong": {"gap": lambda T, goal: -jacobian.pose_error(T, goal)},
}


@pytest.mark.parametrize("named", LOOPS)
def test_a_loop_of_wrong_parts_may_arrive_all_the_same(targets, named):
    said = int(re.search(re.escape(f"| {named} | ") + r"(\d+)", GUIDE)[1])
    (S, M, limits), (goal, start), parts = ARM, targets, LOOPS[named]
    parts = parts(start) if callable(parts) else parts
    q = LOOP.walk(S, M, goal, start, limits, **parts)
    found = jacobian.reached(S, M, goal, q).sum()
    assert abs(found - said) <= 4  # BLAS may decide some


def test_a_target_out_of_reach_tells_the_wrong_jacobian(targets):
    (S, M, limits), start = ARM, targets[1][:12]
    middle = limits.mean(axis=1)
    start = middle + 0.7 / 0.8 * (start - middle)  # so that no limit is in the way
    goal = screws.fk_space(S, M, start + 0.1)
    goal[:, :3, 3] *= 2.0 / np.linalg.norm(goal[:, :3, 3], axis=1)[:, None]

    def miss(q):
        e = jacobian.pose_error(screws.fk_space(S, M, q), goal)
        return np.linalg.norm(e, axis=1)

    best = miss(jacobian.solve_ik(S, M, goal, start, limits))
    right, wrong = (
        miss(LOOP.walk(S, M, goal, start, limits, **LOOPS[named])) / best
        for named in ("all right", "`J_space` instead of `J_site`")
    )
    assert right.max() < 1.01
    assert 1.02 < wrong.max() < 1.15
    assert "stops up to some 5 % too far away; the right one within 1 %" in GUIDE


@pytest.mark.parametrize("turned", [0.0, 0.5])
def test_what_no_motor_feels_at_zero_is_a_wrench(arm, turned):
    q = turned * np.eye(7)[0]
    J = {name: J[0] for name, J in own_jacobians(arm, q[None]).items()}
    U, sigma, _ = np.linalg.svd(J["J_site"])
    assert sigma[-1] < 1e-12 < sigma[-2]
    u = U[:, -1] / np.sign(U[0, -1])
    assert_same(u, [np.cos(turned), np.sin(turned), 0, 0, 0, 0], 1e-9)
    assert_same(J["J_site"].T @ u, np.zeros(7), 1e-12)
    # About the world's origin it is the same moment; a twist would get another v.
    lost = np.linalg.svd(J["J_space"])[0][:, -1]
    p = screws.fk_space(*arm, q)[:3, 3]
    assert abs(lost @ u) == pytest.approx(1.0)
    assert np.abs(np.cross(p, u[:3])).max() > 0.5
    assert "Turn joint 1 by 0.5 rad, and the axis of that moment turns with it" in GUIDE


def test_in_which_jacobians_joint_7_does_not_show(arm):
    q = verify.random_q(panda.load("panda_nohand"), 200, 47)
    other = q.copy()
    other[:, 6] = verify.random_q(panda.load("panda_nohand"), 200, 48)[:, 6]
    before, after = own_jacobians(arm, q), own_jacobians(arm, other)
    change = {k: np.abs(before[k] - after[k])[:, :, :6].max() for k in before}
    assert max(change["J_space"], change["J_site"]) < 1e-12
    assert change["J_body"] > 1.9
    # Only because the hand's origin lies on its axis: off it, J_site changes as well.
    T = [screws.fk_space(*arm, x) for x in (q, other)]
    points = [t[:, :3, 3] + 0.1 * t[:, :3, 0] for t in T]
    spaces = before["J_space"], after["J_space"]
    first, second = map(jacobian.site_jacobian, spaces, points)
    assert 0.19 < np.abs(first - second)[:, :, :6].max() < 0.2
    assert_same(np.linalg.norm(first[:, 3:, 6], axis=1), np.full(200, 0.1), 1e-12)
    assert "Of a point 0.1 m off that axis it has 0.1 m/s" in GUIDE


def test_the_origin_of_joint_7_has_another_jacobian(arm):
    model, q = panda.load("panda_nohand"), panda.READY_Q[None]
    J_space = own_jacobians(arm, q)["J_space"]
    ends = verify.mujoco_poses(model, q)
    link, hand = (ends[k][:, :3, 3] for k in ("body:link7", "site:attachment_site"))
    off = jacobian.site_jacobian(J_space, link) - jacobian.site_jacobian(J_space, hand)
    most = np.linalg.norm(off[0], axis=0).max()
    assert f"v is off by up to {most:.3f} m/s for each rad/s" in WHOSE


def test_manipulability_and_the_least_singular_value_depend_on_the_unit(arm):
    q = verify.random_q(panda.load("panda_nohand"), 300, 47)
    J = own_jacobians(arm, q)["J_site"]

    def scaled(per_metre):
        return J * np.array([1.0] * 3 + [per_metre] * 3)[:, None]

    ratio = jacobian.manipulability(scaled(1000.0)) / jacobian.manipulability(J)
    assert_same(ratio / 1e9, np.ones(300), 1e-8)
    m, dm = (np.linalg.svd(x)[1][:, -1] for x in (J, scaled(10.0)))
    i, j = np.triu_indices(300, 1)
    swapped = np.mean((m[i] < m[j]) != (dm[i] < dm[j]))
    assert f"{100 * swapped:.0f} % change their order if you measure in dec" in GUIDE


def test_the_sine_cannot_tell_120_degrees_from_60(arm):
    T, goals = np.eye(4)[None], []
    for degrees in (60, 120):
        goal = np.eye(4)[None].copy()
        goal[0, :3, :3] = screws.exp_rotation([0, 0, 1], np.radians(degrees))
        goals.append(sine_for_angle(T, goal))
    assert_same(*goals, 1e-12)
    assert "it cannot tell 120 degrees from 60" in GUIDE


def test_what_pushing_down_costs_joint_2_grows_with_the_hands_distance(arm):
    T = screws.fk_space(*arm, panda.READY_Q)
    J = lab.space_jacobian(arm[0], panda.READY_Q)
    tau = lab.joint_torques(J, T[:3, 3], lab.DOWN)[1]
    assert tau == pytest.approx(10.0 * T[0, 3], abs=1e-3)
    assert f"{tau:.2f} N m. The entry of `J_site` is -{T[0, 3]:.3f} m" in GUIDE
    farther = T[:3, 3] + [0.1, 0.0, 0.0]
    assert lab.joint_torques(J, farther, lab.DOWN)[1] == pytest.approx(tau + 1.0)


def test_the_two_ellipses_have_inverse_axes_and_the_picture_is_the_labs(monkeypatch):
    need(importlib.util.find_spec("matplotlib") is not None, "matplotlib: make figures")
    monkeypatch.syspath_prepend(str(DAY.source.parent))
    figures = folder.load(DAY, "figures")
    stretched = np.linalg.svd(figures.planar(figures.STRETCHED))[1]
    assert stretched[1] < 0.15 * stretched[0]
    J = figures.planar(np.array([0.3, -0.8]))
    by_hand = [[-np.sin(0.3) + np.sin(0.5), np.sin(0.5)],
               [np.cos(0.3) + np.cos(0.5), np.cos(0.5)]]  # fmt: skip
    assert_same(J, by_hand, 1e-12)
    force = np.linalg.svd(np.linalg.inv(J.T))[1]
    assert_same(force, 1 / np.linalg.svd(J)[1][::-1], 1e-12)


def test_joint4_after_a_quarter_turn_of_joint1(arm):
    q = np.zeros(7)
    q[0] = np.pi / 2
    J = lab.space_jacobian(arm[0], q)
    assert "(0, -1, 0, 0.649, 0, -0.0825)" in GUIDE
    assert_same(arm[0][3], [0, -1, 0, 0.649, 0, -0.0825], 1e-4)
    assert_same(J[:, 3], [1, 0, 0, 0, 0.649, -0.0825], 1e-4)


# --- the circle: what of it is geometry, and what the damping costs ---


def circle(radius, first=0.0):
    """Return the circle's poses, DT apart, and q at the first."""
    times = first + np.arange(0.0, verify.LAP, lab.DT)
    return verify.circle(*ARMS, radius, times)


def drawn(radius, damping, off=0.0):
    """Return misses in mm, shares of the speed limits, and angles."""
    path, q = circle(radius)
    miss, speeds, path = lab.draw_circle(ARM[:2], path, q + off, damping)
    return miss, (speeds / lab.SPEED).max(axis=1), path


def out_of_reach(radius, limits=ARM[2]):
    """Return the best misses along the circle in mm, (n,); over 1e-3: out of reach."""
    path, q = circle(radius)
    return verify.least_miss(ARM[:2], limits, path[:-1], q)


def test_by_hand_the_larger_circle_is_12_mm_too_far():
    reach = np.hypot(0.316, 0.0825) + np.hypot(0.384, 0.0825)
    assert f"= {reach:.4f}" in GUIDE
    x, y, z = verify.CENTRE
    side = np.hypot(x, y) - 0.088
    far = [np.hypot(side, z + r + 0.107 - 0.333)
           for r in (lab.EASY, lab.RADIUS)]  # fmt: skip
    assert far[0] < reach
    says = f"{far[0]:.4f} m for 0.36, and {far[1]:.4f} m for 0.38: "
    assert says + f"{1000 * (far[1] - reach):.0f} mm too far" in GUIDE


@pytest.mark.kit
@pytest.mark.parametrize("radius", [0.36, 0.366, 0.37, 0.38])
def test_from_which_radius_on_the_circle_leaves_the_reach(radius):
    best = out_of_reach(radius)
    assert (best.max() > 1e-3) == (radius > 0.368)
    if radius == lab.RADIUS:  # the joint limits are not the reason
        free = out_of_reach(radius, np.tile([-9.0, 9.0], (7, 1)))
        assert (free > 1e-3).sum() == (best > 1e-3).sum() == 33
        assert f"miss it by {best.max():.2f} mm" in GUIDE
    assert "(0.366 is in reach, 0.37 is not)" in GUIDE


@pytest.mark.kit
def test_a_tool_that_may_tilt_comes_closer():
    S, M, limits = ARM
    goals, _ = verify.circle(*ARMS, lab.RADIUS, np.arange(1.3, 1.9, 0.02))
    start, tenth = circle(lab.RADIUS)[1], np.array([1.0] * 3 + [10] * 3)
    M10, far = M.copy(), goals.copy()  # lengths ten times as large: a radian is 0.1 m
    M10[:3, 3], far[:, :3, 3] = 10 * M[:3, 3], 10 * goals[:, :3, 3]
    q = jacobian.solve_ik(S * tenth, M10, far, start, limits)
    e = jacobian.pose_error(screws.fk_space(S, M, q), goals)
    tilt, miss = (np.linalg.norm(x, axis=1).max() for x in (e[:, :3], e[:, 3:]))
    says = f"tilts by {np.degrees(tilt):.1f} degrees and misses by {1000 * miss:.1f} mm"
    assert says in GUIDE


@pytest.mark.parametrize("radius", [0.36, 0.366])
def test_where_the_arm_can_go_the_plain_pseudo_inverse_is_the_better_one(radius):
    (damped, *_), (plain, rate, _) = drawn(radius, lab.DAMPING), drawn(radius, 0.0)
    assert damped.max() > 6 * plain.max()
    assert rate.max() < 1.0
    if radius == lab.EASY:
        says = f"{plain.max():.1f} mm off the smaller circle ({damped.max():.1f} with"
        assert says in GUIDE


@pytest.mark.kit
def test_what_the_damping_costs_shows_at_the_bottom():
    best = out_of_reach(lab.RADIUS)
    off, _, path = drawn(lab.RADIUS, lab.DAMPING)
    worst = (off - best).argmax()
    assert best[worst] < 1e-3
    assert f"after {worst * lab.DT:.2f} s" in GUIDE
    assert f"the hand is {(off - best).max():.1f} mm off" in GUIDE
    J = own_jacobians(ARM[:2], path[200:260])["J_site"]
    least = np.linalg.svd(J)[1][:, -1].min()
    assert f"a least singular value of {least:.3f}" in GUIDE
    # The plain one, from where the damped one is after 3 s: the same circle, shifted.
    later, _ = circle(lab.RADIUS, first=3.0)
    plain, speeds, _ = lab.draw_circle(ARM[:2], later, path[150], 0.0)
    plain, speeds = plain[:145], speeds[:145]
    assert f"within {plain[10:].max():.2f} mm, at" in GUIDE
    assert f"at {(speeds / lab.SPEED).max():.2f} of the speed limits" in GUIDE


@pytest.mark.kit
def test_half_the_damping_changes_its_own_price_and_not_the_geometry():
    best = out_of_reach(lab.RADIUS)
    off, _, _ = drawn(lab.RADIUS, lab.DAMPING / 2)
    assert f"{off.max():.2f} mm instead of 14.71" in GUIDE
    assert f"{(off - best).max():.1f} mm instead of 11.4" in GUIDE
    assert (
        f"with 0.015 the fastest joint is at {drawn(0.38, 0.015)[1].max():.2f}" in GUIDE
    )


def test_out_of_reach_the_plain_one_depends_on_the_step_and_not_on_rounding(
    monkeypatch,
):
    off, rate, path = drawn(lab.RADIUS, 0.0)
    assert rate.max() > 5
    assert verify.beyond(ARM[2], path) > 1.0
    assert f"double the {off.max() / 1000:.2f} m" in GUIDE
    assert abs(drawn(lab.RADIUS, 0.0, 1e-12)[0].max() - off.max()) < 1e-3
    monkeypatch.setattr(lab, "DT", 0.019)
    assert drawn(lab.RADIUS, 0.0)[0].max() > 2 * off.max()


@pytest.mark.parametrize("radius", [lab.EASY, lab.RADIUS])
def test_with_damping_the_circle_is_drawn_within_the_joint_speeds(radius):
    off, share, path = drawn(radius, lab.DAMPING)
    assert off.max() < 20.0
    assert share.max() < 1.0
    assert verify.beyond(ARM[2], path) < 0.01


def test_the_easy_circle_needs_no_damping():
    off, share, _ = drawn(lab.EASY, 0.0)
    assert off.max() < 1.0
    assert share.max() < 0.6


def test_the_elbow_swings_while_the_hand_stands(arm):
    """The side quest: joint 3's direction, 400 steps of 0.005."""
    S, M, limits = ARM
    q, T = panda.READY_Q, screws.fk_space(S, M, panda.READY_Q)
    for _ in range(400):
        now = screws.fk_space(S, M, q)
        J = lab.site_jacobian(lab.space_jacobian(S, q), now[:3, 3])
        step = lab.null_step(J, 0.005 * np.eye(7)[2])
        q = q + step + lab.dls_step(J, lab.pose_error(now, T), 0.01)
        if verify.beyond(limits, q):
            break
    moved = np.linalg.norm(lab.pose_error(screws.fk_space(S, M, q), T))
    elbow = verify.mujoco_poses(
        panda.load("panda_nohand"), np.array([panda.READY_Q, q])
    )
    swung = elbow["body:link4"][:, :3, 3]
    assert moved < 1e-4
    assert np.linalg.norm(swung[1] - swung[0]) > 0.1


# --- the inspector's tab, without a browser ---


def tab_with(functions=None, name="Jacobian"):
    for module in ("viser", "labkit.inspector.tab"):
        need(importlib.util.find_spec(module) is not None, f"{module}: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return getattr(folder.load(DAY, "inspector"), name)(page)


def test_the_tab_shows_ones_own_columns_and_the_wrong_ones_in_red():
    S, M, _ = ARM
    J = own_jacobians((S, M), panda.READY_Q[None])["J_site"][0]
    tab = tab_with(vars(lab))
    tab.on_move(panda.READY_Q)
    arrows = tab.columns.points[:, 1] - tab.columns.points[:, 0]
    assert_same(arrows / 0.35, J[3:, :6].T, 1e-5)  # joint7 turns about the hand
    assert "sigma" in tab.least.content
    assert "the same as the library's" in tab.own.says()[0]
    tab = tab_with({**vars(lab), "site_jacobian": sign_of_v})
    tab.on_move(panda.READY_Q)
    red = tab.wrong.points[:, 1] - tab.wrong.points[:, 0]
    assert len(red) >= 6
    says, kind = tab.own.says()
    assert kind == "bad"
    assert "site_jacobian by" in says
    assert "space_jacobian by" not in says


def sign_of_v(J_space, p):
    J = J_space.copy()
    J[3:] += screws.skew(p) @ J[:3]
    return J


def test_a_dragged_target_is_reached_and_a_swung_elbow_leaves_the_hand():
    S, M, limits = ARM
    goal = screws.fk_space(S, M, panda.READY_Q)
    goal[:3, 3] += [0.02, 0.03, -0.01]
    tab = tab_with(vars(lab))
    tab.follow(goal)
    assert "0.00 mm and 0.0000 rad short" in tab.numbers.content
    assert tab.ghost.pose.called
    tab.swing(0.2)
    q = tab.page.move.call_args.args[0]
    assert np.abs(q - panda.READY_Q).max() > 0.05
    assert "good" in tab.numbers.content
    assert verify.beyond(limits, q) == 0.0
    tab = tab_with({**vars(lab), "null_step": lambda J, dq: dq})
    tab.swing(0.2)
    assert "bad" in tab.numbers.content


def test_without_a_file_the_library_is_at_work_and_is_called_that():
    tab = tab_with()
    tab.on_move(panda.READY_Q)
    says, kind = tab.own.says()
    assert kind == "quiet"
    theirs = "the library's space_jacobian, site_jacobian (there is no file yet)"
    assert theirs in says


@pytest.mark.parametrize("radius", [lab.EASY, lab.RADIUS])
def test_the_circles_tab_draws_what_the_lab_draws(radius):
    shown = tab_with(vars(lab), "Circle")
    shown.turn(radius)
    path, q = circle(radius)
    assert_same(shown.pens[0].q, q, 1e-12)
    for _ in path[1:]:
        shown.draw()
    shown.show()
    damped, plain = shown.pens
    off, share, _ = drawn(radius, lab.DAMPING)
    assert_same(damped.off[1:], off, 1e-6)
    assert_same(damped.rate[1:], share, 1e-6)
    assert max(damped.rate) < 1.0
    assert f"radius {radius:g} m" in shown.numbers.content
    if radius == lab.EASY:  # beyond it rounding grows a thousandfold and more
        off, _, _ = drawn(radius, 0.0)
        assert_same(plain.off[1:], off, 1e-6)
        assert max(plain.rate) < 1.0
    assert shown.steps == len(off)
