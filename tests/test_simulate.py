"""The loop that runs controllers, and the predictions of Days 5 and 6 come true."""

import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script
from robo47 import (
    control,
    jacobian,
    panda,
    references,
    scenes,
    simulate,
    task_space,
)  # fmt: skip
from robo47.panda import READY_Q

SITE = "attachment_site"
day6_mujoco = load_script(ROOT / "w1-foundations/src/day6_mujoco.py")


@pytest.fixture(scope="module")
def motors():
    """The arm with motors, and its twin in NumPy."""
    model = panda.load("panda_nohand", drive="torque")
    return model, panda.arm(model)


def computed_torque(arm, q_ref, omega, zeta):
    kp, kd = control.pd_gains(omega, zeta)

    def law(t, q, qd):
        now, (goal, speed, acc) = arm.at(q), q_ref(t)
        return control.computed_torque(
            now.M, now.bias(qd), arm.damping, qd, goal - q, speed - qd, acc, kp, kd
        )

    return law


def test_the_log_begins_at_the_measured_state_and_the_data_is_left_at_its_end(motors):
    model, arm = motors
    data = simulate.start(model, READY_Q, 0.1)
    hold = computed_torque(arm, references.hold(READY_Q), 20, 1)
    run = simulate.run(model, data, hold, 0.2, rate=250)
    assert run.t.shape == (51,)
    assert run.q.shape == run.qd.shape == (51, 7)
    assert run.tau.shape == (50, 7)
    assert run.seen == []
    assert_same(run.q[0], READY_Q)
    assert_same(run.qd[0], np.full(7, 0.1))
    assert_same(run.q[-1], data.qpos)
    assert data.time == pytest.approx(0.2)


def test_the_controller_is_called_once_a_period_and_its_torque_held(motors):
    model, _ = motors
    times, seen = [], []

    def law(t, q, qd):
        times.append(t)
        q[:] = qd[:] = np.nan  # its own copies: the simulation does not see this
        return np.arange(7.0)

    data = simulate.start(model, READY_Q)
    watch = lambda model, data: seen.append(data.ctrl.copy())  # noqa: E731
    run = simulate.run(model, data, law, 0.1, rate=100, watch=watch)
    assert_same(times, np.arange(10) / 100)
    assert_same(np.array(seen), np.tile(np.arange(7.0), (10, 1)))
    assert np.isfinite(run.q).all()


def test_two_halves_are_the_whole(motors):
    model, arm = motors
    law = computed_torque(arm, references.hold(READY_Q + 0.1), 10, 1)
    whole, halves = (simulate.start(model, READY_Q) for _ in range(2))
    simulate.run(model, whole, law, 0.2)
    for _ in range(2):
        simulate.run(model, halves, law, 0.1)
    assert_same(whole.qpos, halves.qpos)


def test_the_arm_is_found_by_name_among_a_hand_and_a_cube():
    model = scenes.table_top()
    adr, dof, motor = simulate.addresses(model)
    assert_same(adr, np.arange(7))
    assert_same(dof, np.arange(7))
    assert_same(motor, np.arange(7))
    ranges, torques = simulate.limits(model)
    assert_same(torques, [87, 87, 87, 87, 12, 12, 12])
    assert (np.sign(READY_Q - ranges.T) == [[1], [-1]]).all()


def test_torques_beyond_the_motors_limits_do_nothing_more(motors):
    model, _ = motors
    ends = []
    for factor in (1.0, 5.0):
        data = simulate.start(model, READY_Q)
        _, limits = simulate.limits(model)
        simulate.run(model, data, lambda t, q, qd, k=factor: k * limits, 0.02)  # noqa: B023
        ends.append(data.qpos.copy())
    assert_same(ends[0], ends[1])


def test_sag_is_predicted_by_its_fixed_point(motors):
    model, arm = motors
    kp, q = 100.0, READY_Q
    for _ in range(200):
        q = control.pd_equilibrium_step(READY_Q, arm.at(q).gravity_torque, kp)
    data = simulate.start(model, READY_Q)
    pd = lambda t, q, qd: control.pd_torque(READY_Q - q, -qd, kp, 20.0)  # noqa: E731
    end = simulate.run(model, data, pd, 20.0, rate=100).q[-1]
    assert_same(end, q, 1e-8)
    assert 1e3 * (READY_Q - end)[3] == pytest.approx(190.4, abs=0.05)


@pytest.mark.parametrize(("omega", "zeta"), [(10, 1.0), (10, 0.5), (10, 2.0), (20, 1)])
def test_the_error_decays_as_predicted_in_all_joints_alike(motors, omega, zeta):
    model, arm = motors
    e0 = 0.1 * np.array([1, -1, 1, -1, 1, -1, 1])
    data = simulate.start(model, READY_Q - e0)
    law = computed_torque(arm, references.hold(READY_Q), omega, zeta)
    run = simulate.run(model, data, law, 10.0 / omega, rate=500)
    e = (READY_Q - run.q) / e0
    predicted = control.error_response(run.t, omega, zeta)[:, None]
    assert np.abs(e - predicted).max() < 0.02  # measured .0061 to .0124
    assert np.ptp(e, axis=1).max() < 0.01  # measured .0024 for omega 10


def test_with_the_gains_outside_of_m_it_does_not(motors):
    model, arm = motors
    e0 = 0.1 * np.array([1, -1, 1, -1, 1, -1, 1])
    kp, kd = control.pd_gains(20, 1)

    def augmented(t, q, qd):
        e, ed = READY_Q - q, -qd
        return arm.at(q).bias(qd) + arm.damping * qd + control.pd_torque(e, ed, kp, kd)

    run = simulate.run(
        model, simulate.start(model, READY_Q - e0), augmented, 0.5, rate=500
    )
    predicted = control.error_response(run.t, 20, 1)[:, None]
    assert np.abs((READY_Q - run.q) / e0 - predicted).max() > 0.1  # measured .120


def test_computed_torque_tracks_within_a_milliradian(motors):
    model, arm = motors
    swing = references.raised_cosine(
        READY_Q, np.array([0.5, 0.4, 0.5, 0.4, 0.6, 0.5, 0.6])
    )
    law = computed_torque(arm, swing, 20, 1)
    run = simulate.run(model, simulate.start(model, READY_Q), law, 2.0)
    off = run.q - np.array([swing(t)[0] for t in run.t])
    assert np.abs(off).max() < 1e-3  # measured 0.23e-3
    assert (np.abs(run.tau) / simulate.limits(model)[1]).max() < 0.3  # measured .23


def impedance(arm, target, K, q_rest):
    """A soft hand: a spring K to target(t), critically damped; the elbow held back."""

    def law(t, q, qd):
        now = arm.at(q)
        J = now.J_site
        Lambda = task_space.task_inertia(J, now.M)
        D = task_space.critical_damping(K, Lambda)
        e = jacobian.pose_error(now.T_world_ee, target(t))
        wrench = task_space.impedance_wrench(e, -J @ qd, np.diag(K), D)
        back = control.pd_torque(q_rest - q, -qd, 10.0, 4.0)
        null = task_space.nullspace_torque(J, now.M, Lambda, back)
        return task_space.impedance_torque(
            J, wrench, now.bias(qd), arm.damping, qd, null
        )

    return law


@pytest.mark.parametrize("wrench", [[0, 0, 0, 10, 0, 0], [0, 0, 1, 0, 0, 0]])
def test_a_push_moves_the_soft_hand_by_force_over_stiffness(motors, wrench):
    model, arm = motors
    K = np.array([30.0, 30, 30, 400, 400, 400])
    T = arm.at(READY_Q).T_world_ee
    law = impedance(arm, lambda t: T, K, READY_Q)
    data = simulate.start(model, READY_Q)
    push = simulate.push_at(SITE, wrench)
    end = simulate.run(model, data, law, 4.0, rate=100, push=push).q[-1]
    moved = jacobian.pose_error(T, arm.at(end).T_world_ee)
    assert_same(moved, wrench / K, 1e-6)


@pytest.mark.parametrize("k", [400.0, 1000.0])
def test_a_soft_hand_presses_with_the_force_that_was_asked_for(k):
    deep = task_space.set_point_for_force(0.05 * k, k, scenes.TOUCH)

    def law(arm, q0):
        T = arm.at(q0).T_world_ee

        def target(t):
            goal = T.copy()
            goal[2, 3] = max(deep, T[2, 3] - 0.1 * t)
            return goal

        return impedance(arm, target, np.array([30.0, 30, 30, k, k, k]), q0)

    felt = day6_mujoco.press(law, seconds=3.0, rate=100)
    assert felt[-1] == pytest.approx(0.05 * k, rel=2e-3)


def test_a_push_acts_at_the_site_where_it_is_now(motors):
    model, arm = motors
    data = simulate.start(model, READY_Q)
    # Gravity is held; one step under a push gives the velocity M^-1 J^T F predicts.
    wrench = np.array([0.5, -0.2, 0.3, 4.0, -2.0, 3.0])
    data.qpos[:] = READY_Q + 0.2  # site_xpos is that of the old place
    now = arm.at(data.qpos)
    push = simulate.push_at(SITE, wrench)
    simulate.run(model, data, lambda *_: now.gravity_torque, 0.002, rate=500, push=push)
    h = model.opt.timestep
    M = now.M + h * np.diag(arm.damping)  # implicitfast
    assert_same(data.qvel, h * np.linalg.solve(M, now.J_site.T @ wrench), 1e-12)
    assert_same(data.qfrc_applied, np.zeros(7))


@pytest.mark.parametrize("rate", [300.0, 1000.0, 0.0, -100.0])
def test_a_rate_that_is_no_whole_number_of_steps_is_refused(motors, rate):
    model, _ = motors
    with pytest.raises(ValueError, match="rate"):
        simulate.run(
            model, simulate.start(model, READY_Q), lambda *_: np.zeros(7), 1, rate=rate
        )


@pytest.mark.parametrize("answer", [np.zeros(6), np.full(7, np.nan), np.zeros(8), 1.0])
def test_what_is_no_torque_is_refused(motors, answer):
    model, _ = motors
    with pytest.raises(ValueError, match="expected 7 torques"):
        simulate.run(model, simulate.start(model, READY_Q), lambda *_: answer, 0.1)
