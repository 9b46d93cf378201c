"""Day 13: the numbers in the guide's sentences, and every reason in it."""

import re
from itertools import pairwise
from unittest.mock import patch

import mujoco
import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from robo47 import optimal, panda
from robo47.jacobian import dls_step, pose_error

import day13_mujoco

DAY = find_day(13)
SENTENCES = sentences(13)
lab = load_script(ROOT / "w2-autonomy/src/day13_optimal.py")
MODEL = day13_mujoco.arm()
ARM = panda.arm(MODEL)
H = MODEL.opt.timestep
X = lab.JUDGED * np.append(lab.WAY, np.zeros(7))
SLOPE, A, B = lab.at_rest(MODEL, lab.READY_Q, H)
P, K = lab.promise(A, B, H)
BEST = optimal.cost_to_go(P, X)


def costs(P, K, both=True):
    """Return cost over own promise, and over the best cost, of both sides."""
    sides = [lab.paid(MODEL, K, x) for x in ((X, -X) if both else (X,))]
    return np.mean(sides) / optimal.cost_to_go(P, X), np.mean(sides) / BEST


def with_slope(slope):
    """Return P and K with another slope of gravity."""
    now = ARM.at(lab.READY_Q)
    return lab.promise(*optimal.linearise(now.M, slope, ARM.damping, H), H)


def clipped(J, e, lo, hi, damping=lab.DAMPING):
    """Return Day 3's step, clipped."""
    return np.clip(dls_step(J, e, damping), lo, hi)


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints, with predictions of all three numbers."""
    stiff = "stiffness of joint 2, N m/rad"
    other = "measured / predicted cost, stretched by 0.1 rad"
    asked = (stiff, other, "largest error on a circle of 0.38 m, mm")
    return printed_by(lab, dict.fromkeys(asked, "1"))


@pytest.mark.kit
def test_the_three_predictions_are_answered_and_measured(printed):
    sheet = (DAY.folder / DAY.worksheet).read_text("utf-8")
    slope = SLOPE[1, 1]
    ratio = lab.Q_COST[0] / lab.R_COST
    stiff = -slope + np.sqrt(slope**2 + ratio)
    assert f"gravity stiffness of joint 2 is {slope:.1f} N m/rad" in SENTENCES
    assert f"= {stiff:.1f} N m/rad" in SENTENCES
    assert f"sqrt(10,000) = {np.sqrt(ratio):.0f}" in SENTENCES
    for number in ("stiffness of joint 2", "measured / predicted", "largest error"):
        assert f"| {number}" in sheet
        assert re.search(rf"measured [\d.]+:\s+{re.escape(number)}", printed)
    one, other = lab.kept(MODEL, P, K, 0.1)[::-1]
    assert f"costs {one:.3f} times the predicted cost" in SENTENCES
    assert f"so {one:.3f} becomes {2 - one:.3f}" in SENTENCES
    assert abs(other - (2 - one)) < 0.003


@pytest.mark.kit
def test_all_wrong_slopes_but_one_hold_the_arm_and_most_cost_little():
    now = ARM.at(lab.READY_Q)
    given = now.J_space, ARM.masses, now.coms_world, ARM.gravity
    falls, dear, off = [], [], []
    script = load_script(ROOT / "w2-autonomy/day13/wrong_stiffness.py")
    for name, stiffness in script.formulas(*given).items():
        wrong = with_slope(stiffness)
        kept, over_best = costs(*wrong)
        if np.abs(np.linalg.eigvals(A - B @ wrong[1])).max() >= 1:
            falls.append(name)
        dear.append(over_best)
        off.append(abs(kept - 1))
    assert len(off) - len(falls) > 30
    assert falls == ["lever-sign"]
    assert np.mean(np.less(dear, 1.1)) >= 0.75
    assert "We implemented more than thirty of them" in SENTENCES
    assert "with all but one the arm stays still" in SENTENCES
    assert "it is less than 10 % above the minimum" in SENTENCES
    third = 100 * sorted(off)[2]
    assert (
        f"all but two of the wrong controllers, they differ by at least {third:.1f} %"
        in (SENTENCES)
    )
    assert abs(costs(P, K)[0] - 1) < 1e-5  # to 1 in 100,000


def test_by_hand_one_hinge_one_joint_one_box():
    J = np.array([[0.0, 1, 0, 0, 0, 0]]).T
    g = np.array([0, 0, -9.81])
    assert np.allclose(np.cross(g, J[:3, 0]), (9.81, 0, 0))
    for side, known in ((1, -19.62), (-1, 19.62)):
        slope = lab.gravity_stiffness(J, np.array([2.0]), np.array([[0, 0, side]]), g)
        assert slope == pytest.approx(known)
    step = lab.linearise(np.eye(1), 10 * np.eye(1), np.ones(1), 0.1)
    assert np.allclose(step[0], np.array([[10, 1], [-10, 10]]) / 11)
    assert np.allclose(step[1], np.array([[0.1], [1]]) / 11)
    box = np.array([[2.0, 1], [1, 2]]), np.array([-2.0, -10]), -np.ones(2), np.ones(2)
    assert np.allclose(np.linalg.solve(box[0], -box[1]), (-2, 6))
    assert np.allclose(box[0] @ (-1, 1) + box[1], (-3, -9))
    assert np.allclose(box[0] @ (0.5, 1) + box[1], (0, -7.5))
    assert lab.kkt_residual(*box, np.array([-1.0, 1])) == 2
    assert np.allclose(lab.box_qp(*box, np.zeros(2)), (0.5, 1))
    wider = (*box[:3], np.array([1.0, 1.01]))
    best = [optimal.box_qp(*one, np.zeros(2)) for one in (box, wider)]
    saved = np.subtract(*(x @ box[0] @ x / 2 + box[1] @ x for x in best))
    assert saved == pytest.approx(0.075, rel=0.01)


@pytest.mark.kit
def test_the_formula_of_the_stiffness_has_no_step_and_the_gap_halves_with_it():
    first = []
    for h in (0.004, 0.002, 0.001, 0.0005):
        with patch.object(lab, "STEPS", round(3 / h)):
            step = lab.at_rest(MODEL, lab.READY_Q, h)[1:]
            first.append(np.diag(lab.promise(*step, h)[1])[:2])
    joint_1, joint_2 = np.array(first).T
    known = ", ".join(f"{x:.1f}" for x in joint_1[:3]) + f" and {joint_1[3]:.1f}"
    assert f"stiffness of joint 1 is {known} N m/rad" in SENTENCES
    assert f"held with {joint_2[1]:.1f} N m/rad and not with 135.1" in SENTENCES
    gap = 100 - joint_1
    assert np.allclose(gap[:-1] / gap[1:], 2, atol=0.06)


def test_one_side_is_off_by_a_cubic_term_and_the_mean_of_both_is_not():
    near, far = (lab.kept(MODEL, P, K, size) for size in (0.01, 0.1))
    assert f"prediction by {100 * (near[1] - 1):.2f} % at 10 mrad" in SENTENCES
    assert (far[1] - 1) / (near[1] - 1) == pytest.approx(10, rel=0.05)
    assert (near[1] - 1) / (1 - near[0]) == pytest.approx(1, rel=0.02)
    assert f"off by {near.mean() - 1:.0e}".replace("e-0", "e-") in SENTENCES
    assert (far.mean() - 1) / (near.mean() - 1) == pytest.approx(100, rel=0.02)
    wrong = with_slope(np.triu(SLOPE))
    kept, _ = costs(*wrong)
    alone, _ = costs(*wrong, both=False)
    words = f"the mean is off by {100 * (kept - 1):.1f} %, but the stretched start"
    assert f"{words} alone only by {100 * (alone - 1):.1f} %" in SENTENCES
    kept, _ = costs(*with_slope(np.tril(SLOPE)))
    assert f"predicted cost changes by {100 * (kept - 1):.1f} %" in SENTENCES


def test_it_stabilises_and_is_not_best(printed):
    fall = np.log(np.abs(np.linalg.eigvals(A)).max()) / H
    assert f"by a factor of $e$ in {1 / fall:.2f} s" in SENTENCES
    none, tenth = with_slope(0 * SLOPE), lab.promise(A, B, H, 10 * lab.R_COST)
    kept, least = costs(*none)
    low = 100 * (1 - 1 / kept)
    assert f"without the gravity stiffness is {low:.0f} % too low" in SENTENCES
    kept, dear = costs(*tenth)
    assert least < costs(P, K / 2)[1] < dear
    words = f"{100 * (least - 1):.0f} to {100 * (dear - 1):.0f} % more"
    assert f"The wrong gains cost {words}" in SENTENCES
    assert 0.45 < kept < 0.5
    assert "is more than twice the measured cost" in SENTENCES
    for text in (f"{kept:.3f}", f"{dear:.3f}"):
        assert text in printed


@pytest.mark.kit
def test_two_wrong_steps_of_riccati_keep_the_promise_since_p_no_longer_changes():
    row = row_of(DAY, "riccati_step")
    new = next(way.code for way in row.named if way.slug == "K-of-the-new-P")

    def diagonal(P, A, B, Q, R):
        return optimal.riccati_step(P, A, B, Q, np.diag(np.diag(R)))

    for wrong in (new, diagonal):
        with patch.object(lab, "riccati_step", wrong):
            assert abs(costs(*lab.promise(A, B, H))[0] - 1) < 1e-5
            rng = np.random.default_rng(lab.SEED)
            assert max(lab.off_one_riccati(rng)) > 1e-3
    R = H * lab.R_COST * (np.eye(7) + 0.5)  # no longer diagonal: now the second shows
    Q = H * np.diag(lab.Q_COST)
    off = [f(P, A, B, Q, R)[1] for f in (diagonal, lab.riccati_step)]
    assert np.abs(off[0] - off[1]).max() > 1


@pytest.mark.kit
def test_the_gain_is_good_long_before_the_promise_is():
    found = []
    for steps in (50, 100, 200, 500):
        with patch.object(lab, "STEPS", steps):
            found.append(costs(*lab.promise(A, B, H)))
    kept, dear = np.array(found).T
    said = f"{kept[0]:.0f}, {kept[1]:.2f}, {kept[2]:.3f} and {kept[3]:.4f}"
    assert f"measured to predicted cost is {said}" in SENTENCES
    said = f"{dear[0]:.1f}, {dear[1]:.2f}, {dear[2]:.4f} and {dear[3]:.4f}"
    assert f"same gains is {said} times the cost" in SENTENCES
    # What a gain that is a little wrong costs is of second order.
    off = [costs(P, (1 + size) * K)[1] - 1 for size in (0.05, 0.1)]
    assert off[1] / off[0] == pytest.approx(4, rel=0.1)


def test_whole_steps_that_are_clipped_go_in_circles():
    row = row_of(DAY, "box_qp")
    whole = next(way.code for way in row.named if way.slug == "whole-steps")
    G = np.array([[23.0, 15, 21], [15, 14, 13], [21, 13, 23]])
    given = (G, np.array([9.0, -2, 6]), -np.ones(3), np.ones(3))
    x = np.array([0.0, 0, -1])
    end = whole(*given, x)
    assert np.allclose(whole(*given, end), end) or np.allclose(
        whole(*given, whole(*given, end)), end
    )
    residual = lab.kkt_residual(*given, end)
    best = lab.box_qp(*given, x)
    assert residual > 0.1
    assert f"{np.abs(end - best).max():.3f} from the minimiser" in SENTENCES


@pytest.mark.kit
def test_ten_times_are_enough_for_seven_numbers():
    rng = np.random.default_rng(lab.SEED)
    asked, first_limit = [], lab.first_limit

    def counted(*given):
        asked[-1] += 1
        return first_limit(*given)

    with patch.object(lab, "first_limit", counted):
        for q in lab.random_q(MODEL, 50, lab.SEED):
            J = ARM.at(q).J_site
            limit = rng.uniform(0.05, 0.5, 7)
            asked.append(0)
            lab.qp_ik(J, rng.normal(size=6), np.ones(6), 0.02, -limit, limit)
    assert 5 < np.mean(asked) < max(asked) < 20


NEVER = "leaves.max() < 1e-12", "False"  # releases an entry for ever


def test_an_active_set_loop_that_does_not_end_shows_its_last_sets(tmp_path):
    text = DAY.source.read_text("utf-8").replace("range(100)", "iter(int, 1)")
    path = tmp_path / DAY.script
    path.write_text(text.replace(*NEVER), "utf-8")
    given = np.array([[2.0, 1], [1, 2]]), np.array([-2.0, -10]), -np.ones(2), np.ones(2)
    mine = load_script(path)
    for _ in range(2):  # each call counts its own passes
        with pytest.raises(RuntimeError, match=r"after 1,000 passes .* \{1\}, \{1\}"):
            mine.box_qp(*given, np.zeros(2))
    boxes = [lab.box_qp(*given, np.zeros(2)) for _ in range(1_100)]
    np.testing.assert_allclose(boxes[-1], [0.5, 1.0])


def test_the_circle_clipped_slowed_and_best(printed):
    for row in ("clamped +57.35", "qp_ik +12.92", "0.1 +11.69", "0.01 +6.18"):
        assert re.search(row, printed)
    assert "clamping gives an error of 57 mm where 13 mm is possible" in SENTENCES
    assert "11.69 and 6.18 mm" in SENTENCES
    a = 0.1148
    far = 13.0916
    paper = [far / (1 + a**2 / w) for w in (1, 0.1, 0.01)]
    assert f"{paper[0]:.2f} mm for w = 1" in SENTENCES
    assert f"gives {paper[1]:.2f} and {paper[2]:.2f} mm" in SENTENCES


def test_on_paper_the_worst_point_is_past_the_top_and_a_tilt_brings_the_wrist_nearer():
    reach = np.hypot(0.316, 0.0825) + np.hypot(0.384, 0.0825)
    turn = np.radians(np.linspace(80, 110, 3001))
    x, y, z = day13_mujoco.CENTRE
    side = np.hypot(x, y + lab.RADIUS * np.cos(turn)) - 0.088
    up = z + lab.RADIUS * np.sin(turn) + 0.107 - 0.333
    far = np.hypot(side, up)
    at = np.argmax(far)
    assert f"{np.degrees(turn[at]) - 90:.1f} degrees past the top" in SENTENCES
    assert (
        f"{far[at]:.6f} m from the shoulder, but the arm can reach only {reach:.6f} m"
        in (SENTENCES)
    )
    assert f"too short by {1000 * (far[at] - reach):.2f} mm" in SENTENCES
    # The wrist is (-0.088, 0.107) from the tool; its way to the shoulder is (side, up).
    a = (0.088 * up[at] + 0.107 * side[at]) / far[at]
    assert f"wrist ${a:.3f} t$ metres nearer" in SENTENCES


@pytest.mark.kit
def test_the_exercises_numbers_and_what_is_left_is_the_step():
    def off(turn, dt=lab.DT, lap=day13_mujoco.LAP):
        with patch.object(lab, "DT", dt), patch.object(day13_mujoco, "LAP", lap):
            return lab.draw_circle(MODEL, lab.best_step(turn))[0].max()

    assert f"A lap in 12 s gives {off(1.0, lap=12.0):.2f} mm" in SENTENCES
    short = f"{off(0.1, 0.01):.2f} and {off(0.01, 0.01):.2f}"
    assert f"With steps of 10 ms the error is {short} mm" in SENTENCES
    paper = 13.0916 / (1 + 0.1148**2 / 0.01)
    assert abs(off(0.01, 0.01) - paper) < 0.2 * abs(off(0.01) - paper)


@pytest.mark.kit
def test_with_the_damping_of_day_3_no_limit_is_active():
    with patch.object(lab, "DAMPING", 0.05):
        ways = (lambda *x: clipped(*x, 0.05), lab.best_step())
        both = [lab.draw_circle(MODEL, step)[0].max() for step in ways]
    assert all(f"both methods give {one:.1f} mm" in SENTENCES for one in both)


@pytest.mark.kit
def test_limits_twice_as_wide_are_worse_and_the_jacobian_of_the_step_is_not_the_cause():
    def off(limit, dt):
        with patch.object(lab, "SPEED", limit * lab.SPEED), patch.object(lab, "DT", dt):
            return lab.draw_circle(MODEL, lab.best_step())[0].max()

    wide = off(2, 0.02)
    assert wide > off(1, 0.02) + 0.5
    assert recomputed(2.0) > wide


def recomputed(limit):
    """Return the circle's error with each step repeated, with J at its end."""
    low, high = MODEL.jnt_range.T
    times = np.arange(0.0, day13_mujoco.LAP, lab.DT)
    path, q = day13_mujoco.circle(MODEL, lab.RADIUS, times)
    off = []
    for T_now, T_next in pairwise(path):
        now = ARM.at(q)
        T = now.T_world_ee
        e = pose_error(T_now, T_next) + lab.DT * lab.GAIN * pose_error(T, T_now)
        off.append(1000 * np.linalg.norm(T_now[:3, 3] - T[:3, 3]))
        reach = limit * lab.SPEED * lab.DT
        lo, hi = np.maximum(-reach, low - q), np.minimum(reach, high - q)
        dq = lab.qp_ik(now.J_site, e, np.ones(6), lab.DAMPING, lo, hi)
        there = ARM.at(q + dq)
        J = there.J_site
        left = e - pose_error(T, there.T_world_ee)
        G = J.T @ J + lab.DAMPING**2 * np.eye(7)
        linear = -J.T @ left + lab.DAMPING**2 * dq
        q = q + dq + lab.box_qp(G, linear, lo - dq, hi - dq, np.zeros(7))
    return max(off)


@pytest.mark.kit
@pytest.mark.parametrize("damping", [0.005, 0.01, 0.015, 0.05])
def test_clamping_is_as_good_as_the_damping_that_was_guessed(damping):
    met = []

    def clamped_step(J, e, lo, hi):
        step = dls_step(J, e, damping)
        met.append(bool(np.any((step < lo - 1e-12) | (step > hi + 1e-12))))
        return np.clip(step, lo, hi)

    with patch.object(lab, "DAMPING", damping):
        clamped = lab.draw_circle(MODEL, clamped_step)[0].max()
        steps = sum(met)
        best = lab.draw_circle(MODEL, lab.best_step())[0].max()
    assert f"| {damping:g} | {clamped:.1f} | {best:.2f} | {steps} |" in SENTENCES
    assert best < 13.0 or damping > 0.015


@pytest.mark.kit
def test_the_elbow_pays_for_the_limits():
    sums, steps = np.zeros(7), np.zeros((7, 2), int)

    def priced(J, e, lo, hi):
        dq = lab.best_step()(J, e, lo, hi)
        cost = J.T @ J + lab.DAMPING**2 * np.eye(7)
        prices = lab.bound_multipliers(cost, -J.T @ e, lo, hi, dq)
        nonlocal sums
        sums = sums + np.abs(prices)
        for j in np.flatnonzero(prices):
            fast = abs(abs(dq[j]) - lab.SPEED[j] * lab.DT) < 1e-12
            steps[j, 0 if fast else 1] += 1
        return dq

    off, _, _ = lab.draw_circle(MODEL, priced)
    assert f"{steps[3, 0]} of the lap's {len(off)} steps" in SENTENCES
    assert f"its range in {steps[3, 1]}" in SENTENCES
    assert sums[0] < 0.005 * sums.sum()
    assert steps.sum() == steps[3].sum() + steps[0, 0]


# --- iLQR ---


def no_lu(right):
    """Return a backward pass without lu."""
    return lambda fx, fu, lx, lu, *more: right(fx, fu, lx, 0 * lu, *more)


def no_lx(right):
    """Return one without lx."""
    return lambda fx, fu, lx, *more: right(fx, fu, 0 * lx, *more)


def speeds_turned(right):
    """Return one whose Vx has the wrong sign in its speeds."""

    def own(*given):
        *parts, Vx, Vxx, mu = given
        return right(*parts, Vx * np.repeat([1, -1], 7), Vxx, mu)

    return own


def first_slopes(right):
    """Return one with the first step's slopes for all."""
    return lambda fx, fu, *more: right(0 * fx + fx[0], 0 * fu + fu[0], *more)


def free_body(right):
    """Return one whose A knows neither gravity nor damping."""
    plain = np.eye(14) + 0.01 * np.eye(14, k=7)
    return lambda fx, *more: right(0 * fx + plain, *more)


MISTAKES = {
    "none": lambda right: right,
    "$l_u$ omitted": no_lu,
    "velocities in $V_x$ negated": speeds_turned,
    "derivatives of the first step used for all": first_slopes,
    "$l_x$ omitted": no_lx,
    "A without gravity and damping": free_body,
}


def reached(mistake):
    """Return the rounds of a reach with a mistake, and how far off the goal it ends."""
    ends = []
    task = day13_mujoco.Reach

    def cost(self, x, u, right=task.cost):
        ends.append(1000 * np.linalg.norm((x[-1] - self.goal)[:7]))
        return right(self, x, u)

    wrong = mistake(lab.ilqr_backward)
    with patch.object(lab, "ilqr_backward", wrong), patch.object(task, "cost", cost):
        return lab.reach(MODEL), ends[-1]


@pytest.mark.kit
@pytest.mark.parametrize("name", MISTAKES)
def test_the_table_of_mistakes_whose_cost_fell(name):
    rounds, off = reached(MISTAKES[name])
    cost, fell = rounds[-1][0], 1 - rounds[-1][0] / rounds[0][0]
    ratios = " | ".join(f"{one[2]:.2f}" for one in rounds[1:3])
    row = f"| {name} | {cost:.3f} | {100 * fell:.1f} % | {off:.1f} | {ratios} |"
    assert row in SENTENCES


@pytest.mark.kit
def test_forgetting_lu_ends_nearer_and_dearer_and_the_first_round_cannot_show_it():
    right, near = reached(MISTAKES["none"])
    wrong, nearer = reached(MISTAKES["$l_u$ omitted"])
    assert nearer < 0.6 * near
    dearer = 100 * (wrong[-1][0] / right[-1][0] - 1)
    assert f"costs {dearer:.0f} % more: the distance to the goal is only one part" in (
        SENTENCES
    )
    assert wrong[1] == right[1]
    task = day13_mujoco.Reach(MODEL, lab.READY_Q, lab.READY_Q + lab.TO)
    zero = np.zeros((lab.MOTION, 7))
    parts = task.expanded(np.zeros((lab.MOTION + 1, 14)), zero)
    assert not np.any(parts[2])  # lx
    assert not np.any(parts[3])  # lu
    assert f"a configuration {np.linalg.norm(lab.TO):.1f} rad away" in SENTENCES


@pytest.mark.kit
def test_without_its_gain_the_arm_leaves_the_path():
    def no_gain(*given, right=lab.ilqr_backward):
        k, K, drop = right(*given)
        return k, 0 * K, drop

    with patch.object(lab, "ilqr_backward", no_gain):
        found = lab.reach(MODEL)
    assert "the cost falls to only about 720" in SENTENCES
    assert found[1][0] == pytest.approx(720, abs=2)


# --- what an outsider's runs refuted ---


def one_step_with(mistake):
    """Return a Riccati step with a mistake that the robot does not show."""

    def step(P, A, B, Q, R):
        K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
        if mistake == "no BPB":
            K = np.linalg.solve(R, B.T @ P @ A)
            return Q + A.T @ P @ (A - B @ K), K
        if mistake == "no effort":
            return Q + (A - B @ K).T @ P @ (A - B @ K), K
        return Q + A.T @ P @ A - A.T @ P @ B @ K / 2, K

    return step


@pytest.mark.kit
@pytest.mark.parametrize(
    ("mistake", "row"),
    [
        ("no BPB", "| $B^T P B$ omitted from $K$ | {:.4f} |"),
        ("no effort", "(A - B K)^T P (A - B K)$ | {:.2f} |"),
        ("half", "A^T P B K$ | {:.2f} |"),
    ],
)
def test_three_wrong_riccati_steps_hold_the_arm_and_miss_their_predicted_cost(
    mistake, row
):
    with patch.object(lab, "riccati_step", one_step_with(mistake)):
        wrong = lab.promise(A, B, H)
    ratio, _ = costs(*wrong)
    assert row.format(ratio) in SENTENCES
    assert np.abs(np.linalg.eigvals(A - B @ wrong[1])).max() < 1


def test_a_gain_of_the_wrong_sign_is_seen_at_once():
    data = day13_mujoco.at(MODEL, lab.READY_Q, X)
    hold = data.ctrl.copy()
    steps = 0
    while np.abs(data.qpos - lab.READY_Q).max() <= 0.2 and steps < 200:
        steps += 1
        now = np.append(data.qpos - lab.READY_Q, data.qvel)
        data.ctrl[:] = hold + K @ now
        mujoco.mj_step(MODEL, data)
    assert steps * H == pytest.approx(0.12, abs=0.005)
    assert "by 0.2 rad within 0.12 s" in SENTENCES


@pytest.mark.kit
def test_the_mean_of_two_starts_is_near_the_prediction_in_other_directions_too():
    rng = np.random.default_rng(0)
    off = []
    for _ in range(5):
        one = rng.normal(size=7)
        x = lab.JUDGED * np.sqrt(2) * np.append(one / np.linalg.norm(one), np.zeros(7))
        both = [lab.paid(MODEL, K, side * x) for side in (1, -1)]
        off.append(abs(np.mean(both) / optimal.cost_to_go(P, x) - 1))
    assert 1e-7 < min(off) < max(off) < 1e-5


def test_the_residual_is_not_the_distance():
    wide = -5 * np.ones(1), 5 * np.ones(1)
    for curvature, x, residual in ((1000.0, 0.001, 1.0), (0.001, 1.0, 0.001)):
        given = np.array([[curvature]]), np.zeros(1), *wide, np.array([x])
        assert lab.kkt_residual(*given) == pytest.approx(residual)


def test_regularisation_raises_the_ratio_of_a_correct_pass_on_a_quadratic_problem():
    for mu, said in ((0.0, 1.0), (0.5, 1.066), (5.0, 1.278)):
        parts = lab.motion(6, 3, 2, np.random.default_rng(3))
        k, gain, drop = lab.ilqr_backward(*parts, mu)
        x, inputs = np.zeros(3), []
        for fx, fu, more, one in zip(*parts[:2], k, gain, strict=True):
            inputs.append(more + one @ x)
            x = fx @ x + fu @ inputs[-1]
        cost = lab.total(parts, np.array(inputs), np.zeros(3))
        ratio = lab.reduction_ratio(0.0, cost, lab.expected_reduction(drop, 1.0))
        assert ratio == pytest.approx(said, abs=6e-4)


@pytest.mark.kit
def test_the_mass_hardly_matters_to_the_stiffness_of_seven_joints():
    now = ARM.at(lab.READY_Q)
    found = []
    for factor in (1.0, 10.0):
        step = lab.linearise(factor * now.M, SLOPE, ARM.damping, 1e-4)
        with patch.object(lab, "STEPS", 30_000):
            found.append(lab.promise(*step, 1e-4)[1][1, 1])
    assert 0.01 < abs(found[1] - found[0]) < 0.1


@pytest.mark.kit
def test_the_table_of_wrong_formulas_shows_the_numbers_of_the_opening(run):
    printed = run("w2-autonomy/day13/wrong_stiffness.py").stdout.splitlines()
    stays = [line for line in printed if " stays " in line]
    assert len(stays) > 30
    assert sum(" falls " in line for line in printed) == 1
    assert all(len(line) <= 80 for line in printed)
