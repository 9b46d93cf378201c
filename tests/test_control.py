"""Controllers of the joints against SciPy, Modern Robotics and what they promise."""

import hypothesis.extra.numpy as hnp
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from robo47 import control

vectors = hnp.arrays(np.float64, 7, elements=st.floats(-10, 10))
gains = st.floats(0.1, 1000)
zetas = st.one_of(
    st.floats(0.0, 10.0), st.sampled_from([0.0, 1.0, 1.0 - 1e-9, 1.0 + 1e-9])
)


@given(vectors, vectors, gains, gains)
def test_pd_is_linear_in_the_errors(e, ed, kp, kd):
    tau = control.pd_torque(e, ed, kp, kd)
    assert_same(tau, kp * e + kd * ed, 1e-9)


def test_the_tutorial_cases_of_day_5():
    e = np.array([0.1, 0, 0, 0, 0, 0, 0])
    assert control.pd_torque(e, 0 * e, 100, 20)[0] == 10.0
    assert control.pd_gains(20, 1).tolist() == [400.0, 40.0]
    assert control.error_response(0.1, 10, 1) == pytest.approx(0.7358, abs=5e-5)
    assert control.pd_equilibrium_step([0.0], [10.0], 100) == [-0.1]
    acc, integral = control.pid_step([1.0], [0.0], [0.0], 0.0, 0.0, 2.0, 0.1, 1.0)
    assert integral == pytest.approx([0.1])
    assert acc == pytest.approx([0.2])
    assert control.saturate([100.0], [87.0]) == [87.0]
    assert control.max_stable_omega(0.002) == pytest.approx(414.2, abs=0.05)
    q = np.arange(7.0)
    assert_same(control.servo_ctrl(0 * q, q, 0 * q, 4500, 450), q)


@given(st.floats(0.5, 50), zetas)
def test_the_error_response_agrees_with_scipys_matrix_exponential(omega, zeta):
    kp, kd = control.pd_gains(omega, zeta)
    t = np.linspace(0.0, 5.0 / omega, 20)
    falls = expm(np.array([[0.0, 1.0], [-kp, -kd]]) * t[:, None, None])  # from (1, 0)
    assert_same(control.error_response(t, omega, zeta), falls[:, 0, 0], 1e-8)


def test_the_error_response_broadcasts_and_neither_overflows_nor_divides_by_zero():
    t = np.linspace(0, 1e4, 5)
    zeta = np.array([[0.0], [1.0], [50.0]])
    out = control.error_response(t, 20.0, zeta)
    assert out.shape == (3, 5)
    assert np.isfinite(out).all()
    assert_same(out[:, 0], np.ones(3))


@given(vectors, vectors, vectors, gains, gains)
def test_gravity_pd_at_rest_on_its_goal_holds_the_arm(e, ed, g, kp, kd):
    assert_same(control.gravity_pd(0 * e, 0 * ed, kp, kd, g), g)
    ours = control.gravity_pd(e, ed, kp, kd, g)
    assert_same(ours - g, control.pd_torque(e, ed, kp, kd), 1e-9)


@given(hnp.arrays(np.float64, (7, 7), elements=st.floats(-1, 1)), vectors, vectors)
def test_computed_torque_gives_every_joint_the_designed_acceleration(A, e, ed):
    rng = np.random.default_rng(0)
    M = A @ A.T + np.eye(7)
    bias, qd, qdd_ref = rng.normal(size=(3, 7))
    tau = control.computed_torque(M, bias, 1.0, qd, e, ed, qdd_ref, 400.0, 40.0)
    qdd = np.linalg.solve(M, tau - bias - 1.0 * qd)
    assert_same(qdd, qdd_ref + 40.0 * ed + 400.0 * e, 1e-7)


@given(vectors, vectors, st.floats(1e-3, 0.1), st.floats(0.0, 1.0))
def test_the_integral_never_leaves_its_clamp(e, integral, dt, clamp):
    acc, after = control.pid_step(e, 0 * e, integral, 1.0, 1.0, 3.0, dt, clamp)
    assert (np.abs(after) <= clamp).all()
    assert_same(acc, e + 3.0 * after, 1e-9)


def test_without_a_clamp_in_the_way_the_integral_is_the_sum_of_e_dt():
    integral, e = np.zeros(7), np.arange(7.0)
    for _ in range(10):
        _, integral = control.pid_step(e, e, integral, 1, 1, 1, 0.01, 100.0)
    assert_same(integral, e * 0.1)


@given(vectors, st.floats(0, 5))
def test_saturation_keeps_within_the_limits_and_changes_nothing_inside(tau, limit):
    out = control.saturate(tau, limit)
    assert (np.abs(out) <= limit).all()
    inside = np.abs(tau) <= limit
    assert_same(out[inside], tau[inside])
    assert (np.sign(out) * np.sign(tau) >= 0).all()


@pytest.mark.parametrize("h", [0.001, 0.002, 0.004])
def test_fastest_is_where_semi_implicit_euler_stops_being_stable(h):
    def largest_eigenvalue(omega):
        kp, kd = control.pd_gains(omega, 1.0)
        # qd' = qd + h qdd, q' = q + h qd': what MuJoCo's Euler does to a free mass.
        step = np.array([[1 - h * h * kp, h - h * h * kd], [-h * kp, 1 - h * kd]])
        return np.abs(np.linalg.eigvals(step)).max()

    limit = control.max_stable_omega(h)
    assert largest_eigenvalue(0.999 * limit) < 1.0 < largest_eigenvalue(1.001 * limit)


@given(vectors, vectors, vectors, st.floats(1, 5000), st.floats(0, 500))
def test_a_servo_told_servo_ctrl_gives_the_torque(tau, q, qd, kp, kd):
    ctrl = control.servo_ctrl(tau, q, qd, kp, kd)
    assert_same(kp * (ctrl - q) - kd * qd, tau, 1e-6)


def test_many_configurations_at_once_equal_one_at_a_time():
    rng = np.random.default_rng(1)
    M = np.eye(7) + 0.1 * rng.normal(size=(4, 7, 7))
    bias, qd, e, ed, qdd = rng.normal(size=(5, 4, 7))
    kp = rng.uniform(1, 2, 7)
    ours = control.computed_torque(M, bias, 1.0, qd, e, ed, qdd, kp, 2.0)
    one = [
        control.computed_torque(M[i], bias[i], 1.0, qd[i], e[i], ed[i], qdd[i], kp, 2.0)
        for i in range(4)
    ]
    assert_same(ours, np.array(one))


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: control.pd_torque([1.0] * 7, [1.0] * 6, 1, 1), r"ed has shape \(6,\)"),
        (lambda: control.pd_torque([1.0] * 7, [1.0] * 7, [1, 2], 1), "kp has shape"),
        (lambda: control.pd_torque(1.0, 1.0, 1, 1), r"e has shape \(\)"),
        (
            lambda: control.pd_gains(np.nan, 1),
            "omega holds a number that is not finite",
        ),
        (lambda: control.error_response(-1.0, 1, 1), "t is -1; it must not be below 0"),
        (lambda: control.error_response(1.0, 0, 1), "omega is 0; it must be above 0"),
        (
            lambda: control.pd_equilibrium_step([0.0], [1.0], 0),
            "kp is 0; it must be above 0",
        ),
        (lambda: control.max_stable_omega(0.0), "h is 0; it must be above 0"),
        (lambda: control.saturate([1.0], -1), "limits is -1"),
        (
            lambda: control.pid_step([1.0], [0.0], [0.0], 1, 1, 1, 0.1, -1),
            "clamp is -1",
        ),
    ],
)
def test_what_is_wrong_is_named_in_one_line(call, words):
    with pytest.raises(ValueError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)
