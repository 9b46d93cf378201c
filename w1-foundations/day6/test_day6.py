"""Day 6's lab: its functions, the numbers in the guide's sentences, the errata."""

from unittest.mock import patch

import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script
from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from robo47 import jacobian, panda, simulate, verify

DAY = find_day(6)
GUIDE = (ROOT / "w1-foundations/docs/day6-lab.md").read_text("utf-8")
SENTENCES = " ".join(GUIDE.split())
ERRATA = (ROOT / "w1-foundations/docs/errata.md").read_text("utf-8")
lab = load_script(ROOT / "w1-foundations/src/day6_task_space.py")
inv, pinv = np.linalg.inv, np.linalg.pinv


@pytest.fixture(scope="module")
def motors():
    model = panda.load("panda_nohand", drive="torque")
    return model, panda.arm(model)


def test_a_push_at_rest_is_lambda_times_the_hands_acceleration(motors):
    model, arm = motors
    q = verify.random_q(model, 60, seed=6)
    for one in q:
        now = arm.at(one)
        if np.linalg.svd(now.J_site, compute_uv=False)[-1] < 0.05:
            continue
        F = np.random.default_rng(6).uniform(-10, 10, 6)
        data = lab.pushed(model, one, 0.0, now.gravity_torque, F)
        acc = lab.hand_acceleration(model, data)
        Lambda = lab.task_inertia(now.J_site, now.M)
        assert_same(Lambda @ acc, F, 1e-10 * np.linalg.norm(F))  # measured 1.3e-13


def test_the_inertias_of_mistakes_at_ready(motors):
    now = motors[1].at(lab.READY_Q)
    J = now.J_site
    M = now.M
    right = lab.task_inertia(now.J_site, now.M)
    off = lambda L: np.linalg.norm(L - right) / np.linalg.norm(right)  # noqa: E731
    assert off(inv(right)) == pytest.approx(1.50, abs=0.005)
    assert off(J @ M @ J.T) == pytest.approx(1.04, abs=0.005)
    assert off(lab.task_inertia(J, M - 0.1 * np.eye(7))) == pytest.approx(
        0.17, abs=5e-3
    )
    assert off(lab.task_inertia(now.J_space, M)) == pytest.approx(0.81, abs=0.005)
    assert off(pinv(J).T @ M @ pinv(J)) == pytest.approx(0.0067, abs=1e-4)
    mass = panda.load("panda_nohand").body_mass.sum()
    moving = motors[1].masses.sum()
    assert f"{mass:.1f} kg, of which {moving:.1f} kg move" in SENTENCES
    light = np.diag(lab.task_inertia(J, M - 0.1 * np.eye(7)))[3:]
    said = "Without it they would be {:.1f}, {:.1f} and {:.1f} kg".format(*light)
    assert said in SENTENCES
    free = inv(right)[:, 3]  # how a hand that nobody holds accelerates for 1 N
    assert free[5] / free[3] == pytest.approx(1 / 3, abs=0.02)
    assert "it also rotates and moves along z, a third as far as along x" in SENTENCES
    rotors = 1.0 - light / np.diag(right)[3:]  # "an eighth to a quarter"
    assert_same([rotors.min(), rotors.max()], [1 / 8, 1 / 4], 6e-3)


# --- the damping, and what Lambda makes large ---


def test_every_mode_of_the_damping_has_ratio_1_and_of_a_diagonal_one_not(motors):
    now = motors[1].at(lab.READY_Q)
    Lambda = lab.task_inertia(now.J_site, now.M)
    right = lab.critical_damping(lab.K, Lambda)
    assert least_ratio(right, Lambda) == pytest.approx(1.0)
    each = diagonal_damping(lab.K, Lambda)
    assert f"worst mode is then {least_ratio(each, Lambda):.2f}" in SENTENCES


def least_ratio(D, Lambda):
    """Return the smallest damping ratio of the hand's modes."""
    below = -np.linalg.solve(Lambda, np.hstack([np.diag(lab.K), D]))
    above = np.hstack([np.zeros((6, 6)), np.eye(6)])
    s = np.linalg.eigvals(np.vstack([above, below]))
    return (-s.real / np.abs(s)).min()


def diagonal_damping(K, Lambda):
    return np.diag(2.0 * np.sqrt(K * np.diag(Lambda)))


def overshoot(motors, e, size=0.03, times=1.0, D=lab.critical_damping):
    """Return by how much of its way a hand that was released along e overshoots, %."""
    with patch.object(lab, "critical_damping", D):
        law = lab.soft_hand(motors[1], lab.READY_Q, stiffness=times * lab.K)
        return -100 * lab.day6_mujoco.released(motors[0], law, e, size).min()


MIXED = np.array([0.17, -0.77, 0.35, 0.39, 0.25, 0.2])


@pytest.mark.kit
def test_modes_that_do_not_swing_overshoot_along_a_mixed_direction(motors):
    words = str(tuple(MIXED.tolist()))
    assert f"e = {words}" in SENTENCES
    assert (
        f"by {overshoot(motors, MIXED):.1f} percent of the initial error" in SENTENCES
    )
    assert overshoot(motors, MIXED, D=diagonal_damping) < 0.05
    for axis in np.eye(6)[3:]:
        for D in (lab.critical_damping, diagonal_damping):
            assert overshoot(motors, axis, D=D) < 0.05


@pytest.mark.kit
@pytest.mark.parametrize(
    "turned", [{"times": 2.0}, {"size": 0.01}, {"times": 0.5}], ids=str
)
def test_neither_stiffness_nor_size_makes_the_overshoot(motors, turned):
    assert 7.55 < overshoot(motors, MIXED, **turned) < 7.95


def test_the_springs_torque_does_not_shrink_where_lambda_grows(motors):
    largest = []
    torque = []
    along = []
    for share in (1.0, 0.1, 0.01, 0.001):
        now = motors[1].at(share * lab.READY_Q)
        u, _, _ = np.linalg.svd(now.J_site)
        largest.append(np.abs(now.J_site).max())
        torque.append(np.abs(now.J_site.T @ (0.1 * lab.K)).max())
        along.append(np.linalg.norm(u[:, 5] @ now.J_site))
    assert_same(largest, np.ones(4), 5e-3)
    assert min(torque[1:]) > torque[0]
    assert f"is small: {along[-1]:.4f} instead of {along[0]:.3f}" in SENTENCES


def test_near_a_singularity_lambda_and_d_grow_and_the_springs_torque_does_not(motors):
    def terms(share):
        now = motors[1].at(share * lab.READY_Q)
        J = now.J_site
        Lambda = lab.task_inertia(now.J_site, now.M)
        D = lab.critical_damping(lab.K, Lambda)
        idle = lab.nullspace_torque(J, now.M, Lambda, np.ones(7))
        spring = J.T @ lab.impedance_wrench(
            np.full(6, 0.1), np.zeros(6), np.diag(lab.K), D
        )
        return [np.abs(x).max() for x in (Lambda, D, idle, spring)]

    ready, stretched = terms(1.0), terms(1e-3)
    assert f"{stretched[0]:,.0f} instead of {ready[0]:.1f}" in SENTENCES
    assert f"entry of D is {stretched[1]:,.0f} instead of {ready[1]:.0f}" in SENTENCES
    assert max(stretched[2] / ready[2], stretched[3] / ready[3]) < 2.0
    assert f"the largest entry of $\\Lambda$ is {terms(0.2)[0]:,.0f}" in SENTENCES
    assert "q = 0 itself is a singularity" in SENTENCES
    assert "another singularity at 0.198 of the ready configuration" in SENTENCES
    for share, least in ((0.0, 1e-12), (0.198218344, 1e-8)):
        J = motors[1].at(share * lab.READY_Q).J_site
        assert np.linalg.svd(J, compute_uv=False)[-1] < least


def circled(motors, seconds=2.5, **instead):
    """Return how far the hand is from the circle, mm and mrad, with other functions."""
    model, arm = motors
    with patch.dict(vars(lab), instead):
        law = lab.circling(arm, lab.nullspace_torque)
        run = simulate.run(model, simulate.start(model, lab.READY_Q), law, seconds)
    T = arm.at(lab.READY_Q).T_world_ee
    goal = [lab.day6_mujoco.circle(t, T, 0.12, 2.0).T for t in run.t]
    off = [
        jacobian.pose_error(arm.at(q).T_world_ee, to)
        for q, to in zip(run.q, goal, strict=True)
    ]
    off = np.reshape(off, (-1, 2, 3))
    return tuple(1000 * np.linalg.norm(off, axis=2).max(axis=0))[::-1]


MISTAKES = {
    "nothing wrong": {},
    "`bias_acceleration` omitted": {"osc_torque": "site-bias-forgotten"},
    "`bias_acceleration` added": {"osc_torque": "site-bias-added"},
    "`bias` omitted": {"osc_torque": "bias-forgotten"},
    "Lambda omitted": {"osc_torque": "Lambda-left-out"},
    "posture torque not projected": {"nullspace_torque": "not-projected"},
    "projected with the formula of the public course": {
        "nullspace_torque": "M-for-identity"
    },
    "projected with I - J^+ J": {"nullspace_torque": "kinematic-projector"},
    "projector transposed": {"nullspace_torque": "projector-transposed"},
}


SLIPS = {  # that the checker names without an entry
    "site-bias-forgotten": lambda J, L, bias, bias_acc, acc: J.T @ L @ acc + bias,
    "site-bias-added": lambda J, L, bias, bias_acc, acc: (
        J.T @ L @ (acc + bias_acc) + bias
    ),
    "bias-forgotten": lambda J, L, bias, bias_acc, acc: J.T @ L @ (acc - bias_acc),
    "Lambda-left-out": lambda J, L, bias, bias_acc, acc: J.T @ (acc - bias_acc) + bias,
}


def mistaken(function, slug):
    """Return a function with a mistake in it, mostly as the catalogue has it."""
    return SLIPS.get(slug) or next(
        way.code for way in row_of(DAY, function).named if way.slug == slug
    )


ROWS = {
    row.split(" | ")[0].removeprefix("| "): row.rstrip(" |").split(" | ")[1:]
    for row in GUIDE.splitlines()
    if row.count(" | ") == 2 and row.rstrip(" |")[-1].isdigit()
}


def test_the_guides_table_of_mistakes_has_these_rows():
    assert ROWS.keys() == MISTAKES.keys()


@pytest.mark.kit
@pytest.mark.parametrize("name", MISTAKES)
def test_each_mistake_costs_on_the_circle_what_the_guide_says(motors, name):
    instead = {law: mistaken(law, slug) for law, slug in MISTAKES[name].items()}
    mm, mrad = circled(motors, **instead)
    for value, written in zip((mm, mrad), ROWS[name], strict=True):
        decimals = len(written.partition(".")[2])
        assert f"{value:.{decimals}f}" == written


@pytest.mark.kit
def test_a_kinematic_projector_draws_the_circle_but_its_torque_is_felt(motors):
    model, arm = motors
    mm, _ = circled(motors, nullspace_torque=lab.kinematic)
    assert mm == pytest.approx(0.152, abs=0.002)
    assert "error of 0.152 mm. The correct projector gives 0.130 mm" in SENTENCES
    rng = np.random.default_rng(6)
    felt = []
    for q in verify.random_q(model, 100, seed=6):
        now = arm.at(q)
        torque = rng.uniform(-10, 10, 7)
        if np.linalg.svd(now.J_site, compute_uv=False)[-1] > 0.05:
            odd = lab.kinematic(now.J_site, now.M, None, torque)
            felt.append(np.abs(now.J_site @ np.linalg.solve(now.M, odd)).max())
    assert 5.0 < np.median(felt) < 9.0  # rad/s2 or m/s2, for torques up to 10 N m


def test_the_public_pages_null_space_term_reaches_the_hand(motors):
    now = motors[1].at(lab.READY_Q)
    J, M = now.J_site, now.M
    Lambda = lab.task_inertia(J, M)
    tau = np.arange(7.0)
    public = mistaken("nullspace_torque", "M-for-identity")
    ours = J @ np.linalg.solve(M, lab.nullspace_torque(J, M, Lambda, tau))
    theirs = J @ np.linalg.solve(M, public(J, M, Lambda, tau))
    assert_same(ours, np.zeros(6), 1e-12)
    # J M^-1 (M - J^T Lambda J M^-1) tau = J tau - J M^-1 tau, which is not 0.
    assert_same(theirs, J @ tau - J @ np.linalg.solve(M, tau), 1e-10)
    assert np.abs(theirs).max() > 1.0
    row = next(r for r in ERRATA.splitlines() if r"\tau_0" in r)
    for words in ("20.1 mm and 170 mrad", "0.13 mm and 0.2 mrad"):
        assert words in row  # the numbers are those of the guide's table
    assert ROWS["projected with the formula of the public course"] == ["20.1", "170"]


def at_rest(motors, push=None, seconds=3.0):
    model, arm = motors
    law = lab.soft_hand(arm, lab.READY_Q)
    start = simulate.start(model, lab.READY_Q)
    run = simulate.run(model, start, law, seconds, rate=250.0, push=push)
    T0, T = (arm.at(q).T_world_ee for q in (lab.READY_Q, run.q[-1]))
    return jacobian.pose_error(T0, T), start


@pytest.mark.kit
@pytest.mark.parametrize(
    ("omega", "mm", "wrong"),
    [(5.0, 0.351, 2.09), (10.0, 0.225, 1.47), (40.0, 0.068, 1.07)],
)
def test_a_softer_feedback_is_further_off_the_circle(motors, omega, mm, wrong):
    right = circled(motors, OMEGA=omega)[0]
    assert right == pytest.approx(mm, abs=2e-3)
    theirs = circled(motors, OMEGA=omega, nullspace_torque=lab.kinematic)[0]
    assert theirs / right == pytest.approx(wrong, rel=0.02)
    if omega == 5.0:
        said = f"{theirs:.2f} mm with the wrong projector and {right:.2f} mm with"
        assert said in SENTENCES


@pytest.mark.kit
def test_at_omega_1_the_wrong_projector_is_the_better_one(motors):
    right, wrong = (
        circled(motors, OMEGA=1.0, nullspace_torque=project)[0]
        for project in (lab.nullspace_torque, lab.kinematic)
    )
    assert f"even better, with {wrong:.2f} mm instead of {right:.2f} mm" in SENTENCES


def watched(motors, project, times=1.0):
    """Return the circle's hand positions, and the largest torques and acceleration."""
    model, arm = motors
    seen = []

    def projected(J, M, Lambda, tau):
        left = project(J, M, Lambda, tau)
        hand = J @ np.linalg.solve(M, left)
        seen.append([np.abs(part).max() for part in (tau, left, hand[3:])])
        return left

    with patch.object(lab, "ELBOW", tuple(times * np.array(lab.ELBOW))):
        law = lab.circling(arm, projected)
        run = simulate.run(model, simulate.start(model, lab.READY_Q), law, 2.5)
    p = np.array([arm.at(q).T_world_ee[:3, 3] for q in run.q])
    return p, np.max(seen, axis=0)


@pytest.mark.kit
def test_hardly_any_posture_torque_is_left_to_project_and_omega_divides_it(motors):
    p, (tau, left, _) = watched(motors, lab.nullspace_torque)
    wrong, (_, theirs, acc) = watched(motors, lab.kinematic)
    assert left == pytest.approx(theirs, abs=0.005)
    assert f"{left:.2f} N m of the controller's {tau:.1f} N m remain." in SENTENCES
    assert f"accelerates the hand by {acc:.3f} m/s²" in SENTENCES
    apart = np.linalg.norm(p - wrong, axis=1).max()
    assert f"differ by {1e3 * apart:.3f} mm" in SENTENCES
    assert apart == pytest.approx(acc / lab.OMEGA**2, rel=0.1)
    _, (tau, left, _) = watched(motors, lab.kinematic, 8.0)
    assert tau > 100.0
    assert left < 0.15
    gains = {"ELBOW": (80.0, 32.0), "nullspace_torque": lab.kinematic}
    assert f"almost the same, {circled(motors, **gains)[0]:.3f} mm" in SENTENCES


def soft_circle(arm):
    """Return the impedance controller whose target moves on the circle."""
    T = arm.at(lab.READY_Q).T_world_ee

    def law(t, q, qd):
        now = arm.at(q)
        to = lab.day6_mujoco.circle(t, T, lab.RADIUS, lab.TURN)
        J, M = now.J_site, now.M
        Lambda = lab.task_inertia(J, M)
        D = lab.critical_damping(lab.K, Lambda)
        e = jacobian.pose_error(now.T_world_ee, to.T)
        wrench = lab.impedance_wrench(e, to.V - J @ qd, np.diag(lab.K), D)
        back = 10.0 * (lab.READY_Q - q) - 4.0 * qd
        idle = lab.nullspace_torque(J, M, Lambda, back)
        return lab.impedance_torque(J, wrench, now.bias(qd), arm.damping, qd, idle)

    return law


@pytest.mark.kit
def test_a_soft_hand_does_not_follow_the_circle_precisely(motors):
    model, arm = motors
    off = lab.day6_mujoco.off_circle(model, soft_circle(arm), lab.RADIUS, lab.TURN)
    assert f"has an error of up to {1e3 * off.max():.1f} mm" in SENTENCES


def inner(model, n):
    """Return n random configurations away from limits and singularities."""
    low, high = model.jnt_range.T + np.array([[0.25], [-0.25]])
    arm = panda.arm(model)
    some = [np.clip(q, low, high) for q in verify.random_q(model, 3 * n, seed=4)]
    least = lambda q: np.linalg.svd(arm.at(q).J_site, compute_uv=False)[-1]  # noqa: E731
    return [q for q in some if least(q) > 0.08][:n]


@pytest.mark.kit
def test_a_push_is_predicted_in_other_configurations_as_well(motors):
    model, arm = motors
    for q in inner(model, 4):
        push = simulate.push_at(lab.day6_mujoco.SITE, lab.PUSH)
        law = lab.soft_hand(arm, q)
        start = simulate.start(model, q)
        run = simulate.run(model, start, law, 6.0, rate=lab.RATE, push=push)
        ends = (arm.at(x).T_world_ee for x in (q, run.q[-1]))
        assert_same(jacobian.pose_error(*ends), lab.PUSH / lab.K, 1e-7)
    assert "as long as no joint reaches a limit" in SENTENCES


def test_every_mode_has_ratio_1_in_other_configurations_and_a_diagonal_one_not(motors):
    ratios = []
    for q in inner(motors[0], 8):
        Lambda = lab.task_inertia(motors[1].at(q).J_site, motors[1].at(q).M)
        right = lab.critical_damping(lab.K, Lambda)
        assert least_ratio(right, Lambda) == pytest.approx(1.0, abs=1e-3)
        ratios.append(least_ratio(diagonal_damping(lab.K, Lambda), Lambda))
    assert f"({min(ratios):.2f} to {max(ratios):.2f} in eight" in SENTENCES


@pytest.mark.kit
def test_the_direction_e_was_chosen_for_its_effect(motors):
    some = np.random.default_rng(6).normal(size=(12, 6))[:6] / 2.4
    counts = [sum(overshoot(motors, e, D=D) > 0.1 for e in some)
              for D in (lab.critical_damping, diagonal_damping)]  # fmt: skip
    assert counts == [1, 3]
    assert "with the critical D, and three do with the diagonal D" in SENTENCES


SIGNS = {
    "e": {"impedance_wrench": lambda e, V, K, D: -K @ e + D @ V},
    "V_err": {"impedance_wrench": lambda e, V, K, D: K @ e - D @ V},
    "pinv": {
        "impedance_torque": lambda J, F, b, d, qd, idle: pinv(J) @ F + b + d * qd + idle
    },
}


@pytest.mark.parametrize("named", SIGNS)
def test_a_sign_makes_the_soft_hand_fly_away_and_a_pseudo_inverse_does_not(
    motors, named
):
    model, arm = motors
    with patch.dict(vars(lab), SIGNS[named]):
        law = lab.soft_hand(arm, lab.READY_Q)
        run = simulate.run(model, simulate.start(model, lab.READY_Q + 0.02), law, 1.0)
    away = arm.at(run.q[-1]).T_world_ee - arm.at(lab.READY_Q).T_world_ee
    assert (np.linalg.norm(away[:3, 3]) > 0.3) == (named != "pinv")
    if named == "pinv":
        theirs = lambda J, L, b, drift, acc: pinv(J) @ L @ (acc - drift) + b  # noqa: E731
        # A hundred times what it may be; soon after, the motion is chaotic.
        assert circled(motors, seconds=0.5, osc_torque=theirs)[0] > 100.0
    assert "`V_err` or `acc`; on the circle also $J^+$ instead of $J^T$" in SENTENCES


@pytest.mark.kit
def test_a_position_read_after_a_step_is_one_step_old(motors):
    model, arm = motors
    data = simulate.start(model, lab.READY_Q)
    T = arm.at(lab.READY_Q).T_world_ee
    look = lambda model, data: data.site("attachment_site").xpos.copy()  # noqa: E731
    law = lab.circling(arm, lab.nullspace_torque)
    run = simulate.run(model, data, law, 2.5, watch=look)
    goal = [lab.day6_mujoco.circle(t, T, 0.12, 2.0).T[:3, 3] for t in run.t[1:]]
    now = [arm.at(q).T_world_ee[:3, 3] for q in run.q[1:]]
    off = [1e3 * np.linalg.norm(np.subtract(x, goal), axis=1).max()
           for x in (run.seen, now)]  # fmt: skip
    assert "error is {:.1f} mm instead of {:.1f} mm |".format(*off) in SENTENCES


@pytest.mark.kit
def test_without_bias_the_soft_hand_sinks(motors, monkeypatch):
    right = lab.impedance_torque
    without = lambda J, F, bias, *rest: right(J, F, 0 * bias, *rest)  # noqa: E731
    monkeypatch.setattr(lab, "impedance_torque", without)
    moved, _ = at_rest(motors)
    assert_same(1000 * moved[[3, 5]], [-167, -133], 0.6)
    assert "by 133 mm in three seconds, and it moves 167 mm towards" in SENTENCES


def on_body(name, force, where):
    def push(model, data):
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        body = model.body(name).id
        point = getattr(data, where)[body]
        F = np.array(force)
        none = np.zeros(3)
        mujoco.mj_applyFT(model, data, F, none, point, body, data.qfrc_applied)

    return push


@pytest.mark.kit
def test_a_push_at_the_centre_of_mass_of_a_massless_body_turns_the_hand(motors):
    moved, _ = at_rest(motors, on_body("attachment", [10.0, 0, 0], "xipos"))
    assert 1000 * np.abs(moved[:3]).max() == pytest.approx(35.6, abs=0.06)
    assert_same(moved[3], 0.025, 1e-6)
    assert "35.6 mrad" in GUIDE


@pytest.mark.kit
@pytest.mark.parametrize(
    ("gains", "elbow"), [((10.0, 4.0), 50), ((40.0, 8.0), 14), ((0.0, 0.0), 543)]
)
def test_the_elbow_gives_way_as_the_guide_says(motors, monkeypatch, gains, elbow):
    monkeypatch.setattr(lab, "ELBOW", gains)
    model, _ = motors
    before = simulate.start(model, lab.READY_Q).body("link4").xpos.copy()
    moved, data = at_rest(motors, on_body("link4", [0, 20.0, 0], "xpos"), 1.0)
    mujoco.mj_forward(model, data)
    off = 1000 * np.linalg.norm(data.body("link4").xpos - before)
    assert off == pytest.approx(elbow, abs=0.6)
    if elbow == 50:
        assert 1000 * np.linalg.norm(moved[3:]) == pytest.approx(4.5, abs=0.05)
    assert f"{elbow} mm" in GUIDE.replace("\n", " ")


@pytest.mark.kit
def test_the_guides_code_releases_the_hand(capsys, monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "w1-foundations/src"))
    blocks = GUIDE.split("```python\n")[1:]
    (code,) = (one.split("```")[0] for one in blocks if "released(" in one)
    exec(code, {})
    assert float(capsys.readouterr().out) == pytest.approx(-0.078, abs=1e-3)


def test_joint_2_does_the_work_along_x_and_joints_1_3_5_7_along_y(motors):
    now = motors[1].at(lab.READY_Q)
    Lambda = lab.task_inertia(now.J_site, now.M)
    for axis, joints in ((3, [1]), (4, [0, 2, 4, 6])):
        qdd = np.linalg.solve(now.M, now.J_site.T @ Lambda[:, axis])
        work = qdd * (now.M @ qdd)
        assert work[joints].sum() / work.sum() == pytest.approx(1.0, abs=0.02)
    assert "a motion of the hand along x needs joint2" in SENTENCES
    assert "along y, joints 1, 3, 5 and 7 share the motion" in SENTENCES
