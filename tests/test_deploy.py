"""Between policy and arm: closed forms, loops, all ranks, MuJoCo's plane and spring."""

from itertools import permutations

import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from robo47 import cloning, deploy, evaluation, push

SEEDS = st.integers(0, 2**32 - 1)
BOX = {"low": [-0.2, -0.3], "high": [0.2, 0.3], "dt": 0.1}


def rng():
    return np.random.default_rng(21)


def touching(phi):
    """Return an observation with the contact at an angle from the x axis."""
    return np.array([0, 0, push.R * np.cos(phi), push.R * np.sin(phi)])


def angle_of(obs):
    return np.arctan2(obs[3] - obs[1], obs[2] - obs[0])


def test_the_worked_cases():
    assert_same(deploy.clamp_speed([0.3, 0.4], 0.25), [0.15, 0.2], 1e-15)
    assert_same(deploy.keep_inside([0.19, 0.1], [0.2, 0.1], **BOX), [0.1, 0.1], 1e-14)
    plan = np.arange(16.0).reshape(8, 2)
    assert_same(deploy.plan_entry(plan, 12, 15), [6, 7], 0)
    along = np.tile([0.1, 0.0], (4, 1))
    for parts, angle in ((5, 0.549973), (500, 0.545424)):
        obs = deploy.push_ahead(touching(0.3), along, 0.1, parts, push.R)
        assert angle_of(obs) == pytest.approx(angle, abs=5e-7)
    assert deploy.conformal_limit(np.arange(19), 0.05) == 18.0
    assert deploy.conformal_limit(np.arange(18), 0.05) == np.inf
    assert deploy.alarm_at([0.1, 0.9, 0.2, 0.9, 0.9, 0.9], 0.5, 3) == 5
    assert deploy.lag_behind(1.0, 1.0, 4.0) == 4.0
    success = np.zeros((3, 12), bool)
    success[0, :9] = True  # nine wins against the second, one against the third
    success[2, 1:9] = True
    p, different = deploy.compare_all(success)
    assert_same(p, [2 / 2**9, 1.0], 0)
    assert different.tolist() == [True, False]


@given(SEEDS)
def test_a_clamped_velocity_keeps_its_direction(seed):
    v = np.random.default_rng(seed).normal(size=(5, 3))
    slow = deploy.clamp_speed(v, 1.0)
    assert_same(np.linalg.norm(slow, axis=1), np.minimum(1, np.linalg.norm(v, axis=1)))
    assert_same(np.cross(v, slow), np.zeros((5, 3)), 1e-12)
    assert (np.sum(v * slow, axis=1) > 0).all()


def test_speed_zero_and_limit_zero():
    assert_same(deploy.clamp_speed([0.0, 0.0], 0.1), [0, 0], 0)
    assert_same(deploy.clamp_speed([0.3, 0.4], 0.0), [0, 0], 0)
    assert_same(deploy.clamp_speed([0.3, 0.4], 0.5), [0.3, 0.4], 0)


@given(SEEDS)
def test_the_next_position_is_clamped_axis_by_axis(seed):
    r = np.random.default_rng(seed)
    p = r.uniform(BOX["low"], BOX["high"])
    v = r.normal(size=2) * 5
    wanted = (np.clip(p + 0.1 * v, BOX["low"], BOX["high"]) - p) / 0.1
    assert_same(deploy.keep_inside(p, v, **BOX), wanted, 1e-12)


def test_a_hand_outside_may_come_back_and_need_not_jump():
    outside = [0.3, 0.0]
    assert_same(deploy.keep_inside(outside, [0.2, 0.1], **BOX), [0, 0.1], 0)
    assert_same(deploy.keep_inside(outside, [-0.2, 0.1], **BOX), [-0.2, 0.1], 0)
    assert_same(deploy.keep_inside(outside, [-9.0, 0.1], **BOX), [-5, 0.1], 1e-14)


def test_a_plan_that_has_run_out_keeps_its_last_action():
    plan = np.arange(8.0).reshape(4, 2)
    rows = [deploy.plan_entry(plan, 7, now)[0] for now in range(7, 13)]
    assert rows == [0, 2, 4, 6, 6, 6]
    deploy.plan_entry(plan, 0, 0)[:] = 9.0
    assert plan[0, 0] == 0.0


def test_the_predicted_push_is_the_closed_form_as_the_parts_get_many():
    off = []
    for parts in (50, 500):
        obs = deploy.push_ahead(touching(0.3), [[0.1, 0.0]] * 4, 0.1, parts, push.R)
        wanted = cloning.contact_angle(0.3, 0.04, push.R)
        off.append(abs(angle_of(obs) - wanted))
    assert off[1] < 5e-5
    assert off[0] / off[1] == pytest.approx(10.0, rel=0.01)  # of first order


def test_the_prediction_is_the_planes_within_a_millimetre():
    start = push.dock(20, rng())
    start[:, :2] = (
        start[:, 2:] * (1 + 0.075 / np.linalg.norm(start[:, 2:], axis=1))[:, None]
    )
    run = push.run(*push.scene(), start, push.demonstrator, 20)
    seen = run.observation
    off = [
        np.abs(
            deploy.push_ahead(seen[i, t], run.action[i, t : t + 3], 0.1, 5, push.R)
            - seen[i, t + 3]
        ).max()
        for i in range(20)
        for t in range(0, 17, 4)
    ]
    assert np.linalg.norm(seen[:, 0, 2:] - seen[:, -1, 2:], axis=1).min() > 0.05
    assert max(off) < 1e-3


def test_a_free_puck_stays_and_no_action_changes_nothing():
    obs = [0.0, 0.0, 0.2, 0.0]
    away = deploy.push_ahead(obs, [[-0.1, 0.1]], 0.1, 5, push.R)
    assert_same(away, [-0.01, 0.01, 0.2, 0.0], 1e-15)
    assert_same(deploy.push_ahead(obs, np.zeros((0, 2)), 0.1, 5, push.R), obs, 0)


def test_a_new_score_has_each_rank_equally_often():
    scores = np.array([0.3, 0.9, 0.1, 0.5, 0.7, 0.2])
    for share in (0.2, 0.34, 0.5, 0.84):
        alarms = [
            new > deploy.conformal_limit(held_out, share)
            for *held_out, new in permutations(scores)
        ]
        k = np.ceil(6 * (1 - share))
        assert np.mean(alarms) == pytest.approx(1 - k / 6)
        assert np.mean(alarms) <= share


def test_the_conformal_limit_at_its_ends():
    assert deploy.conformal_limit([], 0.05) == np.inf
    assert deploy.conformal_limit([0.1, 0.2], 0.0) == np.inf
    assert deploy.conformal_limit([0.1, 0.2], 1.0) == -np.inf
    for n in range(1, 400):  # ranks that are whole numbers, in spite of rounding
        k = -(-(n + 1) * 95 // 100)
        wanted = k - 1 if k <= n else np.inf
        assert deploy.conformal_limit(np.arange(n), 0.05) == wanted


@given(st.lists(st.sampled_from([0.1, 0.5, 0.9, np.nan])), st.integers(1, 4))
def test_an_alarm_is_the_first_run_of_large_scores(score, ticks):
    large = [not one <= 0.5 for one in score]
    ends = range(ticks - 1, len(large))
    wanted = [t for t in ends if all(large[t - ticks + 1 : t + 1])]
    assert deploy.alarm_at(score, 0.5, ticks) == (wanted[0] if wanted else -1)


def test_a_limit_of_infinity_is_never_exceeded_but_by_nan():
    assert deploy.alarm_at([1e9, np.inf], np.inf, 1) == -1
    assert deploy.alarm_at([1e9, np.nan], np.inf, 1) == 1


def test_the_lag_is_that_of_an_integrated_spring():
    v, K, inertia = 0.1, 600.0, 5.32
    D = 2 * np.sqrt(K * inertia)

    def flow(t, state):
        x, speed = state
        return [speed, (K * (v * t - x) - D * speed) / inertia]

    end = solve_ivp(flow, (0, 10), [0, 0], rtol=1e-10, atol=1e-12).y[0, -1]
    lag = deploy.lag_behind(v, K, inertia)
    assert lag == pytest.approx(v * 10 - end, rel=1e-6)
    assert lag == pytest.approx(0.0188, abs=5e-5)
    assert deploy.lag_behind(-v, K, inertia) == -lag


def test_the_lag_is_mujocos_slide_with_a_spring():
    model = mujoco.MjModel.from_xml_string(
        """<mujoco><option gravity="0 0 0" timestep="1e-3"/><worldbody><body>
        <joint name="x" type="slide" axis="1 0 0" damping="40"/>
        <geom size=".1" mass="4"/></body></worldbody>
        <actuator><position joint="x" kp="100"/></actuator></mujoco>"""
    )
    data = mujoco.MjData(model)
    while data.time < 5.0:
        data.ctrl[0] = 0.1 * data.time
        mujoco.mj_step(model, data)
    lag = deploy.lag_behind(0.1, 100.0, 4.0)
    assert 0.1 * data.time - data.qpos[0] == pytest.approx(lag, rel=1e-6)


@given(SEEDS)
def test_all_are_compared_with_the_first(seed):
    success = np.random.default_rng(seed).integers(0, 2, (4, 15))
    p, different = deploy.compare_all(success)
    wanted = [evaluation.sign_test(success[0], success[i]) for i in (1, 2, 3)]
    assert_same(p, wanted, 0)
    assert different.tolist() == evaluation.holm(wanted).tolist()
    assert different.dtype == bool


def test_one_policy_has_nothing_to_be_compared_with():
    p, different = deploy.compare_all([[1, 0, 1]])
    assert p.shape == different.shape == (0,)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: deploy.clamp_speed([np.nan, 0], 1), "not finite"),
        (lambda: deploy.clamp_speed([1, 0], -1), "below 0"),
        (lambda: deploy.keep_inside([0], [0], [1], [0], 0.1), "low is above high"),
        (lambda: deploy.keep_inside([0], [0], [0], [1], 0.0), "above 0"),
        (lambda: deploy.keep_inside([0], [0, 0], [0], [1], 0.1), "shape"),
        (lambda: deploy.plan_entry([[1.0]], 3, 2), "after now = 2"),
        (lambda: deploy.plan_entry(np.zeros((0, 2)), 0, 0), "shape"),
        (lambda: deploy.push_ahead(np.zeros(3), [[0, 0]], 0.1, 1, 0.1), "shape"),
        (lambda: deploy.push_ahead(touching(0), [0, 0], 0.1, 1, 0.1), "shape"),
        (lambda: deploy.push_ahead(touching(0), [[0, 0]], 0.1, 0, 0.1), "at least 1"),
        (lambda: deploy.push_ahead(np.zeros(4), [[0, 0]], 0.1, 1, 0.1), "one centre"),
        (lambda: deploy.conformal_limit([0.1, np.nan], 0.1), "without NaN"),
        (lambda: deploy.conformal_limit([[0.1]], 0.1), "vector"),
        (lambda: deploy.conformal_limit([0.1], 1.5), "between 0 and 1"),
        (lambda: deploy.alarm_at([0.1], np.nan, 1), "a number"),
        (lambda: deploy.alarm_at([0.1], 0.5, 0), "at least 1"),
        (lambda: deploy.lag_behind(0.1, 0.0, 1.0), "above 0"),
        (lambda: deploy.lag_behind(0.1, 1.0, -1.0), "below 0"),
        (lambda: deploy.compare_all([1, 0]), "shape"),
        (lambda: deploy.compare_all([[1, 0], [0, 2]]), "True and False"),
    ],
)
def test_what_is_no_input_is_refused(call, says):
    with pytest.raises(ValueError, match=says):
        call()
