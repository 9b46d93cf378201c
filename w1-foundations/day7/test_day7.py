"""Day 7's motions: functions against oracles; the numbers in the guide's sentences."""

from unittest.mock import patch

import numpy as np
import pytest
from compare import assert_same
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly
from scipy.spatial.transform import Rotation, Slerp

from conftest import ROOT, load_script
from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from robo47 import (
    panda,
    screws,
    se3,
)

SCRIPT = "w1-foundations/src/day7_trajectory.py"
GUIDE = " ".join((ROOT / "w1-foundations/docs/day7-lab.md").read_text("utf-8").split())
DAY = find_day(7)
lab = load_script(ROOT / SCRIPT)
DQ = np.abs(lab.GOAL_Q - lab.READY_Q)
seeds = st.integers(0, 2**32 - 1)


def says(words):
    assert " ".join(words.split()) in GUIDE
    return True


@settings(deadline=None)
@given(seeds)
def test_the_labs_functions_agree_with_scipy(seed):
    rng = np.random.default_rng(seed)
    T = rng.uniform(0.3, 4.0)
    start, end = rng.uniform(-1, 1, (2, 3))
    six = lab.quintic_coefficients(start, end, T)
    truth = BPoly.from_derivatives([0, T], [start, end])
    for t in rng.uniform(0, T, 5):
        assert_same(six @ t ** np.arange(6), truth(t), 1e-9)
    R = Rotation.random(2, random_state=seed % 1000)
    p = rng.uniform(-1, 1, (2, 3))
    s = rng.uniform()
    T0, T1 = se3.make_T(R.as_matrix(), p)
    ours = lab.interpolate_pose(T0, T1, s)
    assert_same(ours[:3, :3], Slerp([0, 1], R)(s).as_matrix(), 1e-9)
    assert_same(ours[:3, 3], (1 - s) * p[0] + s * p[1], 1e-12)


@settings(deadline=None)
@given(seeds)
def test_speed_and_acceleration_are_the_derivatives(seed):
    rng = np.random.default_rng(seed)
    T = rng.uniform(0.5, 3.0)
    h = 1e-5
    t = rng.uniform(0.05, 0.95) * T
    before, now, after = (lab.quintic_scaling(t + k * h, T) for k in (-1, 0, 1))
    assert_same((after[:2] - before[:2]) / (2 * h), now[1:], 1e-6)


def test_the_rounded_numbers_of_the_docstrings():
    assert_same(lab.quintic_scaling(0.6, 2.0), [0.16308, 0.6615, 1.26], 1e-12)
    free = np.full(7, np.inf)
    assert lab.quintic_duration(np.eye(7)[0], np.full(7, 1.875), free) == 1.0
    assert_same(
        lab.trapezoidal_profile(0.4472 / 2, 0.1, 1.0, 2.0)[:2], [0.05, 0.4472], 1e-4
    )
    assert lab.max_cube_mass(0.9247, 1.0, 0.0) == pytest.approx(0.189, abs=5e-4)


def test_the_mistakes_of_the_scaling_have_the_numbers_of_the_textbooks_case():
    named = {way.slug: way for way in reversed(row_of(DAY, "quintic_scaling").ways)}
    numbers = {
        "cubic": [0.216, 0.63, 0.6],
        "sd-not-divided": [0.16308, 1.323, 1.26],
        "t-for-x": [0.68256, 1.728, -2.88],
        "6-and-10-swapped": [0.0648, 0.2025, 0.0],
    }
    for slug, wanted in numbers.items():
        assert_same(named[slug].code(0.6, 2.0), wanted, 1e-12)


def test_step_1s_two_mistakes():
    unclipped = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6])
    assert unclipped(1.25) == pytest.approx(1.2207, abs=5e-5)
    assert lab.quintic_scaling(0.6, 2.0)[1] * 2 == pytest.approx(1.323, abs=1e-9)
    swapped = np.polynomial.Polynomial([0, 0, 0, 6, -15, 10])
    assert (swapped(1.0), swapped.deriv()(1.0)) == (1.0, 8.0)
    assert says("6 and 10, s still ends at 1, but with the velocity $8 / T$")
    assert says("is 1.3230 instead of 0.6615. Without the clamp s is 1.2207")
    assert says("by 22 % of the distance")


def test_step_2s_table():
    by_speed = 15 / 8 * DQ / lab.V_MAX
    by_acceleration = np.sqrt(10 / np.sqrt(3) * DQ / lab.A_MAX)
    each = np.maximum(by_speed, by_acceleration)
    cubic = max((1.5 * DQ / lab.V_MAX).max(), by_acceleration.max())
    for T, words in (
        (cubic, "the factor 1.5 of the cubic time scaling instead of 15/8"),
        (each.min(), "the duration of the fastest joint"),
    ):
        broken = 100 * ((by_speed / T).max() - 1)
        assert says(f"{words} | {T:.3f} s | {broken:.0f} %")
    assert says(f"one after the other | {each.sum():.3f} s")
    assert says(f"because its velocity limit requires {by_speed[6]:.4f} s")
    assert each.argmax() == 6


def test_half_way_through_120_degrees_entry_by_entry_is_no_rotation():
    R = (np.eye(3) + se3.Rz(np.radians(120))) / 2
    assert np.linalg.det(R) == pytest.approx(0.25)
    assert says("half way through a rotation of 120 degrees the determinant is 0.25")


def test_a_limit_of_speed_is_a_division_and_one_of_acceleration_a_root():
    dq = np.eye(7)[0]
    free = np.full(7, np.inf)
    one, four = (lab.quintic_duration(dq, np.full(7, v), free) for v in (4.0, 1.0))
    assert four / one == pytest.approx(4.0)
    one, four = (lab.quintic_duration(dq, free, np.full(7, a)) for a in (4.0, 1.0))
    assert four / one == pytest.approx(2.0)
    arm = panda.arm(panda.load("panda_nohand", drive="torque"))

    def hardest(T):
        """Return the largest torque of the move of step 2, N m, without friction."""
        move = (lab.joint_trajectory(lab.READY_Q, lab.GOAL_Q, x * T, T)
                for x in np.linspace(0.0, 1.0, 50))  # fmt: skip
        tau = [arm.at(q).M @ qdd + arm.at(q).bias(qd) for q, qd, qdd in move]
        return np.abs(tau).max()

    one, ten, thousand = hardest(0.5), hardest(5.0), hardest(500.0)
    assert one > 1.5 * ten
    assert ten == pytest.approx(thousand, rel=0.02)  # what gravity takes
    assert says("the gravity torque does not decrease when the motion is slower")


def followed(scaling, seconds, rate=lab.RATE):
    line = lab.READY_Q, lab.GOAL_Q, lab.OMEGA, rate
    return lab.day7_mujoco.follow(scaling, seconds, *line)


def test_step_7s_sentences():
    T = lab.quintic_duration(lab.GOAL_Q - lab.READY_Q, lab.V_MAX, lab.A_MAX)
    ways = lab.profiles(T)
    off, jerk, torque = zip(*(followed(*way) for way in ways.values()), strict=True)
    numbers = dict(zip(ways, zip(off, jerk, torque, strict=True), strict=True))
    jump = f"(row `step`) would need {numbers['step'][2]:.1f} times the torque"
    assert says(jump)
    assert says(f"so the arm is {numbers['constant speed'][0]:.0f} mrad off")
    assert numbers["constant speed"][2] > 1.0
    assert max(numbers[n][0] for n in ("cubic", "trapezoid", "quintic")) < 1.0
    assert says(f"a finite jerk of {numbers['quintic'][1]:.0f} rad/s³")
    assert 0.78 < ways["trapezoid"][1] / T < 0.82
    assert says("takes a fifth less time (14 to 43 % less in 200 random motions)")
    top = np.minimum(lab.V_MAX, np.sqrt(DQ * lab.A_MAX))
    alone = DQ / top + top / lab.A_MAX
    assert (lab.V_MAX / DQ).argmin() == 6
    assert (lab.A_MAX / DQ).argmin() == alone.argmax() == 1
    assert says("joint7 limits its velocity and joint2 limits its acceleration")
    assert says(f"it would need {alone.max():.4f} s, the duration of joint2")


def random_motions(n, seed):
    """Yield the ends of random motions, and the five time scalings of each."""
    at = lab.day7_mujoco.moves(panda.load("panda"), n, seed)
    for q0, q1 in zip(at.q0, at.q1, strict=True):
        T = lab.quintic_duration(q1 - q0, lab.V_MAX, lab.A_MAX)
        with patch.multiple(lab, READY_Q=q0, GOAL_Q=q1):
            yield q0, q1, T, lab.profiles(T)


def test_no_random_motion_is_slower_by_its_trapezoid():
    ratio = [ways["trapezoid"][1] / T for _, _, T, ways in random_motions(200, 47)]
    faster = sorted(100 * (1 - np.array(ratio)))
    assert [round(faster[0]), round(faster[-1])] == [14, 43]
    for *_, ways in random_motions(20, 47):
        scaling, T = ways["trapezoid"]
        assert_same(scaling(T * (1 + 1e-12))[0], 1.0, 1e-9)
        assert scaling(0.999 * T)[0] < 1.0  # it has not arrived before


@pytest.mark.kit
def test_in_twelve_random_motions_three_scalings_are_followed_within_a_few_mrad():
    found = [
        lab.day7_mujoco.follow(*ways[name], q0, q1, lab.OMEGA, lab.RATE).mrad
        for q0, q1, _, ways in random_motions(12, 1)
        for name in ("cubic", "trapezoid", "quintic")
    ]
    assert 1.0 < max(found) < 1.5
    assert says("(within 1.5 mrad in twelve random motions)")


def other_arm(timestep=None, torque=1.0):
    """Return `panda.load` for an arm with another time step or torque limit."""
    load = panda.load

    def loaded(*args, **named):
        model = load(*args, **named)
        model.opt.timestep = timestep or model.opt.timestep
        for limits in (
            model.actuator_forcerange,
            model.actuator_ctrlrange,
            model.jnt_actfrcrange,
        ):
            limits *= torque
        return model

    return patch.object(panda, "load", loaded)


def off(name, omega=lab.OMEGA, rate=lab.RATE, **arm):
    """Return the joint error of step 7's motion in mrad."""
    way = lab.profiles(0.995)[name]
    with other_arm(**arm):
        return lab.day7_mujoco.follow(*way, lab.READY_Q, lab.GOAL_Q, omega, rate).mrad


def test_the_quintics_error_is_that_of_the_simulators_step():
    # Semi-implicit steps put q off by a dt^2 / 2 each, a velocity of a dt / 2. The
    # controller balances that velocity with an error of 2 / omega times it.
    for omega in (lab.OMEGA, 2 * lab.OMEGA):
        coarse, fine = (off("quintic", omega, 500.0, timestep=h) for h in (2e-3, 1e-3))
        assert 0.5 < fine / coarse < 0.6
    largest = 10 / np.sqrt(3) * DQ.max() / 0.995**2  # rad/s^2
    predicted = 1000 * largest * 0.002 / lab.OMEGA
    assert off("quintic", rate=500.0) == pytest.approx(predicted, rel=0.5)


def test_constant_speed_has_half_the_error_only_without_a_torque_limit():
    limited, free = (
        off("constant speed", 2 * lab.OMEGA, torque=torque)
        / off("constant speed", torque=torque)
        for torque in (1.0, 10.0)
    )
    assert limited > 0.9
    assert free == pytest.approx(0.5, abs=0.05)


def test_half_as_stiff_the_arm_is_twice_as_far_off():
    quintic = lab.profiles(0.995)["quintic"]
    move = (lab.READY_Q, lab.GOAL_Q)
    off = [lab.day7_mujoco.follow(*quintic, *move, omega, lab.RATE)[0]
           for omega in (lab.OMEGA, lab.OMEGA / 2)]  # fmt: skip
    assert off[1] / off[0] == pytest.approx(2.0, abs=0.15)
    assert "with 10 the errors are twice as large" in (ROOT / SCRIPT).read_text("utf-8")


def test_a_short_move_overshoots_without_the_triangle():
    L, v, a = 0.1, 1.0, 2.0
    t = np.linspace(0.0, v / a, 100)
    assert (0.5 * a * t**2).max() > 2 * L  # ramped up to v, whatever L is
    assert max(lab.trapezoidal_profile(x, L, v, a)[0] for x in t) <= L


def test_the_origin_of_a_screw_motion_leaves_the_straight_line():
    T0 = np.eye(4)
    T1 = se3.make_T(se3.Rz(np.radians(120)), [1.0, 0.0, 0.0])
    S = np.array([0.0, 0.0, 1.0, 0.5 / np.sqrt(3.0), -0.5, 0.0])  # about the middle
    assert_same(screws.exp_screw(S, np.radians(120)), T1, 1e-12)
    half = screws.exp_screw(S, np.radians(60))
    assert_same(half[:3, 3], [0.5, -0.5 / np.sqrt(3.0), 0.0], 1e-12)
    assert se3.is_pose(half)
    assert_same(lab.interpolate_pose(T0, T1, 0.5)[:3, 3], [0.5, 0.0, 0.0], 1e-12)
    assert says("but its origin moves along an arc")


@pytest.mark.kit
def test_a_jump_of_acceleration_has_a_jerk_that_doubles_with_the_rate():
    T = 0.995
    at_250 = {n: followed(*w)[1] for n, w in lab.profiles(T).items()}
    at_500 = {n: followed(*w, rate=500.0)[1] for n, w in lab.profiles(T).items()}
    for name in ("constant speed", "cubic", "trapezoid"):
        assert at_500[name] / at_250[name] == pytest.approx(2.0, abs=0.2), name
    assert at_500["quintic"] / at_250["quintic"] == pytest.approx(1.0, abs=0.05)


def test_the_predictions_can_be_made_from_what_the_guide_says():
    numbers = lambda q: "(" + ", ".join(f"{x:g}" for x in np.round(q, 3)) + ")"  # noqa: E731
    assert says(f"{numbers(lab.READY_Q)} rad. It ends at {numbers(lab.GOAL_Q)} rad")
    speeds = np.repeat([2.175, 2.61], [4, 3])
    assert_same(lab.V_MAX, speeds, 0.0)
    assert says("2.175 rad/s for joints 1 to 4 and 2.61 rad/s for joints 5 to 7")
    assert_same(lab.A_MAX, [15, 7.5, 10, 12.5, 15, 20, 20], 0.0)
    assert says("7.5, 10, 12.5, 15, 20 and 20 rad/s²")
