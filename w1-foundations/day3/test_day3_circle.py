"""Day 3's circle: what is geometry, what the damping costs; and the two tabs."""

import importlib.util

import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need, paper
from labkit.lesson.day import find_day
from robo47 import jacobian, panda, screws, verify

import day3_mujoco

GUIDE = " ".join((ROOT / "w1-foundations/docs/day3-lab.md").read_text("utf-8").split())
DAY = find_day(3)
ARM = DAY.module("jacobians").arm()  # screws, M and limits
ARMS = ARM[:2], ARM[2]

lab = load_script(ROOT / "w1-foundations/src/day3_jacobian_ik.py")


def site_jacobian(q):
    """Return the library's J_site, (..., 6, 7)."""
    J_space = jacobian.space_jacobian(ARM[0], q)
    return jacobian.site_jacobian(J_space, screws.fk_space(*ARM[:2], q)[..., :3, 3])


def circle(radius, first=0.0):
    """Return the circle's poses, DT apart, and q at the first."""
    times = first + np.arange(0.0, day3_mujoco.LAP, lab.DT)
    return day3_mujoco.circle(*ARMS, radius, times)


def drawn(radius, damping, off=0.0):
    """Return misses in mm, shares of the speed limits, and angles."""
    path, q = circle(radius)
    miss, speeds, path = lab.draw_circle(ARM[:2], path, q + off, damping)
    return miss, (speeds / lab.SPEED).max(axis=1), path


def out_of_reach(radius, limits=ARM[2]):
    """Return the best misses along the circle in mm, (n,); over 1e-3: out of reach."""
    path, q = circle(radius)
    return day3_mujoco.least_miss(ARM[:2], limits, path[:-1], q)


def test_by_hand_the_larger_circle_is_12_mm_too_far():
    reach = np.hypot(0.316, 0.0825) + np.hypot(0.384, 0.0825)
    assert f"= {reach:.4f}" in GUIDE
    x, y, z = day3_mujoco.CENTRE
    side = np.hypot(x, y) - 0.088
    far = [np.hypot(side, z + r + 0.107 - 0.333)
           for r in (lab.EASY, lab.RADIUS)]  # fmt: skip
    assert far[0] < reach
    says = f"{far[0]:.4f} m for $r$ = 0.36 m. For $r$ = 0.38 m it is {far[1]:.4f} m, "
    assert says + f"which is {1000 * (far[1] - reach):.0f} mm too far" in GUIDE
    # The worst point is after the top: there the hand is higher than far from the base.
    hands = circle(lab.RADIUS)[0][:, :3, 3]
    sides = np.hypot(hands[:, 0], hands[:, 1]) - 0.088
    over = 1000 * (np.hypot(sides, hands[:, 2] + 0.107 - 0.333) - reach)
    late = lab.DT * (over.argmax() - hands[:, 2].argmax())
    assert f"the worst point is {late:.1f} s after the top" in GUIDE
    assert f"the same calculation gives {over.max():.2f} mm there" in GUIDE


@pytest.mark.kit
@pytest.mark.parametrize("radius", [0.36, 0.366, 0.368, 0.38])
def test_from_which_radius_on_the_circle_leaves_the_reach(radius):
    best = out_of_reach(radius)
    assert (best.max() > 1e-3) == (radius > 0.367)
    if radius == lab.RADIUS:  # the joint limits are not the reason
        free = out_of_reach(radius, np.tile([-9.0, 9.0], (7, 1)))
        assert (free > 1e-3).sum() == (best > 1e-3).sum() == 33
        assert f"miss the circle by {best.max():.2f} mm" in GUIDE
        path, q = circle(radius)
        late = best.argmax() - path[:, 2, 3].argmax()
        worst = path[best.argmax()]
        there = screws.fk_space(*ARM[:2], jacobian.solve_ik(*ARM[:2], worst, q, ARM[2]))
        tilt = np.degrees(np.linalg.norm(jacobian.pose_error(there, worst)[:3]))
        assert f"the worst point is {late * lab.DT:.1f} s after the top" in GUIDE
        assert f"the tool tilts by {tilt:.1f} degrees, which shortens" in GUIDE
    assert "(0.366 is in reach, 0.368 is not)" in GUIDE


@pytest.mark.kit
def test_a_tool_that_may_tilt_comes_closer():
    S, M, limits = ARM
    goals, _ = day3_mujoco.circle(*ARMS, lab.RADIUS, np.arange(1.3, 1.9, 0.02))
    start = circle(lab.RADIUS)[1]
    tenth = np.array([1.0] * 3 + [10] * 3)
    M10, far = M.copy(), goals.copy()  # lengths ten times as large: a radian is 0.1 m
    M10[:3, 3] = 10 * M[:3, 3]
    far[:, :3, 3] = 10 * goals[:, :3, 3]
    q = jacobian.solve_ik(S * tenth, M10, far, start, limits)
    e = jacobian.pose_error(screws.fk_space(S, M, q), goals)
    tilt, miss = (np.linalg.norm(x, axis=1).max() for x in (e[:, :3], e[:, 3:]))
    says = f"tilt the tool by {np.degrees(tilt):.1f} degrees and miss the circle by "
    assert says + f"{1000 * miss:.1f} mm" in GUIDE


@pytest.mark.parametrize("radius", [0.36, 0.366])
def test_where_the_arm_can_go_the_plain_pseudo_inverse_is_the_better_one(radius):
    damped, *_ = drawn(radius, lab.DAMPING)
    plain, rate, _ = drawn(radius, 0.0)
    assert damped.max() > 6 * plain.max()
    assert rate.max() < 1.0
    if radius == lab.EASY:
        assert plain.max() < 1.0
        assert rate.max() < 0.6
        says = f"at most {plain.max():.1f} mm, compared with {damped.max():.1f} mm"
        assert f"{says} with damping" in GUIDE


@pytest.mark.parametrize(
    "changed", [{"DT": 0.05}, {"DT": 0.1}, {"GAIN": 2.0}, {"LAP": 12.0}], ids=str
)
@pytest.mark.parametrize("centre", [(0.28, -0.06, 0.55), (0.45, 0.0, 0.45)], ids=str)
def test_it_is_the_better_one_at_other_steps_gains_laps_and_centres(
    monkeypatch, changed, centre
):
    for name, value in changed.items():
        monkeypatch.setattr(day3_mujoco if name == "LAP" else lab, name, value)
    monkeypatch.setattr(day3_mujoco, "CENTRE", np.array(centre))
    damped, plain = (drawn(lab.EASY, x)[0].max() for x in (lab.DAMPING, 0.0))
    assert damped > 1.3 * plain


@pytest.mark.parametrize(("share", "grows"), [(0.9, False), (1.1, True)])
def test_over_2_in_a_step_the_correction_of_an_error_grows(monkeypatch, share, grows):
    monkeypatch.setattr(lab, "GAIN", share * 2.0 / lab.DT)
    assert (drawn(lab.EASY, lab.DAMPING)[1].max() > 2.0) == grows


@pytest.mark.kit
def test_what_the_damping_costs_shows_at_the_bottom():
    best = out_of_reach(lab.RADIUS)
    off, _, path = drawn(lab.RADIUS, lab.DAMPING)
    worst = (off - best).argmax()
    assert best[worst] < 1e-3
    says = f"after {worst * lab.DT:.2f} s the hand is {(off - best).max():.1f} mm off"
    assert says in GUIDE
    least = np.linalg.svd(site_jacobian(path[200:260]))[1][:, -1]
    says = f"After {4 + least.argmin() * lab.DT:.2f} s its smallest singular value is"
    assert f"{says} {least.min():.3f}" in GUIDE
    # The plain one, from where the damped one is after 3 s: the same circle, shifted.
    later, _ = circle(lab.RADIUS, first=3.0)
    plain, speeds, _ = lab.draw_circle(ARM[:2], later, path[150], 0.0)
    plain, speeds = plain[:145], speeds[:145]
    assert f"within {plain[10:].max():.2f} mm of the circle" in GUIDE
    assert f"at {(speeds / lab.SPEED).max():.2f} of its speed limit" in GUIDE
    assert drawn(lab.RADIUS, 0.0)[1][200:].max() > 1.0  # from the top on, as drawn


@pytest.mark.kit
def test_half_the_damping_changes_its_own_price_and_not_the_geometry():
    best = out_of_reach(lab.RADIUS)
    off, _, _ = drawn(lab.RADIUS, lab.DAMPING / 2)
    assert f"{off.max():.2f} mm instead of 14.71" in GUIDE
    assert f"{(off - best).max():.1f} mm instead of 11.4" in GUIDE
    assert (
        f"with 0.015 the fastest joint moves at {drawn(0.38, 0.015)[1].max():.2f}"
        in GUIDE
    )


def test_out_of_reach_the_plain_one_depends_on_the_step_and_not_on_rounding(
    monkeypatch,
):
    off, rate, path = drawn(lab.RADIUS, 0.0)
    assert rate.max() > 5
    assert day3_mujoco.beyond(ARM[2], path) > 1.0
    assert (
        f"the hand is {off.max() / 1000:.2f} m off with a time step of 0.02 s" in GUIDE
    )
    assert abs(drawn(lab.RADIUS, 0.0, 1e-12)[0].max() - off.max()) < 1e-3
    monkeypatch.setattr(lab, "DT", 0.019)
    assert drawn(lab.RADIUS, 0.0)[0].max() > 2 * off.max()


@pytest.mark.parametrize("radius", [lab.EASY, lab.RADIUS])
def test_with_damping_the_circle_is_drawn_within_the_joint_speeds(radius):
    off, share, path = drawn(radius, lab.DAMPING)
    assert off.max() < 20.0
    assert share.max() < 1.0
    assert day3_mujoco.beyond(ARM[2], path) < 0.01


def test_the_elbow_swings_while_the_hand_stands():
    """The side quest: joint 3's direction, 400 steps of 0.005."""
    S, M, limits = ARM
    q = panda.READY_Q
    T = screws.fk_space(S, M, panda.READY_Q)
    for _ in range(400):
        now = screws.fk_space(S, M, q)
        J = lab.site_jacobian(lab.space_jacobian(S, q), now[:3, 3])
        step = lab.nullspace_projection(J, 0.005 * np.eye(7)[2])
        q = q + step + lab.dls_step(J, lab.pose_error(now, T), 0.01)
        if day3_mujoco.beyond(limits, q):
            break
    moved = np.linalg.norm(lab.pose_error(screws.fk_space(S, M, q), T))
    elbow = verify.mujoco_poses(
        panda.load("panda_nohand"), np.array([panda.READY_Q, q])
    )
    swung = elbow["body:link4"][:, :3, 3]
    assert moved < 1e-4
    assert np.linalg.norm(swung[1] - swung[0]) > 0.1


# --- the inspector's tabs, without a browser ---


def tab_with(functions=None, name="Jacobian"):
    for module in ("viser", "labkit.inspector.tab"):
        need(importlib.util.find_spec(module) is not None, f"{module}: make view")
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return getattr(DAY.module("inspector"), name)(page)


@pytest.mark.kit
def test_the_tab_shows_ones_own_columns_and_the_wrong_ones_in_red():
    J = site_jacobian(panda.READY_Q)
    tab = tab_with(vars(lab))
    tab.on_move(panda.READY_Q)
    arrows = tab.columns.points[:, 1] - tab.columns.points[:, 0]
    assert_same(arrows / 0.35, J[3:, :6].T, 1e-5)  # joint7 turns about the hand
    assert "Smallest singular value" in tab.verdict.content
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
    assert "0.00 mm and 0.0000 rad from the target" in tab.numbers.content
    assert tab.ghost.pose.called
    tab.sets("elbow", "swing")(0.2)
    q = tab.page.move.call_args.args[0]
    assert np.abs(q - panda.READY_Q).max() > 0.05
    assert "good" in tab.numbers.content
    assert day3_mujoco.beyond(limits, q) == 0.0
    tab = tab_with({**vars(lab), "nullspace_projection": lambda J, dq: dq})
    tab.sets("elbow", "swing")(0.2)
    assert "bad" in tab.numbers.content


@pytest.mark.kit
@pytest.mark.parametrize("radius", [lab.EASY, lab.RADIUS])
def test_the_circles_tab_draws_what_the_lab_draws(radius):
    shown = tab_with(vars(lab), "Circle")
    shown.sets("radius", "restart")(radius)
    path, q = circle(radius)
    assert_same(shown.pens[0].q, q, 1e-12)
    for _ in path[1:]:
        shown.advance()
    shown._frame(0.0)
    damped, plain = shown.pens
    off, share, _ = drawn(radius, lab.DAMPING)
    assert_same(damped.off[1:], off, 1e-6)
    assert_same(damped.rate[1:], share, 1e-6)
    assert max(damped.rate) < 1.0
    assert f"radius {radius:g} m" in shown.verdict.content
    if radius == lab.EASY:  # beyond it rounding grows a thousandfold and more
        off, _, _ = drawn(radius, 0.0)
        assert_same(plain.off[1:], off, 1e-6)
        assert max(plain.rate) < 1.0
    assert shown.steps == len(off)
