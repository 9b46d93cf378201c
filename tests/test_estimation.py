"""Estimation against SciPy, Pinocchio, MuJoCo, Joseph's form and worked cases."""

import json
import re
from pathlib import Path

import mujoco
import numpy as np
import pytest
import scipy.integrate
import scipy.linalg
import scipy.optimize
import scipy.signal
import scipy.stats
from compare import assert_same
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from robo47 import dynamics, estimation, panda, verify

DATA = Path(__file__).parent / "data"
N = 20

numbers = st.floats(-3.0, 3.0, allow_subnormal=False)
angles = arrays(np.float64, 7, elements=numbers)
samples = arrays(np.float64, st.integers(2, 30), elements=numbers)
gains = st.floats(0.5, 500.0)


def believed(rng, n=3, m=2):
    """Return x, P, z, H and R of a reading of m numbers that tells of n."""
    left, noise = rng.normal(size=(n, n)), rng.normal(size=(m, m))
    P = left @ left.T + 0.1 * np.eye(n)
    R = noise @ noise.T + 0.1 * np.eye(m)
    return rng.normal(size=n), P, rng.normal(size=m), rng.normal(size=(m, n)), R


def moving(model, n=N, seed=9):
    """Return q, qd, J_space and G of n states."""
    rng = np.random.default_rng(seed)
    q = verify.random_q(model, n, seed)
    now = [panda.arm(model).at(one) for one in q]
    J, G = np.array([one.J_space for one in now]), np.array([one.G for one in now])
    return q, rng.uniform(-2, 2, q.shape), J, G


@given(angles, st.integers(2, 2**20))
def test_an_encoder_says_a_whole_count_no_further_than_half_a_step(q, counts):
    step = 2 * np.pi / counts
    said = estimation.quantise(q, counts)
    assert np.abs(said - q).max() <= step / 2 * (1 + 1e-9)
    assert_same(said / step, np.round(said / step), 1e-6)


def test_the_worked_cases_of_encoder_and_difference():
    assert_same(estimation.quantise([0.1], 4096), [65 * 2 * np.pi / 4096], 1e-15)
    assert_same(
        estimation.backward_difference([0.0, 0.1, 0.3], 0.1), [0.0, 1.0, 2.0], 1e-14
    )


@given(samples)
def test_a_difference_adds_up_to_what_was_differenced(q):
    qd = estimation.backward_difference(q, 0.002)
    assert_same(q[0] + 0.002 * np.cumsum(qd), q, 1e-12)
    assert_same(
        estimation.backward_difference(np.transpose([q, 2 * q]), 0.002)[:, 1], 2 * qd
    )


@given(gains, gains)
def test_at_the_delay_margin_the_loop_passes_through_minus_one(kp, kd):
    def loop(w):
        return (kp + 1j * kd * w) / (1j * w) ** 2

    delay = estimation.delay_margin(kp, kd)
    top = 10 * (kd + np.sqrt(kp))  # the gain falls all the way
    w = scipy.optimize.brentq(lambda w: abs(loop(w)) - 1, 1e-6 * top, top, xtol=1e-13)
    assert loop(w) * np.exp(-1j * w * delay) == pytest.approx(-1, abs=1e-7)


def test_critically_damped_the_delay_margin_is_a_number_over_omega():
    omega = np.array([1.0, 20.0, 40.0])
    margin = estimation.delay_margin(omega**2, 2 * omega)
    assert_same(margin * omega, np.full(3, 0.6474), 1e-5)
    assert margin[1] == pytest.approx(0.03237, abs=1e-5)


@given(samples, st.floats(0.1, 400.0))
def test_the_low_pass_is_lfilters(x, cutoff):
    a = 1 - np.exp(-2 * np.pi * cutoff * 0.002)
    truth, _ = scipy.signal.lfilter([a], [1, a - 1], x, zi=[(1 - a) * x[0]])
    assert_same(estimation.low_pass(x, 0.002, cutoff), truth, 1e-13)


def test_the_low_pass_answers_a_step_as_an_rc_circuit():
    said = estimation.low_pass([0.0, 1, 1, 1], 0.002, 20.0)
    assert_same(said, [0.0, 0.22223, 0.39508, 0.52951], 1e-5)
    assert_same(said, 1 - np.exp(-2 * np.pi * 20 * 0.002 * np.arange(4)), 1e-14)


@given(st.floats(1e-3, 2.0), st.floats(0.0, 9.0))
def test_the_model_of_constant_velocity_is_van_loans(dt, q):
    A, noise = np.array([[0.0, 1.0], [0.0, 0.0]]), np.diag([0.0, q])
    both = scipy.linalg.expm(dt * np.block([[-A, noise], [np.zeros((2, 2)), A.T]]))
    F, Q = estimation.constant_velocity(dt, q)
    assert_same(F, both[2:, 2:].T, 1e-12)
    assert_same(Q, both[2:, 2:].T @ both[:2, 2:], 1e-10)


@given(st.integers(0, 10**6))
def test_an_update_is_josephs_form_and_that_of_information(seed):
    x, P, z, H, R = believed(np.random.default_rng(seed))
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    left = np.eye(3) - K @ H
    new_x, new_P, nis = estimation.kalman_update(x, P, z, H, R)
    assert_same(new_P, left @ P @ left.T + K @ R @ K.T, 1e-10)
    informed = np.linalg.inv(P) + H.T @ np.linalg.solve(R, H)
    assert_same(np.linalg.inv(informed), new_P, 1e-7)
    told = np.linalg.solve(P, x) + H.T @ np.linalg.solve(R, z)
    assert_same(new_x, np.linalg.solve(informed, told), 1e-7)
    y = z - H @ x
    assert nis == pytest.approx(y @ np.linalg.solve(S, y))


@given(st.integers(0, 10**6))
def test_two_readings_at_once_are_one_after_the_other(seed):
    x, P, z, H, R = believed(np.random.default_rng(seed))
    R = np.diag(np.diag(R))
    at_once = estimation.kalman_update(x, P, z, H, R)
    first = estimation.kalman_update(x, P, z[:1], H[:1], R[:1, :1])
    second = estimation.kalman_update(*first[:2], z[1:], H[1:], R[1:, 1:])
    assert_same(at_once[0], second[0], 1e-9)
    assert_same(at_once[1], second[1], 1e-9)
    assert at_once[2] == pytest.approx(first[2] + second[2])


@given(st.integers(0, 10**6))
def test_a_reading_makes_no_state_less_sure_and_a_moment_none_more(seed):
    rng = np.random.default_rng(seed)
    x, P, z, H, R = believed(rng)
    _, after, nis = estimation.kalman_update(x, P, z, H, R)
    assert np.linalg.eigvalsh(P - after).min() > -1e-9
    assert np.linalg.eigvalsh(after).min() > 0.0
    assert nis >= 0.0
    F = rng.normal(size=(3, 3))
    _, later = estimation.kalman_predict(x, P, F, P)
    assert np.linalg.eigvalsh(later - F @ P @ F.T).min() > 0.0


def test_the_worked_cases_of_the_kalman_filter():
    F, Q = estimation.constant_velocity(1.0, 3.0)
    assert_same(Q, [[1.0, 1.5], [1.5, 3.0]], 1e-15)
    x, P = estimation.kalman_predict([0.0, 1.0], np.eye(2), F, Q)
    assert_same(x, [1.0, 1.0])
    assert_same(P, [[3.0, 2.5], [2.5, 4.0]], 1e-15)
    P = [[2.0, 1.0], [1.0, 2.0]]
    x, P, nis = estimation.kalman_update([0.0, 0], P, [3.0], [[1.0, 0]], [[1.0]])
    assert_same(x, [2.0, 1.0], 1e-15)
    assert_same(P, [[2 / 3, 1 / 3], [1 / 3, 5 / 3]], 1e-15)
    assert nis == pytest.approx(3.0)


def test_many_filters_run_at_once():
    each = [believed(np.random.default_rng(k)) for k in range(4)]
    stacked = [np.stack(part) for part in zip(*each, strict=True)]
    together = estimation.kalman_update(*stacked)
    for k, one in enumerate(each):
        alone = estimation.kalman_update(*one)
        for part, own in zip(together, alone, strict=True):
            assert_same(part[k], own, 1e-12)


@pytest.mark.parametrize(("cutoff", "kept"), [(5, 0.71), (50, 0.72), (100, 0.75)])
def test_the_amplitude_at_the_cutoff_is_what_the_docstring_gives(cutoff, kept):
    """Where the cutoff is not far below the sampling rate, more than 0.71 is left."""
    t = np.arange(5000) / 500.0
    wave = np.exp(2j * np.pi * cutoff * t)
    parts = [
        estimation.low_pass(part, 0.002, cutoff) for part in (wave.real, wave.imag)
    ]
    settled = np.hypot(*parts)[-1000:]
    assert f"{settled.mean():.2f}" == f"{kept:.2f}"
    assert f"{kept:.2f} " in estimation.low_pass.__doc__


@pytest.mark.parametrize(("n", "off"), [(10, 3e-3), (100, 8e-5), (1950, 3e-6)])
def test_the_interval_of_the_nis_comes_near_to_scipys_chi2(n, off):
    for m in (1, 3):
        exact = scipy.stats.chi2.ppf([0.025, 0.975], n * m) / n
        assert_same(estimation.nis_interval(n, m), exact, off)
    assert_same(estimation.nis_interval(1950, 1), [0.93821, 1.06374], 1e-5)


def test_the_autocorrelation_is_numpys_correlation_of_neighbours_and_small_for_noise():
    noise = np.random.default_rng(9).normal(size=2000)
    said = estimation.lag1_autocorrelation(noise)
    assert said == pytest.approx(np.corrcoef(noise[1:], noise[:-1])[0, 1], abs=1e-3)
    assert abs(said) < 1.96 / np.sqrt(2000)
    assert estimation.lag1_autocorrelation(np.cumsum(noise)) > 0.9
    assert estimation.lag1_autocorrelation(
        np.resize([1.0, -1.0], 100)
    ) == pytest.approx(-0.99)


@given(arrays(np.float64, 12, elements=numbers), st.floats(0.1, 9.0), numbers)
def test_the_autocorrelation_has_no_unit_and_no_offset(y, scale, offset):
    assume(np.ptp(y) > 0.1)
    said = estimation.lag1_autocorrelation(y)
    assert -1.0 <= said <= 1.0
    assert estimation.lag1_autocorrelation(scale * y + offset) == pytest.approx(
        said, abs=1e-9
    )


def test_the_energys_gradient_is_the_transposed_coriolis_matrix_on_either_panda(
    either_panda,
):
    _, qd, J, G = moving(either_panda)
    C = dynamics.coriolis_matrix(J, G, qd)
    truth = np.einsum("kij,ki->kj", C, qd)
    assert_same(estimation.kinetic_energy_gradient(J, G, qd), truth, 1e-12)


def test_pinocchio_agrees_on_the_energys_gradient(either_panda):
    kept = json.loads((DATA / "dynamics_oracle.json").read_text())["panda_nohand"]
    arm = panda.arm(either_panda)
    # MuJoCo 3 reproduces the file's inertias, which Pinocchio reads, to 5e-7.
    tol = 1e-4 if mujoco.__version__.startswith("3.") else 1e-12
    for q, qd, truth in zip(kept["q"], kept["qd"], kept["slope"], strict=True):
        now = arm.at(q)
        slope = estimation.kinetic_energy_gradient(now.J_space, now.G, qd)
        assert_same(slope, np.array(truth), tol)


def test_the_energys_gradient_is_a_difference_of_mujocos_kinetic_energy(either_panda):
    q, qd, J, G = moving(either_panda)
    model = either_panda
    data = mujoco.MjData(model)

    def energy(at, speed):
        data.qpos[:7] = at
        data.qvel[:7] = speed
        mujoco.mj_forward(model, data)
        mujoco.mj_energyVel(model, data)  # fills energy[1]: the kinetic one
        return data.energy[1]

    h = 1e-5
    slopes = np.array([
        [(energy(a + h * e, v) - energy(a - h * e, v)) / (2 * h) for e in np.eye(7)]
        for a, v in zip(q, qd, strict=True)
    ])  # fmt: skip
    assert_same(estimation.kinetic_energy_gradient(J, G, qd), slopes, 1e-7)


@given(angles, numbers)
def test_the_energys_gradient_grows_with_the_square_of_the_speed(qd, factor):
    now = panda.arm(panda.load("panda_nohand")).at(panda.READY_Q)
    slope = estimation.kinetic_energy_gradient(now.J_space, now.G, qd)
    faster = estimation.kinetic_energy_gradient(now.J_space, now.G, factor * qd)
    assert_same(faster, factor**2 * slope, 1e-10)
    assert slope[0] == pytest.approx(0.0, abs=1e-12)  # nothing changes about joint 1


def test_the_observer_follows_a_torque_as_a_low_pass_of_its_gain():
    gain, dt, pushed = 50.0, 1e-5, np.array([3.0, -1.0])
    r, integral, p = np.zeros(2), np.zeros(2), np.zeros(2)
    nothing = np.zeros(2)
    for _ in range(round(1 / gain / dt)):
        p = p + pushed * dt
        r, integral = estimation.momentum_observer_step(
            r, integral, p, nothing, nothing, nothing, 0.0, nothing, gain, dt
        )
    assert_same(r, (1 - np.exp(-1)) * pushed, 1e-3)


def test_the_observer_knows_what_is_known():
    rng = np.random.default_rng(9)
    p, tau, slope, gravity, qd, integral = rng.normal(size=(6, 7))
    damping, dt = rng.uniform(0.1, 1, 7), 0.002
    moved = integral + (tau + slope - gravity - damping * qd) * dt
    r, after = estimation.momentum_observer_step(
        0 * p, integral, moved, tau, slope, gravity, damping, qd, 50.0, dt
    )
    assert_same(r, np.zeros(7), 1e-14)
    assert_same(after, moved, 1e-14)
    one, nothing = np.ones(7), np.zeros(7)
    r, after = estimation.momentum_observer_step(
        nothing, nothing, one, *[nothing] * 3, 1.0, nothing, 50.0, dt
    )
    assert_same(r, 50 * one)
    assert not after.any()


@given(angles, st.integers(1, 7))
def test_the_contact_link_is_the_last_joint_over_its_threshold(residual, joint):
    threshold = np.abs(residual)
    assert estimation.contact_link(residual, threshold) == 0
    residual[joint - 1] = -9.0
    assert estimation.contact_link(residual, threshold) == joint
    assert estimation.contact_link(residual, 8.9) == joint
    assert estimation.contact_link(-residual, threshold) == joint


REFUSED = {
    "counts is 0; it must be above 0": (estimation.quantise, np.ones(3), 0),
    "q has shape (); expected (n, ...)": (estimation.backward_difference, 1.0, 0.1),
    "x holds a number": (estimation.low_pass, [0.0, np.nan], 0.1, 1.0),
    "kd is -1": (estimation.delay_margin, 1.0, -1.0),
    "accel_psd is -1; it must not be below 0": (
        estimation.constant_velocity, 1.0, -1.0
    ),
    "P has shape (3, 3)": (
        estimation.kalman_predict, np.ones(2), np.eye(3), np.eye(2), np.eye(2),
    ),
    "cannot be inverted": (
        estimation.kalman_update, [1.0], [[0.0]], [1.0], [[1.0]], [[0.0]],
    ),
    "the same": (estimation.lag1_autocorrelation, np.ones(5)),
    "expected (n,)": (estimation.lag1_autocorrelation, np.ones((5, 2))),
    "G has shape (6, 6, 6)": (
        estimation.kinetic_energy_gradient, np.ones((6, 7)), np.ones((6, 6, 6)),
        np.ones(7),
    ),
    "threshold is -1": (estimation.contact_link, np.ones(7), -1.0),
}  # fmt: skip


@pytest.mark.parametrize("words", REFUSED)
def test_a_wrong_argument_is_named(words):
    function, *arguments = REFUSED[words]
    with pytest.raises(ValueError, match=re.escape(words)):
        function(*arguments)
