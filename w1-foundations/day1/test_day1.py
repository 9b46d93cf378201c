"""Day 1's lab: its path and numbers, and the script as a person runs it."""

import re
import sys

import mujoco
import numpy as np
import pytest
from compare import assert_same

from conftest import ROOT, load_script
from labkit.log import read_rows
from robo47 import panda, se3, verify

SCRIPT = "w1-foundations/src/day1_transforms.py"
GUIDE = " ".join((ROOT / "w1-foundations/docs/day1-lab.md").read_text("utf-8").split())


def load_lab():
    return load_script(ROOT / SCRIPT)


lab = load_lab()


def test_the_numbers_in_the_docstrings_are_true(twin):
    model, zero = panda.load("panda_nohand"), np.zeros(7)
    above = lab.link_T(np.array([0, 0, 0.333]), np.array([1, 0, 0, 0]))
    assert_same(above[:3, 3], [0, 0, 0.333], 0.0)
    assert_same(lab.compose_fk(model, zero)[:3, 3], [0.088, 0, 0.926], 1e-12)
    assert_same(lab.link4_to_world(model, zero)[:3, 3], [0.0825, 0, 0.649], 1e-12)


# --- the reasons that the guide gives: change the cause, see the number change ---


def test_a_free_body_has_one_number_more_than_degrees_of_freedom():
    ball = "<body><freejoint/><geom size='0.1'/></body>"
    text = f"<mujoco><worldbody>{ball}</worldbody></mujoco>"
    free = mujoco.MjModel.from_xml_string(text)
    arm = panda.load("panda_nohand")
    assert (free.nq, free.nv, arm.nq, arm.nv) == (7, 6, 7, 7)
    assert "a free body has six degrees of freedom and seven numbers" in GUIDE


def test_quaternions_in_another_order_make_a_rigid_but_wrong_pose(monkeypatch, twin):
    model = panda.load("panda_nohand")
    q = panda.READY_Q
    right = lab.compose_fk(model, q)
    read = lab.quat_to_R
    monkeypatch.setattr(lab, "quat_to_R", lambda quat: read(np.roll(quat, 1)))
    wrong = lab.compose_fk(model, q)
    off = np.linalg.norm(wrong[:3, 3] - right[:3, 3])
    assert f"as (x, y, z, w), the hand is {off:.2f} m off in the ready" in GUIDE
    assert_same(wrong @ lab.inverse(wrong), np.eye(4), 1e-10)
    assert se3.is_pose(wrong)
    assert "with quaternions read as (x, y, z, w) passes them too" in GUIDE


@pytest.mark.parametrize(("degrees", "step"), [(45, 0.1), (0, 0.1), (45, 0.0)])
def test_how_far_the_two_orders_are_apart_depends_on_turn_and_step(degrees, step, twin):
    T = lab.compose_fk(panda.load("panda_nohand"), panda.READY_Q)
    T_extra = lab.make_T(lab.Rz(np.radians(degrees)), np.array([step, 0.0, 0.0]))
    apart = np.linalg.norm(np.subtract(*lab.translations_both_orders(T, T_extra)))
    assert f"{apart:.4f} m" in GUIDE
    if not step:
        radius = np.hypot(*T[:2, 3])
        assert apart == pytest.approx(2 * radius * np.sin(np.radians(22.5)))
        assert f"the hand is {radius:.4f} m from the axis of the base" in GUIDE
        T[:2, 3] = 0.0  # on that axis
        assert_same(*lab.translations_both_orders(T, T_extra), 1e-15)


def test_a_transposed_rotation_looks_right_at_ready_and_zero_only(twin):
    model = panda.load("panda_nohand")
    q = np.vstack([panda.READY_Q, np.zeros(7), verify.random_q(model, 200, 47)])
    R = np.array([lab.compose_fk(model, x)[:3, :3] for x in q])
    off = np.abs(R - np.swapaxes(R, 1, 2)).max(axis=(1, 2))
    assert off[:2].max() < 1e-8
    assert 1.9 < off[2:].max() <= 2.0
    assert "At random configurations its entries are off by up to 2" in GUIDE


@pytest.mark.parametrize(("unit", "largest"), [(1.0, 1e-14), (1000.0, 1e-11)])
def test_the_rounding_errors_grow_with_the_numbers(unit, largest, twin):
    """For the seed of the lab and another one: the cause is the size of a length."""
    model = panda.load("panda_nohand")
    model.body_pos[:] *= unit
    for seed in (lab.SEED, 1):
        errors = lab.own_errors(model, verify.random_q(model, 100, seed))
        assert largest / 100 < errors.max() < largest
    assert "with all lengths in millimetres it is about 1e-12" in GUIDE


def test_only_joints_1_to_3_move_the_origin_of_link4(twin):
    model = panda.load("panda_nohand")
    for q in (panda.READY_Q, np.zeros(7), *verify.random_q(model, 5, 1)):
        turned = [lab.link4_to_world(model, q + 0.3 * one) for one in np.eye(7)]
        moved = np.array(turned) - lab.link4_to_world(model, q)
        assert (np.linalg.norm(moved[:3, :3, 3], axis=1) > 1e-3).all()
        assert_same(moved[3:, :3, 3], np.zeros((4, 3)), 1e-12)
        assert np.abs(moved[3, :3, :3]).max() > 0.1
        assert_same(moved[4:], np.zeros((3, 4, 4)), 1e-12)
    assert "it changes with joints 1 to 3." in GUIDE


def test_a_swap_of_two_factors_moves_the_hand_usually_and_not_always(twin):
    """At ready eight pairs of neighbours commute: some rotate about one axis."""
    model = panda.load("panda_nohand")
    factors = []
    for name, joint in lab.PATH:
        body = model.body(name)
        factors.append(lab.link_T(body.pos, body.quat))
        if joint:
            angle = panda.READY_Q[model.joint(joint).qposadr[0]]
            factors.append(lab.joint_T(angle))
    right = lab.compose_fk(model, panda.READY_Q)
    moves = []
    for i in range(len(factors) - 1):
        order = [*factors[:i], factors[i + 1], factors[i], *factors[i + 2 :]]
        moves.append(np.abs(np.linalg.multi_dot(order) - right).max() > 1e-9)
    assert (len(factors), sum(moves)) == (16, 7)
    assert "If you swap two of them, you usually arrive at a different" in GUIDE


@pytest.mark.parametrize("told", [0.0, 1.0])
def test_servos_that_are_told_nothing_pull_every_joint_to_0(told, twin):
    model = panda.load("panda_nohand")
    data = mujoco.MjData(model)
    data.qpos[:] = panda.READY_Q
    data.ctrl[:] = told * panda.READY_Q
    mujoco.mj_step(model, data, 2000)
    wanted = np.clip(data.ctrl, *model.jnt_range.T)  # joint4 cannot be 0
    assert_same(data.qpos, wanted, 0.006)
    assert "`qpos` was set without `ctrl`: the servos pull every joint to 0" in GUIDE


def test_the_path_is_the_models_own(either_panda):
    names = [name for name, _ in lab.PATH]
    assert names == [either_panda.body(i).name for i in range(1, either_panda.nbody)]
    for name, joint in lab.PATH:
        body = either_panda.body(name)
        if joint:
            assert either_panda.joint(joint).bodyid[0] == body.id
            assert_same(either_panda.joint(joint).axis, [0, 0, 1], 0.0)
            assert either_panda.joint(joint).type[0] == mujoco.mjtJoint.mjJNT_HINGE
    site = either_panda.site("attachment_site")
    assert either_panda.body(int(site.bodyid[0])).name == names[-1]
    assert_same([*site.pos, *site.quat], [0, 0, 0, 1, 0, 0, 0], 0.0)


def test_importing_the_lab_prints_nothing_and_starts_nothing(capsys):
    load_lab()
    assert capsys.readouterr() == ("", "")


@pytest.mark.kit
@pytest.mark.parametrize("cwd", [ROOT, ROOT / "w1-foundations", None])
def test_the_lab_runs_from_any_folder_and_logs_nothing_if_asked(run, tmp_path, cwd):
    log = tmp_path / "metrics.csv"
    done = run(SCRIPT, "--no-log", cwd=cwd or tmp_path, ROBO47_METRICS=log)
    lines = done.stdout.splitlines()
    assert (done.returncode, done.stderr) == (0, "")
    assert lines[0].startswith("robot: Franka Panda (panda_nohand), ")
    assert lines[-1] == "All checks PASSED."
    assert max(map(len, lines)) <= 80
    assert done.stdout.count("PASS  ") == 9
    assert "nothing logged" in done.stdout
    assert not log.exists()


def test_a_run_logs_the_handouts_row_and_the_by_hand_check(run, tmp_path):
    log = tmp_path / "metrics.csv"
    for _ in range(2):
        done = run(SCRIPT, ROBO47_METRICS=log)
        assert done.returncode == 0, done.stderr
    rows = read_rows(log)
    assert len(rows) == 4
    identity, by_hand = rows[:2]
    expected = {"run_id": "day1_transforms", "day": 1, "check": "fk_identity_check"}
    expected |= {"seed": 0, "method": "manual", "n_trials": 3}
    expected |= {"n_failures": 0, "metric": "inv_err"}
    assert {k: identity[k] for k in expected} == expected
    assert 0 <= identity["value"] < 1e-10
    assert (by_hand["check"], by_hand["metric"]) == ("fk_by_hand", "max_abs_err")
    assert (by_hand["n_trials"], by_hand["seed"]) == (1_000, 47)
    assert 0 < by_hand["value"] < 1e-8


def test_the_twin_stands_in_and_the_first_line_says_so(monkeypatch, twin, capsys):
    monkeypatch.setattr(sys, "argv", ["day1", "--no-log"])
    assert lab.main() == 0
    assert "the kit's embedded twin" in capsys.readouterr().out.splitlines()[0]


@pytest.mark.kit
@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<mujoco><worldbody>", "panda_nohand.xml cannot be loaded"),
        ("<mujoco/>", "has no site:attachment_site"),
    ],
)
def test_a_model_that_is_no_panda_is_one_clear_line(run, tmp_path, text, words):
    folder = tmp_path / "franka_emika_panda"
    folder.mkdir()
    (folder / "panda_nohand.xml").write_text(text)
    done = run(SCRIPT, "--no-log", MENAGERIE_ROOT=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("error: ")
    assert words in done.stderr
    assert "Traceback" not in done.stderr
    assert "All checks PASSED" not in done.stdout


def test_a_wrong_option_explains_itself(run):
    done = run(SCRIPT, "--nolog")
    assert done.returncode == 2
    assert "unrecognized arguments: --nolog" in done.stderr


WRONG = {
    "identity": ("compose_fk", lambda right: lambda model, q, path=(): np.eye(4)),
    "transposed": ("compose_fk", lambda right: lambda *args: transposed(right(*args))),
    "Rz_swapped": ("Rz", lambda right: lambda theta: right(np.pi / 2 - theta)),
    "xyzw": ("quat_to_R", lambda right: lambda quat: right(np.roll(quat, -1))),
}


def transposed(T):
    return se3.make_T(T[:3, :3].T, T[:3, 3])


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_chain_is_named_and_cannot_record_a_small_number(
    name, monkeypatch, tmp_path, capsys
):
    wrong = load_lab()
    function, made = WRONG[name]
    monkeypatch.setattr(wrong, function, made(getattr(wrong, function)))
    monkeypatch.setattr("labkit.log.METRICS_CSV", tmp_path / "m.csv")
    monkeypatch.setattr(sys, "argv", ["day1"])
    monkeypatch.setattr(wrong, "LIBRARY_TRIALS", 10)
    assert wrong.main() == 1
    said = capsys.readouterr().out
    assert re.search(r"FAIL  largest \|by hand - MuJoCo\|: \d", said)
    assert "FAILED: largest |by hand - MuJoCo| is" in said
    assert "All checks PASSED" not in said
    _, by_hand = read_rows(tmp_path / "m.csv")
    assert by_hand["check"] == "fk_by_hand"
    assert by_hand["value"] > 0.1
    assert by_hand["n_failures"] > 900


def test_the_folded_predictions_come_from_the_files_lengths(twin):
    model = panda.load("panda_nohand")
    up = {name: abs(model.body(name).pos).max() for name in ("link1", "link3", "link4")}
    hand, half = 0.107, np.sqrt(0.5)
    assert abs(model.body("attachment").pos).max() == hand
    d1, d3, a4 = up.values()
    height = d1 + d3 * half + a4 * half + a4 - hand  # forearm level, the hand down
    T_world_ee = lab.compose_fk(model, panda.READY_Q)
    assert_same(height, T_world_ee[2, 3], 1e-3)
    assert f"- 0.107$ is {height:.3f} m" in GUIDE
    T_extra = lab.make_T(lab.Rz(np.pi / 4), np.array([0.1, 0, 0]))
    right, left = (T_world_ee @ T_extra)[:3, 3], (T_extra @ T_world_ee)[:3, 3]
    (dx, dy, _), (x, y, _) = abs(left - right), left
    assert f"{{{dx:.3f}^2 + {dy:.3f}^2}} = {np.hypot(dx, dy):.3f}" in GUIDE
    assert f"to {right[0]:.3f} m in front of the base" in GUIDE
    assert f"is added: $({x:.3f}, {y:.3f})$" in GUIDE
