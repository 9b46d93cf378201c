"""Day 2's lab: its functions against oracles; the numbers in the guide's sentences."""

import importlib.util
import re

import inprocess
import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script, need, paper
from labkit.judge import Draw
from labkit.judge.answers import degrees, matches
from labkit.judge.row import row_of
from labkit.lesson.day import find_day
from labkit.log import read_rows
from robo47 import panda, screws, se3, verify

SCRIPT = "w1-foundations/src/day2_screws.py"
GUIDE = " ".join((ROOT / "w1-foundations/docs/day2-lab.md").read_text("utf-8").split())
DAY = find_day(2)
ROULETTE = DAY.module("roulette")

LINKS = [f"body:link{i}" for i in range(1, 8)]
lab = load_script(ROOT / SCRIPT)


@pytest.fixture
def arm(either_panda):
    """Return the Panda's screws, M, and q: 0, ready, then 20 random ones."""
    q = verify.random_q(either_panda, 20, seed=47)
    q = np.vstack([np.zeros(7), panda.READY_Q, q])
    return panda.screws(either_panda), panda.home_pose(either_panda), q


def off(ours, truth):
    """Return millimetres and degrees per pose."""
    mm = 1000 * np.linalg.norm(ours[:, :3, 3] - truth[:, :3, 3], axis=1)
    return mm, degrees(truth[:, :3, :3], ours[:, :3, :3])


# --- the functions ---


def test_franka_s_table_in_the_lab_is_the_one_in_the_questions():
    assert_same(lab.FRANKA_DH, DAY.module("arms").FRANKA, 0.0)


# --- the lab ---


@pytest.mark.kit
def test_the_lab_runs_in_80_columns_and_logs_two_rows(run, tmp_path):
    log = tmp_path / "metrics.csv"
    done = run(SCRIPT, ROBO47_METRICS=log)
    lines = done.stdout.splitlines()
    assert (done.returncode, done.stderr) == (0, "")
    assert lines[-1] == "All checks PASSED."
    assert max(len(line) for line in lines if not line.startswith("logged")) <= 80
    assert done.stdout.count("PASS  ") == 10
    poe, dh = read_rows(log)
    assert (poe["check"], dh["check"]) == ("poe_by_hand", "dh_by_hand")
    for row in (poe, dh):
        assert (row["day"], row["n_trials"], row["n_failures"]) == (2, lab.TRIALS, 0)
        assert 0 < row["value"] < 1e-8


def test_what_is_wrong_on_purpose_is_right_at_zero_and_far_off_elsewhere(arm):
    S, M, q = arm
    truth = screws.fk_space(S, M, q)
    measured = {}
    for what, fk in lab.on_purpose(S, M).items():
        mm, _ = off(np.array([fk(x) for x in q]), truth)
        measured[what] = (mm[0], mm[1], np.median(mm[2:]))
    assert_same(measured.pop("no mistake"), [0, 0, 0], 1e-10)
    constant = measured.pop("M of the ready pose")
    assert_same(constant, [400.85] * 3, 0.005)
    for zero, ready, random in measured.values():
        assert zero < 1e-10
        assert min(ready, random) > 200


# --- the numbers in the guide's sentences ---


def test_the_pose_at_ready_taken_for_M_is_off_by_the_same_at_every_q(arm):
    S, M, q = arm
    truth = screws.fk_space(S, M, q)
    mm, deg = off(screws.fk_space(S, truth[1], q), truth)
    assert np.ptp(mm) < 1e-9
    assert np.ptp(deg) < 1e-9
    assert f"{mm[0]:.1f} mm and {deg[0]:.1f} degrees off at *every* q" in GUIDE


def test_mujocos_six_numbers_have_omega_first_and_its_free_joint_v_first():
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><body name='a'><freejoint/><geom size='0.1'/></body>"
        "</worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    v, omega = [1, 2, 3], [4, 5, 6]
    data.qvel = [*v, *omega]
    mujoco.mj_forward(model, data)
    of_the_object = np.empty(6)
    body = mujoco.mjtObj.mjOBJ_BODY
    mujoco.mj_objectVelocity(model, data, body, model.body("a").id, of_the_object, 0)
    jacp, jacr = np.zeros((2, 3, 6))
    mujoco.mj_jacBody(model, data, jacp, jacr, model.body("a").id)
    assert_same(data.cvel[1], [*omega, *v], 1e-15)
    assert_same(of_the_object, [*omega, *v], 1e-15)
    assert_same(jacp @ data.qvel, v, 1e-15)
    assert_same(jacr @ data.qvel, omega, 1e-15)
    data.qpos[3:7] = np.sqrt([0.5, 0.5, 0.0, 0.0])  # rolled by a quarter turn
    mujoco.mj_forward(model, data)
    assert_same(data.cvel[1, :3], screws.exp_rotation([1, 0, 0], np.pi / 2) @ omega)
    assert r"its $\omega$ is expressed in the *body* frame" in GUIDE
    says = (
        "Twists and screws are (omega; v), as in *Modern Robotics* and MuJoCo's `cvel`"
    )
    assert says in screws.__doc__


@pytest.mark.parametrize("mass_at", [0.0, 0.5])
def test_the_v_of_cvel_is_that_of_the_centre_of_mass(mass_at):
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><body name='a' pos='1 0 0'><joint axis='0 0 1'/>"
        f"<geom size='0.1' pos='{mass_at} 0 0'/></body></worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    of_the_object = np.empty(6)
    data.qvel[0] = 1.0
    mujoco.mj_forward(model, data)
    assert_same(data.cvel[1], [0, 0, 1, 0, mass_at, 0], 1e-15)
    for kind, x in (("mjOBJ_BODY", mass_at), ("mjOBJ_XBODY", 0.0)):
        kind = getattr(mujoco.mjtObj, kind)
        mujoco.mj_objectVelocity(model, data, kind, 1, of_the_object, 0)
        assert_same(of_the_object, [0, 0, 1, 0, x, 0], 1e-15)
    assert "For `cvel` this point is the centre of mass of the whole tree" in GUIDE


def test_the_moment_of_a_line_changes_across_it_and_not_along_it():
    omega, p = np.array([0.0, 0.6, 0.8]), np.array([0.3, -0.2, 0.5])
    v = lab.screw_axis(omega, p)[3:]
    assert_same(lab.screw_axis(omega, p + 0.7 * omega)[3:], v, 1e-15)
    across = lab.screw_axis(omega, p + np.array([0.1, 0, 0]))[3:] - v
    assert np.linalg.norm(across) == pytest.approx(0.1)
    assert "at right angles to the line by 0.1 m, $v$ changes by 0.1 m/s" in GUIDE


@pytest.mark.parametrize("pitch", [0.0, 0.02])
def test_a_screw_with_a_pitch_moves_along_its_axis(pitch):
    omega, p = np.array([0.0, 0.6, 0.8]), np.array([0.3, -0.2, 0.5])
    S = lab.screw_axis(omega, p)
    S[3:] += pitch * omega
    T = lab.exp_screw(S, 2 * np.pi)
    assert_same(T[:3, 3], 2 * np.pi * pitch * omega, 1e-12)
    assert r"moves the body along the axis by $2 \pi h$" in GUIDE


def test_at_zero_a_row_for_a_column_is_the_same_for_four_links(arm, either_panda):
    q = np.vstack([np.zeros(7), arm[2][2:]])
    poses = verify.mujoco_poses(either_panda, q)
    R = np.array([poses[link][:, :3, :3] for link in LINKS])
    same = np.isclose(R[:, :, 2], R[..., 2], atol=1e-9).all(axis=-1)
    symmetric = np.isclose(R, np.swapaxes(R, 2, 3), atol=1e-9).all(axis=(2, 3))
    assert (same[:, 0] == symmetric[:, 0]).all()
    assert same[:, 0].sum() == 4
    assert not same[1:, 1:].any()  # link1 turns about the vertical alone
    assert "the rotation matrix is symmetric for four of the seven links" in GUIDE


def test_the_cube_of_a_bracket_is_its_negative_for_length_1_only():
    K = lab.skew(np.array([0.0, 0.6, 0.8]))
    assert_same(K @ K @ K, -K, 1e-15)
    assert np.abs(8 * K @ K @ K + 2 * K).max() > 1  # of twice that length


@pytest.mark.kit
def test_how_many_named_mistakes_are_exact_at_zero(arm):
    S, M, q = arm
    truth = screws.fk_space(S, M, q)
    row = row_of(DAY, "fk_space")
    asked = row.ask.inputs(Draw(lab.SEED))
    exact = wrong = 0
    with np.errstate(all="ignore"):
        # Some have two names: one joint's wrong angle is the product at a wrong q.
        told = [np.array([way.code(*args) for args in asked]) for way in row.named]
        for i, way in enumerate(row.named):
            if any(matches(told[i], other) for other in told[:i]):
                continue
            error = np.abs([way.code(S, M, x) for x in q] - truth).max(axis=(1, 2))
            if np.median(error[2:]) > 1e-6:  # some are none on the Panda
                wrong = wrong + 1
                exact = exact + int(error[0] < 1e-12)
    says = f"recognises about {round(wrong, -1)} mistakes in `fk_space`. With about "
    says += f"{round(exact, -1)} of them, the result at q = 0 is exact"
    assert says in GUIDE


def test_the_wrong_adjoint_hides_in_the_symmetric_M(arm):
    S, M, q = arm
    assert_same(M[:3, :3], M[:3, :3].T, 1e-15)
    B = S @ screws.adjoint(M).T
    assert_same(B[:, :3], screws.body_screws(S, M)[:, :3], 1e-15)
    mm, deg = off(screws.fk_body(B, M, q), screws.fk_space(S, M, q))
    says = f"configurations is {np.median(mm[2:]):.0f} mm, and the rotation is exact"
    assert f"the median position error over 20 random {says}" in GUIDE
    assert deg.max() < 1e-5


@pytest.mark.parametrize(("turn", "hides"), [(se3.Rx, False), (se3.Rz, True)])
def test_the_wrong_adjoint_does_not_hide_in_a_tilted_tool(arm, turn, hides):
    S, M, q = arm
    M = M @ se3.make_T(turn(0.3), np.zeros(3))
    B = S @ screws.adjoint(M).T
    mm, deg = off(screws.fk_body(B, M, q), screws.fk_space(S, M, q))
    if hides:
        assert deg.max() < 1e-5
        assert f"error is {np.median(mm[2:]):.0f} mm instead of 88 mm." in GUIDE
    else:
        assert f"rotation error is {np.median(deg[2:]):.0f} degrees and" in GUIDE
        assert f"position error is {np.median(mm[2:]):.0f} mm, because the" in GUIDE


def test_the_readings_of_one_table_are_as_far_off_as_the_guide_says(either_panda):
    q = verify.random_q(either_panda, 20, seed=47)
    found = ROULETTE.distances(lab.FRANKA_DH, q).values()
    medians = [round(1000 * float(np.median(x))) for x in found]
    assert medians == [885, 755, 733, 107, 0]
    table = GUIDE.partition("| reading of the table")[2].partition("## Step 7")[0]
    assert [int(n) for n in re.findall(r"\| (\d+) mm \|", table)] == medians
    *_, early, right = list(found)
    assert np.ptp(1000 * early) < 1e-9
    assert_same(right, np.zeros(20), 0.0)


def medians(made, seeds=range(12)):
    """Return the smallest and the largest median over other random configurations."""
    model = panda.load("panda_nohand")
    found = [np.median(made(verify.random_q(model, 20, seed))) for seed in seeds]
    return min(found), max(found)


def test_the_medians_of_twelve_other_seeds_are_those_of_the_guide(arm):
    S, M, _ = arm

    def adjoint_of_M(R, part):
        tilted = M @ se3.make_T(R, np.zeros(3))
        B = S @ screws.adjoint(tilted).T

        def error(q):
            right = screws.fk_space(S, tilted, q)
            return off(screws.fk_body(B, tilted, q), right)[part]

        return "{:.0f} to {:.0f}".format(*medians(error))

    tilt = se3.Rx(0.3)
    assert f"seeds the median is {adjoint_of_M(np.eye(3), 0)} mm." in GUIDE
    mm, deg = (adjoint_of_M(tilt, part) for part in (0, 1))
    assert f"seeds the medians are {deg} degrees and {mm} mm." in GUIDE
    readings = [
        medians(lambda q, name=name: 1000 * ROULETTE.distances(lab.FRANKA_DH, q)[name])
        for name in list(ROULETTE.READINGS)[:3]
    ]
    first, second, third = (f"{low:.0f} to {high:.0f}" for low, high in readings)
    assert f"medians are {first}, {second} and {third} mm." in GUIDE


@pytest.mark.parametrize("row", range(8))
@pytest.mark.parametrize("column", [1, 2], ids=["a", "d"])
def test_a_wrong_length_of_any_link_gives_the_same_distance_everywhere(row, column):
    """So a constant distance is no proof that the tool is wrong."""
    q = verify.random_q(panda.load("panda_nohand"), 20, seed=48)
    table = lab.FRANKA_DH.copy()
    table[row, column] += 0.05
    right = screws.dh_fk(lab.FRANKA_DH, q)
    error = screws.dh_fk(table, q)[:, :3, 3] - right[:, :3, 3]
    assert_same(1000 * np.linalg.norm(error, axis=1), np.full(20, 50.0), 1e-9)
    in_the_hand = (np.swapaxes(right[:, :3, :3], 1, 2) @ error[:, :, None])[..., 0]
    constant = np.ptp(in_the_hand, axis=0).max() < 1e-9
    assert constant == ((row, column) in {(7, 1), (7, 2), (6, 2)})
    assert "The error is 50.0 mm at every configuration, for *every* row." in GUIDE


def test_a_shifted_base_is_constant_in_the_world_and_a_wrong_angle_nowhere(arm):
    S, M, _ = arm
    q = verify.random_q(panda.load("panda_nohand"), 50, seed=5)
    right = screws.fk_space(S, M, q)
    base = se3.make_T(np.eye(3), [0.1, 0.0, 0.0]) @ right
    assert np.ptp(base[:, :3, 3] - right[:, :3, 3], axis=0).max() < 1e-12
    mm, _ = off(screws.fk_space(S, M, q + 0.05 * np.eye(7)[3]), right)
    says = "0.05 rad at joint 4 moves the flange by"
    assert f"{says} {mm.min():.1f} to {mm.max():.1f} mm." in GUIDE
    mm, _ = off(screws.fk_space(S, M, q + 0.05 * np.eye(7)[5]), right)
    assert np.ptp(mm) < 1e-9
    assert f"For joint 6 it is {mm[0]:.1f} mm everywhere" in GUIDE


@pytest.mark.parametrize(("joint", "rank"), [(None, 5), (0, 5), (1, 6), (2, 5)])
def test_the_lost_motion_comes_back_when_the_three_lines_part(arm, joint, rank):
    """Joint 2 alone moves lines 3 and 5 away from line 1; 1 and 3 move none of them."""
    S, _, _ = arm
    q = np.zeros(7) if joint is None else 0.3 * np.eye(7)[joint]
    moved = [
        screws.adjoint(screws.fk_space(S[:i], np.eye(4), q[:i])) @ S[i]
        for i in range(1, 7)
    ]
    found = np.linalg.matrix_rank([S[0], *moved], tol=1e-9)
    assert found == rank


def test_the_files_rounded_quaternion_is_not_quite_135_degrees(either_panda):
    q = verify.random_q(either_panda, 20, seed=47)
    truth = verify.mujoco_poses(either_panda, q)["site:attachment_site"]
    ours = screws.dh_fk(lab.FRANKA_DH, q)
    ours[:, :3, :3] = ours[:, :3, :3] @ se3.Rz(0.75 * np.pi)
    assert_same(ours[:, :3, 3], truth[:, :3, 3], 1e-14)
    assert f"{np.abs(ours - truth).max():.1e}".replace("e-0", "e-") in GUIDE


def test_the_lost_motion_at_zero_is_the_turn_about_x(arm):
    S, _, _ = arm
    assert np.linalg.matrix_rank(S) == 5
    assert_same(S[:, 0], np.zeros(7), 0.0)
    assert_same(S[[0, 2, 4]], np.tile(S[0], (3, 1)), 0.0)


@pytest.mark.kit
def test_the_picture_shows_lines_and_lengths_and_no_answer(monkeypatch):
    need(importlib.util.find_spec("matplotlib") is not None, "matplotlib: make figures")
    monkeypatch.syspath_prepend(str(DAY.source.parent))
    figures = DAY.module("figures")
    words = set()
    write = lambda layer, at, text, *rest: words.add(text)  # noqa: E731
    name = lambda layer, text, *rest: words.add(text)  # noqa: E731
    monkeypatch.setattr(figures.Layer, "text", write)
    monkeypatch.setattr(figures.Layer, "label", name)
    monkeypatch.setattr(figures.client, "draw", lambda scene: np.zeros((9, 9, 3), "u1"))
    monkeypatch.setattr(figures.Layer, "over", lambda layer, picture: picture)
    figures.screws()
    lengths = {"0.333", "0.316", "0.384", "0.0825", "0.088"}
    assert words == {*(f"S{i}" for i in range(1, 8)), *lengths, "x", "y"}


# --- where in the product it is wrong ---

space = DAY.module("products").space
ORDER = [0, 2, 1, 3, 4, 5, 6]
ONE_BY_ONE = {
    "wrong for negative angles of joint2 and joint4.": lambda S, M, q: space(
        S, M, np.where([0, 1, 0, 1, 0, 0, 0], abs(q), q)
    ),
    "your pose is wrong for joint2, joint4 and joint6.": lambda S, M, q: space(
        S, M, q * [1, 2, 1, 2, 1, 2, 1]
    ),
    "The exponentials of joint2 and joint3 are swapped": lambda S, M, q: space(
        S[ORDER], M, q[ORDER]
    ),
}


@pytest.mark.kit
@pytest.mark.parametrize("says", ONE_BY_ONE)
def test_joints_are_asked_for_one_at_a_time_both_ways(says):
    instead = {"fk_space": ONE_BY_ONE[says]}
    assert (
        says
        in inprocess.verdicts(DAY, DAY.source, "2.6", instead=instead)["2.6"].message
    )


# --- the inspector's tab, without a browser ---


@pytest.mark.kit
def test_the_tab_applies_one_exponential_at_a_time():
    for module in ("viser", "labkit.inspector.tab"):
        need(importlib.util.find_spec(module) is not None, f"{module}: make view")
    inspector = DAY.module("inspector")
    model = panda.load("panda_nohand")
    page = paper(model, panda.READY_Q, vars(lab))
    tab = inspector.Screws(page)
    tab.on_move(page.q)
    assert "Applied: M. Your hand is 401 mm" in tab.verdict.content
    press = tab.sets("does", "press")
    for _ in range(3):
        press(inspector.NEXT)
    assert "Applied: e^[S5] e^[S6] e^[S7] M." in tab.verdict.content
    press(inspector.WHOLE)
    assert "Your hand is 0 mm from its pose at q." in tab.verdict.content
    assert tab.own.says()[1] == "good"
    press(inspector.BACK)
    assert "Applied: e^[S2]" in tab.verdict.content
    tab.sets("roulette", "spin")(True)
    assert tab.verdict.content.count(" mm, ") == 5
    assert "your dh_fk, the sphere: 0 mm" in tab.verdict.content
    questions = inspector.GHOST.questions(model, page.q)
    assert len(questions) == len(inspector.GHOST.frames) == 8
    for args, name in zip(questions, inspector.GHOST.frames, strict=True):
        frame = "site:attachment_site" if name == "ee" else f"body:{name}"
        pose = verify.mujoco_poses(model, page.q[None])[frame][0]
        assert_same(lab.fk_space(*args), pose, 1e-14)


def test_the_folded_answers_on_paper_are_the_arms_screws():
    seven = panda.screws(panda.load("panda_nohand"))
    assert_same(seven[1], [0, 1, 0, -0.333, 0, 0], 1e-9)
    assert_same(seven[3], [0, -1, 0, 0.649, 0, -0.0825], 1e-9)
    assert_same(seven[[0, 2, 4]], np.tile([0, 0, 1, 0, 0, 0], (3, 1)), 1e-9)
    assert not seven[:, 0].any()  # no turn about x, and it is the rank that is lost
    assert np.linalg.matrix_rank(seven) == np.linalg.matrix_rank(seven[:, 1:]) == 5
    for answer in ("= (-0.333, 0, 0)$", "= (0.649, 0, -0.0825)$"):
        assert answer in GUIDE
