"""Day 4: the arm floats, is pushed and comes to rest, as in the guide."""

import re

import mujoco
import numpy as np
import pytest

from conftest import ROOT, load_script, sentences
from robo47 import panda, simulate, verify

from day3_mujoco import beyond

GUIDE = (ROOT / "w1-foundations/docs/day4-lab.md").read_text("utf-8")
SENTENCES = sentences(4)
lab = load_script(ROOT / "w1-foundations/src/day4_dynamics.py")


@pytest.fixture(scope="module")
def arm():
    return panda.arm(panda.load("panda_nohand"))


@pytest.fixture(scope="module")
def model():
    return panda.load("panda_nohand", drive="torque")


def test_gravity_at_ready_and_what_the_arm_weighs(arm):
    tau = arm.at(panda.READY_Q).gravity_torque
    assert f"{tau[3]:.3f} N m of the 87" in SENTENCES
    assert abs(tau[0]) < 1e-12  # "joint1 holds nothing", since its axis is upright
    now = arm.at(panda.READY_Q)
    tipped = 9.81 * np.array([0, np.sin(0.1), -np.cos(0.1)])
    tau = lab.gravity_torque(now.J_space, arm.masses, now.coms_world, tipped)
    assert f"0.1 rad to the side, joint1 needs {abs(tau[0]):.1f} N m" in SENTENCES
    assert f"a {arm.masses.sum():.0f} kg arm" in SENTENCES


def test_the_arm_floats_and_falls_as_the_guide_says(arm, model):
    calm = 0 * lab.PUSH

    def moved(fraction, seconds):
        path = lab.let_go(model, arm, fraction, (seconds, calm))
        return np.linalg.norm(path[-1] - path[0])

    after = "After half a second the hand is"
    assert f"{after} {1000 * moved(0.0, 0.5):.0f} mm from its start" in SENTENCES
    assert f"only {1000 * moved(0.99, 2.0):.0f} mm in two seconds" in SENTENCES
    assert moved(1.0, 5.0) < 1e-12  # "less than a picometre"


@pytest.mark.parametrize(("newtons", "hits"), [(10.0, False), (50.0, True)])
def test_50_n_drive_the_arm_into_its_limits_and_10_do_not(arm, model, newtons, hits):
    law = lambda t, q, qd: arm.at(q).gravity_torque  # noqa: E731
    push = simulate.push_at("attachment_site", [0, 0, 0, 0, newtons, 0])
    data = simulate.start(model, panda.READY_Q)
    runs = [simulate.run(model, data, law, seconds, rate=lab.RATE, push=given)
            for seconds, given in ((0.5, push), (4.5, None))]  # fmt: skip
    assert (beyond(model.jnt_range, np.vstack([r.q for r in runs])) > 0) == hits


def test_without_torque_a_joint_is_at_its_limit_after_a_quarter_of_a_second(model):
    data = simulate.start(model, panda.READY_Q)
    while beyond(model.jnt_range, data.qpos[None]) <= 0:
        mujoco.mj_step(model, data)
    assert data.time == pytest.approx(0.25, abs=0.01)
    assert "reaches a joint limit after a quarter of a second" in SENTENCES


def test_the_arm_glides_when_it_is_pushed(arm, model):
    calm = 0 * lab.PUSH
    path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, calm))
    speed = np.linalg.norm(np.diff(path, axis=0), axis=1) * lab.RATE
    assert f"up to {speed.max():.2f} m/s" in SENTENCES
    pushed = round(0.5 * lab.RATE)
    assert path[pushed, 1] - path[0, 1] > 0.1  # along +y, and on round the base
    assert np.linalg.norm(path[-1] - path[0]) > 0.5
    assert f"still moves at {speed[-1]:.3f} m/s" in SENTENCES


def test_it_is_the_damping_that_slows_the_pushed_arm_down(arm):
    ends = []
    for share in (1.0, 0.5, 0.0):
        model = panda.load("panda_nohand", drive="torque")
        model.dof_damping[:] *= share
        path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, 0 * lab.PUSH))
        ends.append(np.linalg.norm(path[-1] - path[-2]) * lab.RATE)
    assert ends[1] > 4 * ends[0]
    assert ends[2] > 3 * ends[1]


def test_half_the_damping_leaves_four_times_the_speed_as_the_guide_answers(arm):
    for share, says in (
        (0.5, "0.169 m/s, four times"),
        (0.25, "damping it is 0.229 m/s"),
    ):
        model = panda.load("panda_nohand", drive="torque")
        model.dof_damping[:] *= share
        path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, 0 * lab.PUSH))
        speed = np.linalg.norm(path[-1] - path[-2]) * lab.RATE
        assert f"{speed:.3f}" in says
        assert says in SENTENCES


@pytest.mark.kit
def test_the_limit_of_joint_2_takes_energy_out_of_the_glide(arm):
    speeds = []
    for share in (0.5, 0.25):
        model = panda.load("panda_nohand", drive="torque")
        model.dof_damping[:] *= share
        q = pushed(model, arm, lab.RATE)[:, 1:2]  # of joint 2
        assert beyond(model.jnt_range[1:2], q) > 0
        model.jnt_limited[:] = 0
        path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, 0 * lab.PUSH))
        speeds.append(np.linalg.norm(path[-1] - path[-2]) * lab.RATE)
    says = (
        f"without joint limits the two speeds are {speeds[0]:.3f} and {speeds[1]:.3f}"
    )
    assert says in SENTENCES


def pushed(model, arm, rate):
    """Return the joint angles of the float that is pushed, (n, 7)."""
    law = lambda t, q, qd: arm.at(q).gravity_torque  # noqa: E731
    push = simulate.push_at("attachment_site", np.append(np.zeros(3), lab.PUSH))
    data = simulate.start(model, panda.READY_Q)
    runs = [simulate.run(model, data, law, seconds, rate=rate, push=given)
            for seconds, given in ((0.5, push), (4.5, None))]  # fmt: skip
    return np.vstack([run.q for run in runs])


@pytest.mark.kit
def test_without_gravity_the_rate_of_the_torque_does_not_matter(monkeypatch):
    model = panda.load("panda_nohand", drive="torque")
    model.opt.gravity[:] = 0
    arm = panda.arm(model)
    ends = []
    for rate in (50.0, 500.0):
        monkeypatch.setattr(lab, "RATE", rate)
        path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, 0 * lab.PUSH))
        ends.append(f"{np.linalg.norm(path[-1] - path[-2]) * rate:.3f}")
    assert ends[0] == ends[1]
    assert f"It does not: the speed is {ends[0]} m/s at both rates" in SENTENCES


@pytest.mark.kit
def test_the_arm_floats_in_twelve_random_configurations_as_well(arm, model):
    law = lambda t, q, qd: arm.at(q).gravity_torque  # noqa: E731
    for q in verify.random_q(model, 12, seed=5):
        run = simulate.run(model, simulate.start(model, q), law, 5.0, rate=lab.RATE)
        ends = [arm.at(x).T_world_ee[:3, 3] for x in (q, run.q[-1])]
        assert np.linalg.norm(ends[1] - ends[0]) < 1e-12
    assert "in this configuration and in twelve random ones" in SENTENCES


@pytest.fixture(scope="module")
def lyapunov():
    """Return the guide's: V at first, its largest rise in a step, V at last."""
    code = re.search(r"```python\n(def lyapunov.*?)\nfor k", GUIDE, re.S)[1]
    model = panda.load("panda_nohand", drive="torque")
    space = {**vars(lab), "model": model, "arm": panda.arm(model)}
    exec(code, space)
    return space["lyapunov"]


def test_with_dampers_and_gravity_compensation_V_falls_in_every_step(lyapunov):
    first, rise, last = lyapunov(100, 20, 1)
    assert rise < 0.0
    assert f"from {first:.1f} J to less than 0.000001 J" in SENTENCES
    assert 0.0 < last < 1e-6
    _, rise, last = lyapunov(100, 5, 1)
    assert rise < 0.0
    assert f"also falls in each step and ends at {last:.3f} J" in SENTENCES
    assert lyapunov(100, 0, 1)[1] < 0.0  # by the joints' own damping
    assert "With $d_c = 0$ it still falls" in SENTENCES


def test_without_its_causes_V_rises(lyapunov):
    _, rise, last = lyapunov(100, 20, 0)
    assert rise > 1e-3
    assert f"ends at {last:.2f} J, from this start and from six random" in SENTENCES
    assert lyapunov(100, -3, 1)[1] > 1.0


@pytest.mark.kit
def test_from_other_starts_V_ends_at_the_same_value_and_need_not_rise(arm):
    code = re.search(r"```python\n(def lyapunov.*?)\nfor k", GUIDE, re.S)[1]
    start = "0.3 * np.array([1, -1, 1, 1, -1, 1, -1])"
    assert start in code
    rises = []
    for seed in range(6):
        other = np.random.default_rng(seed).uniform(-0.4, 0.4, 7)
        model = panda.load("panda_nohand", drive="torque")
        space = {**vars(lab), "model": model, "arm": arm, "other": other}
        exec(code.replace(start, "other"), space)
        assert space["lyapunov"](100, 20, 1)[1] < 0.0
        _, rise, last = space["lyapunov"](100, 20, 0)
        assert last == pytest.approx(1.8755, abs=0.001)
        rises.append(rise > 0)
    assert {*rises} == {True, False}


@pytest.mark.kit
def test_V_rises_if_the_motors_saturate_and_falls_without_their_limits(arm):
    code = re.search(r"```python\n(def lyapunov.*?)\nfor k", GUIDE, re.S)[1]
    rises = []
    for limited in (True, False):
        model = panda.load("panda_nohand", drive="torque")
        if not limited:
            model.actuator_forcelimited[:] = model.actuator_ctrllimited[:] = 0
        space = {**vars(lab), "model": model, "arm": arm}
        exec(code, space)
        rises.append(space["lyapunov"](1000, 20, 1)[1])
    assert rises[0] > 0.1
    assert rises[1] < 0.0


def test_the_power_of_the_dampers_is_what_V_loses_only_with_the_rate_of_M(arm):
    """At random states of a motion under the law, by differences of V along it."""
    rng = np.random.default_rng(47)
    h = 1e-6
    without = []
    for q in verify.random_q(panda.load("panda_nohand"), 20, seed=7):
        qd = rng.uniform(-2, 2, 7)
        now = arm.at(q)
        e = panda.READY_Q - q
        tau = 100 * e - 20 * qd + now.gravity_torque
        qdd = np.linalg.solve(now.M, tau - now.bias(qd) - arm.damping * qd)
        Mdot = (arm.at(q + h * qd).M - arm.at(q - h * qd).M) / (2 * h)
        fixed = qd @ now.M @ qdd - 100 * e @ qd
        dampers = -(20 + arm.damping) * qd @ qd
        assert abs(fixed + 0.5 * qd @ Mdot @ qd - dampers) < 1e-6 * abs(dampers)
        without.append(abs(fixed - dampers))
    assert np.median(without) > 0.1  # watts


def test_with_M_alone_the_next_velocity_is_off_by_what_the_guide_says():
    model = panda.load("panda_nohand", drive="torque")
    now = lab.day4_mujoco.motions(model, 100, lab.SEED, lab.FASTEST, lab.HARDEST)
    share = np.random.default_rng(lab.TRIALS).uniform(-0.5, 0.5, now.q.shape)
    qdd, after = lab.mujoco_forward(model, now, share * simulate.limits(model)[1])
    off = np.abs(now.qd + model.opt.timestep * qdd - after).max()
    assert f"(With $M$ alone the prediction is off by {off:.3f} rad/s." in SENTENCES


def test_a_torque_that_is_held_brakes_the_pushed_arm_as_well(arm, monkeypatch):
    model = panda.load("panda_nohand", drive="torque")
    ends = []
    for rate in (50.0, 500.0):
        monkeypatch.setattr(lab, "RATE", rate)
        path = lab.let_go(model, arm, 1.0, (0.5, lab.PUSH), (4.5, 0 * lab.PUSH))
        ends.append(f"{np.linalg.norm(path[-1] - path[-2]) * rate:.3f}")
    says = "the speed of the hand after five seconds is {1} m/s instead of {0} m/s."
    assert says.format(*ends) in SENTENCES
