"""Day 7's lab: its functions against oracles; the numbers in the guide's sentences."""

import importlib.util
import re
from unittest.mock import MagicMock, patch

import numpy as np
import pytest
from compare import assert_same
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly
from scipy.spatial.transform import Rotation, Slerp

from conftest import ROOT, load_script, need, paper
from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from robo47 import (
    capstone,
    jacobian,
    lifting,
    panda,
    scenes,
    screws,
    se3,
    simulate,
    trajectory,
    verify,
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


# --- the functions ---


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
    ours = lab.straight_pose(T0, T1, s)
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
    assert_same(lab.trapezoid(0.4472 / 2, 0.1, 1.0, 2.0)[:2], [0.05, 0.4472], 1e-4)
    assert lab.heaviest_cube(0.9247, 1.0, 0.0) == pytest.approx(0.189, abs=5e-4)


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


# --- sentences of the guide ---


def test_step_1s_two_mistakes():
    unclipped = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6])
    assert unclipped(1.25) == pytest.approx(1.2207, abs=5e-5)
    assert lab.quintic_scaling(0.6, 2.0)[1] * 2 == pytest.approx(1.323, abs=1e-9)
    swapped = np.polynomial.Polynomial([0, 0, 0, 6, -15, 10])
    assert (swapped(1.0), swapped.deriv()(1.0)) == (1.0, 8.0)
    assert says("with 6 and 10 swapped s still ends at 1, but at a speed of 8 / T")
    assert says("sd is 1.3230 instead of 0.6615. Without the clip s is 1.2207")
    assert says("by 22 % of the way")


def test_step_2s_table():
    by_speed = 15 / 8 * DQ / lab.V_MAX
    by_acceleration = np.sqrt(10 / np.sqrt(3) * DQ / lab.A_MAX)
    each = np.maximum(by_speed, by_acceleration)
    cubic = max((1.5 * DQ / lab.V_MAX).max(), by_acceleration.max())
    for T, words in (
        (cubic, "the cubic's peak speed"),
        (each.min(), "the joint that needs least"),
    ):
        broken = 100 * ((by_speed / T).max() - 1)
        assert says(f"{words} | {T:.3f} s | {broken:.0f} %")
    assert says(f"one after the other | {each.sum():.3f} s")
    assert says(f"joint7 needs its {by_speed[6]:.4f} s for its speed")
    assert each.argmax() == 6


def test_half_way_through_120_degrees_entry_by_entry_is_no_rotation():
    R = (np.eye(3) + se3.Rz(np.radians(120))) / 2
    assert np.linalg.det(R) == pytest.approx(0.25)
    assert says("half way through a turn of 120 degrees the determinant is 0.25")


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
        move = (lab.joint_move(lab.READY_Q, lab.GOAL_Q, x * T, T)
                for x in np.linspace(0.0, 1.0, 50))  # fmt: skip
        tau = [arm.at(q).M @ qdd + arm.at(q).bias(qd) for q, qd, qdd in move]
        return np.abs(tau).max()

    one, ten, thousand = hardest(0.5), hardest(5.0), hardest(500.0)
    assert one > 1.5 * ten
    assert ten == pytest.approx(thousand, rel=0.02)  # what gravity takes
    assert says("A torque limit is neither: gravity does not shrink at all")


def test_an_unfolded_yaw_fails_where_joint7_is_at_its_end():
    model = scenes.table_top(capstone.CUBE_XY, 0.0)
    arm = panda.arm(model)
    limits = model.jnt_range[:7].copy()
    yaw = np.radians(np.arange(-180, 180, 5))
    cubes = np.tile(np.eye(4), (len(yaw), 1, 1))
    cubes[:, :3, :3] = se3.Rz(yaw)
    cubes[:, :3, 3] = [*capstone.CUBE_XY, scenes.TABLE_HEIGHT + scenes.CUBE_HALF]
    folded = lifting.grasp_pose(cubes, np.full(len(yaw), 0.12))
    plain = folded.copy()
    plain[:, :3, :3] = cubes[:, :3, :3] @ np.diag([1.0, -1.0, -1.0])
    start = np.tile(panda.READY_Q, (len(yaw), 1))
    loop = find_day(3).module("loop")

    def walked(goals):
        q = loop.walk(arm.screws, arm.M_home, goals, start, limits)
        return q, ~jacobian.reached(arm.screws, arm.M_home, goals, q)

    assert not walked(folded)[1].any()
    q, fails = walked(plain)
    lowest, highest = np.degrees(yaw[fails][[0, -1]])
    assert says(f"fails for {fails.sum()} of the {len(yaw)} yaws, {lowest:.0f} to")
    assert says(f"to {highest:.0f} degrees, and each time joint7 stands at its end")
    assert_same(np.minimum(*np.abs(q[fails, 6, None] - limits[6]).T), np.zeros(17), 0.0)
    best = jacobian.solve_ik(arm.screws, arm.M_home, plain, start, limits)
    assert jacobian.reached(arm.screws, arm.M_home, plain, best).all()
    limits[6] = -7, 7
    assert not walked(plain)[1].any()
    assert says("if joint7 could turn by ±7 rad")


def test_the_hand_weighs_what_the_guide_says():
    mass = panda.hand_inertia(panda.load("panda"))[0]
    assert says(f"The hand with its fingers is {mass:.2f} kg more")


def test_gravity_shows_a_wrong_centre_and_speed_alone_a_wrong_inertia():
    model = panda.load("panda")
    named = row_of(DAY, "carry").named
    q = verify.random_q(panda.load("panda_nohand"), 50, lab.SEED)
    ways = {way.slug: way.code for way in named}

    def off(slug, speed):
        with patch("numpy.random.default_rng") as rng:
            rng.return_value.uniform.return_value = np.full(q.shape, speed)
            with patch.object(lab, "carry", ways[slug]):
                return np.abs(lab.off_carried(model, q)).max()

    for slug in ("only-the-second-moved", "no-parallel-axes"):
        assert off(slug, 0.0) < 1e-12 < 0.001 < off(slug, 1.0) < 0.1
    for slug in ("first-centre-kept", "not-divided-by-the-mass"):
        assert off(slug, 0.0) > 0.5
    assert says("its inertia, which only speed shows")


def followed(scaling, seconds, rate=lab.RATE):
    line = lab.READY_Q, lab.GOAL_Q, lab.OMEGA, rate
    return lab.day7_mujoco.follow(scaling, seconds, *line)


def test_step_7s_sentences():
    T = lab.quintic_duration(lab.GOAL_Q - lab.READY_Q, lab.V_MAX, lab.A_MAX)
    ways = lab.profiles(T)
    off, jerk, torque = zip(*(followed(*way) for way in ways.values()), strict=True)
    numbers = dict(zip(ways, zip(off, jerk, torque, strict=True), strict=True))
    assert says(f"asks for {numbers['step'][2]:.1f} times the torque")
    assert says(f"so it is {numbers['constant speed'][0]:.0f} mrad off")
    assert numbers["constant speed"][2] > 1.0
    assert max(numbers[n][0] for n in ("cubic", "trapezoid", "quintic")) < 1.0
    assert says(f"a number of its own, {numbers['quintic'][1]:.0f} rad/s³")
    assert 0.78 < ways["trapezoid"][1] / T < 0.82  # "a fifth faster"
    top = np.minimum(lab.V_MAX, np.sqrt(DQ * lab.A_MAX))
    alone = DQ / top + top / lab.A_MAX
    assert (lab.V_MAX / DQ).argmin() == 6
    assert (lab.A_MAX / DQ).argmin() == alone.argmax() == 1
    assert says("joint7 sets its speed and joint2 its acceleration")
    assert says(f"joint2, the slowest, would need {alone.max():.4f} s")


def test_half_as_stiff_the_arm_is_twice_as_far_off():
    quintic = lab.profiles(0.995)["quintic"]
    move = (lab.READY_Q, lab.GOAL_Q)
    off = [lab.day7_mujoco.follow(*quintic, *move, omega, lab.RATE)[0]
           for omega in (lab.OMEGA, lab.OMEGA / 2)]  # fmt: skip
    assert off[1] / off[0] == pytest.approx(2.0, abs=0.15)
    assert "with 10 the errors are twice as large" in (ROOT / SCRIPT).read_text("utf-8")


@pytest.mark.kit
@pytest.mark.parametrize(("rate", "falls"), [(20.0, False), (12.5, True)])
def test_below_omega_the_controllers_rate_drops_the_cube(rate, falls):
    assert capstone.pick(capstone.library(), rate=rate).failed == falls
    assert "at 20 the arm still picks, at 12.5 the cube falls" in (
        (ROOT / SCRIPT).read_text("utf-8")
    )


def test_a_short_move_overshoots_without_the_triangle():
    L, v, a = 0.1, 1.0, 2.0
    t = np.linspace(0.0, v / a, 100)
    assert (0.5 * a * t**2).max() > 2 * L  # ramped up to v, whatever L is
    assert max(lab.trapezoid(x, L, v, a)[0] for x in t) <= L


def test_the_origin_of_a_screw_motion_leaves_the_straight_line():
    T0 = np.eye(4)
    T1 = se3.make_T(se3.Rz(np.radians(120)), [1.0, 0.0, 0.0])
    S = np.array([0.0, 0.0, 1.0, 0.5 / np.sqrt(3.0), -0.5, 0.0])  # about the middle
    assert_same(screws.exp_screw(S, np.radians(120)), T1, 1e-12)
    half = screws.exp_screw(S, np.radians(60))
    assert_same(half[:3, 3], [0.5, -0.5 / np.sqrt(3.0), 0.0], 1e-12)
    assert se3.is_pose(half)
    assert_same(lab.straight_pose(T0, T1, 0.5)[:3, 3], [0.5, 0.0, 0.0], 1e-12)
    assert says("but its origin runs along an arc")


def test_a_jump_of_acceleration_has_a_jerk_that_doubles_with_the_rate():
    T = 0.995
    at_250 = {n: followed(*w)[1] for n, w in lab.profiles(T).items()}
    at_500 = {n: followed(*w, rate=500.0)[1] for n, w in lab.profiles(T).items()}
    for name in ("constant speed", "cubic", "trapezoid"):
        assert at_500[name] / at_250[name] == pytest.approx(2.0, abs=0.2), name
    assert at_500["quintic"] / at_250["quintic"] == pytest.approx(1.0, abs=0.05)


@pytest.mark.kit
def test_the_ablations_of_the_guide_all_place_the_cube():
    rows = re.findall(r"\| ([a-z][^|]+?) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|", GUIDE)
    cases = capstone.ablations(capstone.library()).values()
    assert len(rows) == len(cases) == 6
    for (name, *typed), (fns, options) in zip(rows, cases, strict=True):
        done = capstone.pick(fns, **options)
        assert not done.failed, name
        found = (done.place_mm, done.joint_mrad, done.line_mm)
        for number, ours in zip(typed, found, strict=True):
            assert float(number) / 2 < ours < 2 * float(number), name


@pytest.mark.kit
@pytest.mark.parametrize(
    ("mass", "mu", "slips"), [(0.16, 1.0, False), (0.18, 1.0, True), (0.08, 0.3, True)]
)
def test_what_the_grip_lifts_is_as_predicted(mass, mu, slips):
    model = scenes.table_top(capstone.CUBE_XY, capstone.YAW, mass=mass)
    model.geom_friction[:, 0] = mu
    done = capstone.pick(capstone.library(), model=model)
    assert done.failed == slips
    assert (done.heaviest < mass) == slips
    told = {0.16: "a cube of 0.16 kg is put down", 0.18: "one of 0.18 kg slips out",
            0.08: "under the cube's 0.08 kg: it stays on the table"}  # fmt: skip
    assert says(told[mass])


def test_the_predictions_of_the_side_quest():
    up = trajectory.PEAK_ACCELERATION * 0.12 / 0.75**2
    assert says(f"speeds up with {up:.3f} m/s²")
    assert says(f"{lab.heaviest_cube(0.9247, 1.0, 0.0):.3f} kg at rest")
    assert says(f"and {lab.heaviest_cube(0.9247, 1.0, up):.3f} kg while")
    assert says(f"bound is {lab.heaviest_cube(0.9247, 0.3, up):.3f} kg")
    inner = scenes.PAD_POS[1] - scenes.PAD_HALF[1]  # a pad's face, from its finger
    assert says(f"each pad protrudes {1000 * inner:.1f} mm from its finger")
    assert scenes.CUBE_HALF - inner == pytest.approx(0.0185)


@pytest.mark.kit
def test_47_is_written_within_half_a_millimetre():
    written = DAY.module("letters").write(lab)
    off = np.linalg.norm(written.wanted - written.reached, axis=1)
    assert off.max() < 5e-4  # measured 2.0e-4
    assert written.torque < 0.9  # measured 0.45
    assert written.seconds < 10.0


def test_the_arm_stays_off_where_a_value_is_wrong(monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", [SCRIPT, "--no-log"])
    monkeypatch.setattr(lab, "TRIALS", 20)
    monkeypatch.setattr(lab, "heaviest_cube", lambda grip, mu, a: mu * grip / 9.81)
    assert lab.main() == 1
    said = capsys.readouterr().out
    assert "The arm stays off" in said
    assert "8. Pick" not in said
    assert simulate.SPEED_LIMITS is lab.V_MAX


# --- the inspector's tab, without a browser ---


def tab_of(name, functions, monkeypatch):
    for module in ("viser", "labkit.inspector.tab"):
        need(importlib.util.find_spec(module) is not None, f"{module}: make view")
    inspector = DAY.module("inspector")
    monkeypatch.setattr(inspector, "Robot", MagicMock())
    page = paper(panda.load("panda_nohand"), panda.READY_Q, functions)
    return inspector, getattr(inspector, name)(page)


def test_the_tab_plans_the_labs_move_with_ones_own_functions(monkeypatch):
    inspector, tab = tab_of("Plan", vars(lab), monkeypatch)
    assert_same(inspector.GOAL_Q, lab.GOAL_Q)
    tab.on_move(panda.READY_Q)
    tab.go(0.5)
    assert "0.50 of 0.995 s; at most 100% of a speed limit" in tab.numbers.content
    assert tab.own.says()[1] == "good"
    tab.sets("kind")(inspector.TRAPEZOID)
    assert "of 0.803 s" in tab.numbers.content
    tab.sets("hurry")(1.5)
    assert "150% of a speed limit" in tab.numbers.content
    assert_same(tab.q[-1], lab.GOAL_Q, 1e-12)
    assert_same(tab.qd[-1], np.zeros(7), 1e-12)
    assert tab.play(10.0) is False


def test_the_tab_shows_what_a_wrong_duration_does(monkeypatch):
    half = {"quintic_duration": lambda *args: lab.quintic_duration(*args) / 2}
    _, tab = tab_of("Plan", {**vars(lab), **half}, monkeypatch)
    tab.on_move(panda.READY_Q)
    assert "200% of a speed limit" in tab.numbers.content
    assert "quintic_duration by" in tab.own.says()[0]


def test_the_tab_plays_the_capstone_with_ones_own_functions(monkeypatch):
    inspector, tab = tab_of("Pick", vars(lab), monkeypatch)
    tab.press(inspector.PICK)
    assert tab.own.says()[1] == "good"
    assert "joint_move" in tab.own.says()[0]
    assert tab.replay(0.0)
    assert "reach" in tab.clock.content
    assert tab.replay(2.6)
    assert "carry" in tab.clock.content or "lift" in tab.clock.content, (
        tab.clock.content
    )
    assert tab.replay(20.0) is False
    assert "placed 0.9 mm from its goal" in tab.page.say.call_args.args[0]


def test_the_predictions_can_be_made_from_what_the_guide_says():
    numbers = lambda q: "(" + ", ".join(f"{x:g}" for x in np.round(q, 3)) + ")"  # noqa: E731
    assert says(f"from ready, {numbers(lab.READY_Q)}, to {numbers(lab.GOAL_Q)} rad")
    speeds = np.repeat([2.175, 2.61], [4, 3])
    assert_same(lab.V_MAX, speeds, 0.0)
    assert says("Joints 1 to 4 may do 2.175 rad/s, 5 to 7 2.61")
    assert_same(lab.A_MAX, [15, 7.5, 10, 12.5, 15, 20, 20], 0.0)
    assert says("7.5, 10, 12.5, 15, 20 and 20 rad/s²")


def test_the_code_of_the_72_yaws_finds_the_17_that_fail(capsys, monkeypatch):
    monkeypatch.syspath_prepend(str((ROOT / SCRIPT).parent))
    code = paper_code("len(fails)")
    exec(code, {})
    assert capsys.readouterr().out.startswith("17 [-175, ")
    exec(code.replace("place =", "limits[6] = -7, 7\nplace ="), {})
    assert capsys.readouterr().out == "0 []\n"


def paper_code(words):
    """Return the one block of Python in the guide that holds these words."""
    text = (ROOT / "w1-foundations/docs/day7-lab.md").read_text("utf-8")
    (code,) = (
        one for one in re.findall(r"```python\n(.*?)```", text, re.S) if words in one
    )
    return code
