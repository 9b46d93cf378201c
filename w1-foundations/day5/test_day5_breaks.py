"""Day 5: where a loop breaks, where an integral swings up, and what energy says."""

import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script
from robo47 import control, panda, references, scenes, simulate

SCRIPT = "w1-foundations/src/day5_control.py"
GUIDE = " ".join((ROOT / "w1-foundations/docs/day5-lab.md").read_text("utf-8").split())
lab = load_script(ROOT / SCRIPT)
START = lab.READY_Q - 1e-8 * lab.E0  # so near that no motor is at its limit


@pytest.fixture(scope="module")
def bench():
    """The arm with motors, and Day 4's library of it."""
    model = lab.day5_mujoco.motors()
    return model, panda.arm(model)


def breaking(bench, step=0.002, rate=500.0, damping=1.0):
    """Return the omega at which the loop of another model and rate breaks."""
    model = lab.day5_mujoco.motors()
    model.opt.timestep, model.dof_damping[:] = step, damping
    return lab.day5_mujoco.breaking(model, lab.equal_springs, rate, START)


@pytest.mark.kit
@pytest.mark.parametrize("step", [0.001, 0.002])
@pytest.mark.parametrize("rate", [500.0, 250.0, 100.0])
def test_the_rate_says_where_the_loop_breaks_and_hardly_the_step(bench, rate, step):
    predicted = float(control.max_stable_omega(step, round(1 / (rate * step))))
    assert breaking(bench, step, rate) == pytest.approx(predicted, abs=0.6)
    assert 0.82 * rate < predicted < rate  # "keep omega below the rate"


def test_the_limit_of_a_held_torque_is_where_an_eigenvalue_is_minus_1():
    for n in (1, 2, 5, 50):
        omega = control.max_stable_omega(0.002, n)
        h = 0.002
        e, ed = np.eye(2)  # the error and its rate, as rows on (e, ed) at the start
        acc = -(omega**2) * e - 2.0 * omega * ed
        for _ in range(n):
            ed = ed + h * acc
            e = e + h * ed
        assert np.linalg.eigvals([e, ed]).real.min() == pytest.approx(-1.0)
    assert_same([lab.max_stable_omega(0.002)], [control.max_stable_omega(0.002)], 1e-12)
    assert (
        "0.828. At 250 Hz it is 0.899, so the lab's own loop becomes unstable at 225"
        in GUIDE
    )
    assert 0.004 * control.max_stable_omega(0.002, 2) == pytest.approx(0.899, abs=5e-4)
    assert control.max_stable_omega(1e-6, 10**6) == pytest.approx(1.0, abs=1e-5)


def test_an_omega_between_the_two_limits_breaks_the_days_own_loop(bench):
    def left(omega):
        start = lab.READY_Q - 1e-8 * lab.E0
        law = lab.equal_springs(omega)
        log = lab.run(*bench, law, references.hold(lab.READY_Q), 0.24, start)
        return np.abs(lab.READY_Q - log.q)[-10:].max() / 1e-9

    assert left(220.0) < 0.1
    assert left(240.0) > 1e3
    assert "settles with `OMEGA` = 220, and it does not settle with 240" in GUIDE


def test_without_damping_in_the_joints_it_breaks_where_it_was_predicted(bench):
    assert breaking(bench, damping=0.0) == pytest.approx(
        lab.max_stable_omega(0.002), abs=0.15
    )
    assert breaking(bench) > lab.max_stable_omega(0.002) + 0.2
    assert "damping the loop becomes unstable at the predicted 414.2" in GUIDE


@pytest.mark.kit
def test_1_kg_is_predicted_at_ready_and_at_its_own_answer(bench):
    _, arm = bench
    now = arm.at(lab.READY_Q)
    first = np.linalg.solve(now.M, now.J_site.T @ [0, 0, 0, 0, 0, 9.81]) / 400.0
    assert f"gives {1e3 * first[3]:.2f} mrad" in GUIDE
    heavy = lab.day5_mujoco.motors(edit=scenes.hang_kilogram)
    log = lab.run(
        heavy, arm, lab.equal_springs(40.0), references.hold(lab.READY_Q), 1.0
    )
    assert f"{1e3 * (lab.READY_Q - log.q[-1])[3]:.2f} mrad at 40" in GUIDE


@pytest.mark.kit
def test_the_integral_has_rouths_limit_and_winds_up(bench):
    heavy = lab.day5_mujoco.motors(edit=scenes.hang_kilogram)

    def left(ki, model=bench[0], rate=lab.RATE):
        start = lab.READY_Q - 0.01 * lab.E0
        second = round(rate)
        law = lab.with_integral(ki, 1e9, 1.0 / rate)
        log = lab.run(
            model, bench[1], law, references.hold(lab.READY_Q), 6.0, start, rate
        )
        e = np.abs(log.q - lab.READY_Q).max(axis=1)
        return e[-second:].max() / e[2 * second : 3 * second].max()

    kp, kd = lab.pd_gains(20.0, 1.0)
    assert kp * kd == 16_000
    assert "If the model is exact, the limit is 16,000" in GUIDE
    third = np.roots([1.0, kd, kp, kp * kd])  # at the limit it swings for ever
    assert_same(np.sort(np.abs(third.imag)), [0.0, 20.0, 20.0], 1e-9)
    assert np.abs(third.real).min() < 1e-9
    M = bench[1].at(lab.READY_Q).M
    M_true = panda.arm(heavy).at(lab.READY_Q).M
    least = np.linalg.eigvals(np.linalg.solve(M_true, M)).real.min()
    assert f"smallest eigenvalue of this matrix is {least:.3f}" in GUIDE
    assert f"falls to {round(least * 16_000, -2):,.0f}" in GUIDE
    assert left(13_500, heavy) < 0.95
    assert left(14_000, heavy) > 1.1
    assert left(16_500) < 0.8
    assert left(20_000) > 2.0
    heavy.opt.timestep = 0.001  # sampled four times as fast, it is less patient
    assert left(13_500, heavy, 1000.0) > 1.1
    assert "settles slowly if KI = 13,500, and it oscillates with a growing" in GUIDE
    assert "growing amplitude if KI = 14,000" in GUIDE
    assert "settles if KI = 16,500, and the oscillation grows if KI = 20,000" in GUIDE
    goal = lab.READY_Q + 2.0 * np.eye(7)[0]
    for clamp, over in ((0.02, 0.14), (1e9, 1.03)):
        law = lab.with_integral(4000.0, clamp, 0.002)
        log = lab.run(*bench, law, references.hold(goal), 4.0, rate=500)
        assert (log.q - goal)[:, 0].max() == pytest.approx(over, abs=0.02)
    assert "overshoots by 0.14 rad, and without a clamp by more than 1 rad" in GUIDE


def test_the_motors_limits_are_those_of_the_guide(bench):
    assert_same(simulate.limits(bench[0])[1], [87, 87, 87, 87, 12, 12, 12], 0.0)
    assert "87 N m for joints 1 to 4 and 12 N m for 5 to 7" in GUIDE


@pytest.mark.parametrize("kd", [20.0, 40.0, 0.0])
def test_the_energy_of_springs_and_gravity_falls_while_the_arm_moves(bench, kd):
    model, arm = bench
    start = lab.READY_Q - lab.E0

    def law(arm, q, qd, ref):
        g = arm.at(q).gravity_torque
        against = kd * qd if kd else -arm.damping * qd  # no damper: friction undone
        return lab.gravity_pd(ref[0] - q, 0.0 * qd, lab.KP, 0.0, g) - against

    log = lab.run(model, arm, law, references.hold(lab.READY_Q), 1.0, start, 500.0)
    e = lab.READY_Q - log.q
    moving = [qd @ arm.at(q).M @ qd for q, qd in zip(log.q, log.qd, strict=True)]
    V = (np.array(moving) + lab.KP * np.sum(e * e, axis=1)) / 2
    falls = (np.diff(V) < 0).mean()
    assert (falls == 1.0) if kd else (V[-1] > 0.8 * V[0])
    assert "so the energy $V$ falls whenever the arm moves" in GUIDE
