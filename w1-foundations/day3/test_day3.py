"""Day 3's lab: its functions against oracles; the numbers in the guide's sentences."""

import importlib.util
import re

import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need
from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from robo47 import jacobian, panda, screws, se3, verify

GUIDE = " ".join((ROOT / "w1-foundations/docs/day3-lab.md").read_text("utf-8").split())
DAY = find_day(3)
WHOSE = (ROOT / "w1-foundations/docs/which-jacobian-is-whose.md").read_text("utf-8")
WHOSE = " ".join(WHOSE.split())
ARM = DAY.module("jacobians").arm()  # screws, M and limits
LOOP = DAY.module("loop")

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


def test_mj_jac_site_is_silent_about_what_it_lacks():
    model = panda.load("panda_nohand")
    data = mujoco.MjData(model)
    data.qpos[:] = panda.READY_Q
    jacp, jacr = np.ones((3, 7)), np.ones((3, 7))
    mujoco.mj_kinematics(model, data)  # mj_comPos is missing
    mujoco.mj_jacSite(model, data, jacp, jacr, model.site("attachment_site").id)
    assert not jacp.any()
    assert not jacr.any()


@pytest.mark.parametrize(("before", "fails"), [(1e-9, True), (0.1, False)])
def test_the_formula_of_most_books_fails_near_pi(before, fails):
    angle = np.pi - before
    axis = np.array([0.6, 0.0, 0.8])
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
    wrong = {"columns-reversed", "last-column-missing"}
    assert right == {way.slug for way in named} - wrong


@pytest.fixture(scope="module")
def targets():
    """Return 200 targets within 0.3 rad of their starts, and these."""
    S, M, limits = ARM
    middle = limits.mean(axis=1)
    rng = np.random.default_rng(47)
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
    "no mistake": {},
    "`J_space` instead of `J_site`": {"seen": lambda J_space, T: J_space},
    "the sine instead of the angle in the error": {"gap": sine_for_angle},
    "J computed once, at the start": of_the_start,
    "`J_body` with an error in the world frame": {"seen": jacobian.body_jacobian},
    "the error with the wrong sign": {
        "gap": lambda T, goal: -jacobian.pose_error(T, goal)
    },
}


@pytest.mark.parametrize("named", LOOPS)
def test_a_loop_of_wrong_parts_may_arrive_all_the_same(targets, named):
    said = int(re.search(re.escape(f"| {named} | ") + r"(\d+)", GUIDE)[1])
    S, M, limits = ARM
    goal, start = targets
    parts = LOOPS[named]
    parts = parts(start) if callable(parts) else parts
    q = LOOP.walk(S, M, goal, start, limits, **parts)
    found = jacobian.reached(S, M, goal, q).sum()
    assert abs(found - said) <= 4  # BLAS may decide some


def reached_by(seed, seen=LOOP.at_hand, base=0.0):
    """Return how many of 200 near targets a loop reaches.

    Args:
        seed: of targets and starts.
        seen: the Jacobian that the loop uses.
        base: metres from the world's origin to the arm's base, along x.
    """
    S, M, limits = ARM
    middle = limits.mean(axis=1)
    drawn = verify.random_q(panda.load("panda_nohand"), 200, seed)
    start = middle + 0.8 * (drawn - middle)
    shift = np.random.default_rng(seed).uniform(-0.3, 0.3, start.shape)
    hall = se3.make_T(np.eye(3), [base, 0.0, 0.0])
    S, M = S @ screws.adjoint(hall).T, hall @ M
    goal = screws.fk_space(S, M, np.clip(start + shift, *limits.T))
    q = LOOP.walk(S, M, goal, start, limits, seen=seen)
    return jacobian.reached(S, M, goal, q).sum()


def as_it_is(J_space, T):
    """Return the wrong Jacobian of the loop."""
    return J_space


@pytest.mark.kit
@pytest.mark.parametrize("seed", range(6))
def test_with_other_seeds_too_the_wrong_jacobian_arrives(seed):
    assert abs(reached_by(seed) - reached_by(seed, as_it_is)) <= 1
    assert "the two loops differ by at most one target" in GUIDE


@pytest.mark.parametrize("base", [0, 1, 5, 10])
def test_it_arrives_only_because_the_base_is_at_the_worlds_origin(base):
    """The cause is omega x p, so p is changed: the base stands away from the origin."""
    said = re.search(rf"\| {base} m \| (\d+) \| (\d+) \|", GUIDE).groups()
    found = [reached_by(47, base=base), reached_by(47, as_it_is, base)]
    assert np.abs(np.subtract(found, [int(n) for n in said])).max() <= 4


@pytest.mark.parametrize("degrees", [30.0, 60.0, 120.0, 154.0, 170.0])
def test_both_formulas_of_the_logarithm_have_all_digits_between_30_and_170(degrees):
    axis = np.array([0.48, -0.6, 0.64])
    angle = np.radians(degrees)
    R = screws.exp_rotation(axis, angle)
    a = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    cosine = (np.trace(R) - 1) / 2
    B = (R + R.T) / 2 - cosine * np.eye(3)
    column = B[:, np.diag(B).argmax()]
    second = np.sign(a @ column) * angle * column / np.linalg.norm(column)
    assert_same(a * angle / np.linalg.norm(a), angle * axis, 1e-14)
    assert_same(second, angle * axis, 1e-14)
    assert r"at any angle between $30^\circ$ and $170^\circ$" in GUIDE


def test_it_is_the_joint_limits_that_most_walks_from_ready_end_at():
    S, M, limits = ARM
    start = np.tile(panda.READY_Q, (300, 1))
    drawn = verify.random_q(panda.load("panda_nohand"), 300, 47)
    goals = screws.fk_space(S, M, drawn)
    missed = []
    for ends in (limits, np.tile([-9.0, 9.0], (7, 1))):
        q = LOOP.walk(S, M, goals, start, ends)
        fails = ~jacobian.reached(S, M, goals, q)
        missed.append(fails.sum())
        at_an_end = (q[fails, :, None] == ends).any(axis=(1, 2))
        assert (at_an_end.mean() > 0.8) == (ends is limits)
    said = re.search(r"misses (\d+) from the ready configuration, and (\d+) if", GUIDE)
    assert np.abs(np.subtract(missed, [int(n) for n in said.groups()])).max() <= 4


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.kit
def test_for_other_seeds_the_walks_from_ready_miss_as_many(seed):
    S, M, limits = ARM
    start = np.tile(panda.READY_Q, (300, 1))
    drawn = verify.random_q(panda.load("panda_nohand"), 300, seed)
    goals = screws.fk_space(S, M, drawn)
    missed = [
        (~jacobian.reached(S, M, goals, LOOP.walk(S, M, goals, start, ends))).sum()
        for ends in (limits, np.tile([-9.0, 9.0], (7, 1)))
    ]
    said = re.search(r"seeds it misses (\d+) to (\d+), and (\d+) to (\d+)\.", GUIDE)
    low, high, free_low, free_high = (int(n) for n in said.groups())
    assert low - 4 <= missed[0] <= high + 4
    assert free_low - 4 <= missed[1] <= free_high + 4


@pytest.mark.parametrize("seed", [47, 1, 2, 3, 4, 5])
def test_a_target_out_of_reach_tells_the_wrong_jacobian(seed):
    S, M, limits = ARM
    middle = limits.mean(axis=1)
    drawn = verify.random_q(panda.load("panda_nohand"), 200, seed)[:12]
    start = middle + 0.7 * (drawn - middle)  # so that no limit is in the way
    goal = screws.fk_space(S, M, start + 0.1)
    goal[:, :3, 3] *= 2.0 / np.linalg.norm(goal[:, :3, 3], axis=1)[:, None]

    def miss(q):
        e = jacobian.pose_error(screws.fk_space(S, M, q), goal)
        return np.linalg.norm(e, axis=1)

    best = miss(jacobian.solve_ik(S, M, goal, start, limits))
    right, wrong = (
        miss(LOOP.walk(S, M, goal, start, limits, **LOOPS[named])) / best
        for named in ("no mistake", "`J_space` instead of `J_site`")
    )
    assert right.max() < 1.01
    assert 1.03 < wrong.max() < 1.1
    assert "is 4 to 8 % larger than the smallest possible error (six seeds)." in GUIDE


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
    assert (
        "If you rotate joint 1 by 0.5 rad, the axis of this moment rotates with it."
        in GUIDE
    )


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
    assert "A point 0.1 m off that axis moves at 0.1 m/s" in GUIDE


def test_the_origin_of_joint_7_has_another_jacobian(arm):
    model = panda.load("panda_nohand")
    q = panda.READY_Q[None]
    J_space = own_jacobians(arm, q)["J_space"]
    ends = verify.mujoco_poses(model, q)
    link, hand = (ends[k][:, :3, 3] for k in ("body:link7", "site:attachment_site"))
    off = jacobian.site_jacobian(J_space, link) - jacobian.site_jacobian(J_space, hand)
    most = np.linalg.norm(off[0], axis=0).max()
    assert f"v is wrong by up to {most:.3f} m/s for each rad/s" in WHOSE


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
    assert f"{100 * swapped:.0f} % change this order if you measure in dec" in GUIDE


@pytest.mark.kit
def test_of_other_seeds_as_many_pairs_change_their_order(arm):
    shares = []
    for seed in range(12):
        q = verify.random_q(panda.load("panda_nohand"), 300, seed)
        p = screws.fk_space(*arm, q)[:, :3, 3]
        J = jacobian.site_jacobian(jacobian.space_jacobian(arm[0], q), p)
        rows = np.array([1.0] * 3 + [10.0] * 3)[:, None]
        m, dm = (np.linalg.svd(x)[1][:, -1] for x in (J, rows * J))
        i, j = np.triu_indices(300, 1)
        shares.append(100 * np.mean((m[i] < m[j]) != (dm[i] < dm[j])))
    assert f"{min(shares):.0f} to {max(shares):.0f} % for twelve other seeds" in GUIDE


@pytest.mark.parametrize("far", [0.01, 1.0, 100.0])
def test_no_step_of_the_loop_is_longer_than_the_bound_however_far_the_goal(arm, far):
    """|dq| <= |e| / (2 damping), which is reached for one singular value."""
    rng = np.random.default_rng(47)
    longest = 0.0
    for q in verify.random_q(panda.load("panda_nohand"), 200, 47):
        e = rng.normal(size=6)
        e *= far / np.linalg.norm(e)
        p = screws.fk_space(*arm, q)[:3, 3]
        J = lab.site_jacobian(lab.space_jacobian(arm[0], q), p)
        step = lab.dls_step(J, e, np.sqrt(e @ e / 2 + 1e-6))
        longest = max(longest, np.linalg.norm(step))
    assert longest <= np.sqrt(0.5)
    assert f"no step is longer than {np.sqrt(0.5):.2f} rad" in GUIDE


def test_the_sine_cannot_tell_120_degrees_from_60(arm):
    T = np.eye(4)[None]
    goals = []
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
    assert (
        f"{tau:.2f} N m. The entry of `J_site` for joint 2 is -{T[0, 3]:.3f} m" in GUIDE
    )
    farther = T[:3, 3] + [0.1, 0.0, 0.0]
    assert lab.joint_torques(J, farther, lab.DOWN)[1] == pytest.approx(tau + 1.0)


@pytest.mark.kit
def test_the_two_ellipses_have_inverse_axes_and_the_picture_is_the_labs(monkeypatch):
    need(importlib.util.find_spec("matplotlib") is not None, "matplotlib: make figures")
    monkeypatch.syspath_prepend(str(DAY.source.parent))
    figures = DAY.module("figures")
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
    assert "(1, 0, 0, 0, 0.649, -0.0825): both halves are rotated" in GUIDE
