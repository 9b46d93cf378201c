"""The robot: real and embedded, its entries, its configurations, its provenance."""

import json
import re
import shutil

import mujoco
import numpy as np
import pytest
from compare import assert_same

from robo47 import kinematics, panda, se3, simulate, verify
from robo47.errors import Robo47Error
from robo47.panda import files as menagerie


def real_and_twin(monkeypatch, entry, **options):
    """Return a model from the Menagerie's files and the same from the twin."""
    real = panda.load(entry, **options)
    with monkeypatch.context() as patch:
        patch.setattr(menagerie, "panda_folder", lambda: None)
        return real, panda.load(entry, **options)


@pytest.mark.meshes
@pytest.mark.parametrize("entry", ["panda", "panda_nohand"])
def test_every_frame_of_the_twin_is_the_menageries(real_panda, monkeypatch, entry):
    real, twin = real_and_twin(monkeypatch, entry)
    q = verify.random_q(real, 1000, seed=47)
    worst = verify.worst_difference(
        verify.mujoco_poses(twin, q), verify.mujoco_poses(real, q), q
    )
    assert worst.error < 1e-12, worst


@pytest.mark.meshes
@pytest.mark.parametrize("entry", menagerie.ENTRIES)
def test_the_twin_has_the_menageries_joints_masses_drives_and_home(
    real_panda, monkeypatch, entry
):
    real, twin = real_and_twin(monkeypatch, entry)
    assert kinematics.frame_names(twin) == kinematics.frame_names(real)
    for name in ("jnt_range", "jnt_axis", "body_mass", "body_ipos", "body_inertia"):
        assert_same(getattr(twin, name), getattr(real, name), 1e-12)
    assert_same(panda.home_q(twin), panda.home_q(real), 0.0)
    for name in (
        "gainprm", "biastype", "biasprm", "ctrlrange", "forcerange", "trntype"
    ):  # fmt: skip
        field = f"actuator_{name}"
        assert_same(getattr(twin, field), getattr(real, field), 0.0)
    assert_same(twin.key_ctrl, real.key_ctrl, 0.0)
    assert twin.opt.impratio == real.opt.impratio


def motion(model, n):
    """Return n random (q, qd, ctrl): |qd| up to 2 rad/s, ctrl over its whole range."""
    rng = np.random.default_rng(4)
    q = verify.random_q(model, n, seed=4)
    qd = rng.uniform(-2.0, 2.0, q.shape)
    ctrl = rng.uniform(*model.actuator_ctrlrange.T, (n, model.nu))
    return zip(q, qd, ctrl, strict=True)


@pytest.mark.meshes
@pytest.mark.parametrize("drive", panda.DRIVES)
@pytest.mark.parametrize("entry", menagerie.ENTRIES)
def test_the_twin_moves_as_the_menageries_robot_does(
    real_panda, monkeypatch, entry, drive
):
    models = real_and_twin(monkeypatch, entry, drive=drive)
    pair = [(model, mujoco.MjData(model)) for model in models]
    for q, qd, ctrl in motion(models[0], 200):
        found = []
        for model, data in pair:
            mujoco.mj_resetData(model, data)
            data.qpos, data.qvel, data.ctrl = q, qd, ctrl
            mujoco.mj_step(model, data)
            M = np.empty((model.nv, model.nv))
            for i, unit in enumerate(np.eye(model.nv)):
                mujoco.mj_mulM(model, data, M[i], unit)
            found.append((M, data.qfrc_bias.copy(), data.qvel.copy(), data.qpos.copy()))
        for real, twin in zip(*found, strict=True):
            assert_same(twin, real, 1e-12)


def test_a_torque_drive_gives_the_joints_what_ctrl_says(either_panda):
    model = panda.load("panda_nohand", drive="torque")
    data = mujoco.MjData(model)
    data.qpos, data.qvel = panda.READY_Q, 1.5
    data.ctrl = wanted = [10.0, -86.0, 3.0, 20.0, -11.0, 0.5, 0.0]
    mujoco.mj_forward(model, data)
    assert_same(data.qfrc_actuator, wanted, 0.0)
    data.ctrl = 1000.0
    mujoco.mj_forward(model, data)
    assert_same(data.qfrc_actuator, [87.0] * 4 + [12.0] * 3, 0.0)


def test_the_torque_drive_rests_at_home_without_torque(either_panda):
    model = panda.load("panda", drive="torque")
    assert_same(model.key("home").ctrl, [0.0] * 7 + [255.0], 0.0)
    assert_same(panda.home_q(model), panda.home_q(panda.load("panda")), 0.0)


def test_the_hand_keeps_its_servo_on_a_torque_driven_arm(either_panda):
    servo, torque = panda.load("panda"), panda.load("panda", drive="torque")
    for name in ("gainprm", "biasprm", "ctrlrange", "forcerange"):
        before, after = (getattr(m, f"actuator_{name}") for m in (servo, torque))
        assert_same(after[7], before[7], 0.0)
        assert np.any(after[:7] != before[:7]) == (name != "forcerange")


def test_an_edit_comes_after_the_drive(either_panda):
    def stronger(spec):
        for actuator in spec.actuators:
            assert actuator.biasprm[1] == 0.0, "already a motor"
            actuator.forcerange = actuator.ctrlrange = [-200.0, 200.0]

    model = panda.load("panda_nohand", drive="torque", edit=stronger)
    assert_same(model.actuator_ctrlrange, [[-200.0, 200.0]] * 7, 0.0)


@pytest.mark.meshes
@pytest.mark.parametrize("entry", menagerie.ENTRIES)
def test_dropping_the_meshes_does_not_change_the_kinematics(real_panda, entry):
    whole, bare = panda.load(entry, meshes=True), panda.load(entry)
    assert whole.nmesh > 40
    assert bare.nmesh == bare.ngeom == 0
    q = verify.random_q(whole, 200, seed=47)
    ours, theirs = verify.mujoco_poses(bare, q), verify.mujoco_poses(whole, q)
    assert verify.worst_difference(ours, theirs, q).error == 0.0
    assert_same(bare.body_mass, whole.body_mass, 0.0)


def test_the_entries_have_the_ends_that_the_menagerie_gives_them(either_panda):
    assert kinematics.chain_to(either_panda, "attachment_site").nq == 7
    with_hand = panda.load("panda")
    assert with_hand.nq == 9
    assert with_hand.nsite == 0, "panda.xml has no site: the handout's first mistake"
    assert "body:hand" in kinematics.frame_names(panda.load("scene"))


def test_hand_and_attachment_site_are_one_point_half_a_turn_apart(twin):
    nohand, hand = panda.load("panda_nohand"), panda.load("panda")
    q = verify.random_q(nohand, 10, seed=2)
    T_ee = kinematics.fk(kinematics.chain_to(nohand, "attachment_site"), q)
    q_hand = np.hstack([q, np.zeros((10, 2))])
    T_hand = kinematics.fk(kinematics.chain_to(hand, "hand"), q_hand)
    assert_same(T_ee, T_hand @ np.diag([-1.0, -1.0, 1.0, 1.0]), 1e-7)


def test_ready_is_within_the_limits_and_zero_is_not(either_panda):
    low, high = either_panda.jnt_range.T
    assert np.all((low < panda.READY_Q) & (high > panda.READY_Q))
    assert np.flatnonzero((low > 0) | (high < 0)) == either_panda.joint("joint4").id


def test_home_is_the_models_own_rounded_key(either_panda):
    rounded = [0, 0, 0, -1.57079, 0, 1.57079, -0.7853]
    assert_same(panda.home_q(either_panda), rounded, 0.0)
    panda.home_q(either_panda)[0] = 9.0
    assert panda.home_q(either_panda)[0] == 0.0


def test_a_shared_configuration_cannot_be_changed_by_accident():
    with pytest.raises(ValueError, match="read-only"):
        panda.READY_Q[0] = 1.0


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"drive": "position"}, "has servo and torque"),
        ({"entry": "panda_no_hand"}, "has panda, panda_nohand, scene"),
    ],
)
def test_what_the_panda_has_not_is_refused_with_what_it_has(asked, words):
    with pytest.raises(ValueError, match=words):
        panda.load(**asked)


@pytest.mark.parametrize(
    ("read", "words"),
    [
        (panda.home_q, "no keyframe `home`"),
        (panda.inertias, "no joint1 to joint7"),
        (panda.screws, "no joint1 to joint7"),
        (panda.home_pose, "no site:attachment_site and no body:hand"),
        (lambda model: simulate.start(model, panda.READY_Q), "no joint1 to joint7"),
    ],
)
def test_a_model_that_is_no_panda_is_refused_in_one_line(read, words):
    empty = mujoco.MjModel.from_xml_string("<mujoco/>")
    with pytest.raises(Robo47Error, match=f"{words}.*; load the Panda"):
        read(empty)


def test_the_first_line_names_robot_source_and_version_in_80_columns(real_panda):
    line = panda.describe("panda_nohand")
    assert re.search(
        r"Franka Panda \(panda_nohand\), .+, (commit|sha256) \w{7,8}$", line
    )
    assert len(line) <= 80


def test_the_twin_says_that_it_is_one(twin):
    assert "the kit's embedded twin" in panda.describe()
    assert panda.provenance()["commit"] is None


@pytest.fixture
def broken(tmp_path, monkeypatch):
    """A Menagerie whose panda_nohand.xml holds the text that is given."""
    monkeypatch.setenv("MENAGERIE_ROOT", str(tmp_path))
    folder = tmp_path / menagerie.PANDA
    folder.mkdir()
    return folder / "panda_nohand.xml"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<mujoco><worldbody>", "cannot be loaded"),
        ("<mujoco><worldbody/></mujoco>", "has no site:attachment_site"),
        ("<mujoco><include file='gone.xml'/></mujoco>", "cannot be loaded"),
        ("<mujoco><include file='bad.xml'/></mujoco>", "be loaded: bad.xml: "),
        (b"\xff\xfe\x00", "cannot be loaded"),
        (None, "is not there"),
    ],
)
def test_a_broken_file_is_named_with_what_to_do(broken, text, words):
    broken.with_name("bad.xml").write_text("<mujoco>")
    if text is not None:
        broken.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(Robo47Error, match=words) as caught:
        panda.load("panda_nohand")
    assert "panda_nohand.xml" in str(caught.value)
    assert "unset MENAGERIE_ROOT" in str(caught.value)
    assert "Delete" not in str(caught.value)  # a folder of the user's own
    assert "\n" not in str(caught.value)


def test_a_menagerie_root_that_leads_nowhere_is_an_error_not_the_twin(
    tmp_path, monkeypatch
):
    monkeypatch.setenv("MENAGERIE_ROOT", str(tmp_path / "nowhere"))
    with pytest.raises(Robo47Error, match="nowhere has no folder franka_emika_panda"):
        panda.load()


def test_a_robot_edited_since_it_was_fetched_says_so(tmp_path, monkeypatch, real_panda):
    shutil.copytree(real_panda, tmp_path / menagerie.PANDA)
    files = menagerie.hash_files(tmp_path / menagerie.PANDA)
    record = {"source": "genesis-world 1.4.5", "commit": None, "files": files}
    (tmp_path / "PROVENANCE.json").write_text(json.dumps(record))
    monkeypatch.setenv("MENAGERIE_ROOT", str(tmp_path))
    assert "sha256" in panda.describe()
    xml = tmp_path / menagerie.PANDA / "panda_nohand.xml"
    xml.write_text(xml.read_text().replace("0.333", "0.334"))
    assert panda.describe().endswith("genesis-world 1.4.5, edited since it was fetched")


def test_the_inertias_are_the_files_in_the_links_own_axes(either_panda):
    masses, coms, inertias = panda.inertias(either_panda)
    assert (masses.shape, coms.shape, inertias.shape) == ((7,), (7, 3), (7, 3, 3))
    # link1 and link7 as the file writes them: xx yy zz xy xz yz. MuJoCo 3.3.0 keeps
    # its inertias to 5e-7 only.
    for link, mass, com, (xx, yy, zz, xy, xz, yz) in (
        (0, 4.970684, [0.003875, 0.002081, -0.04762],
         (0.70337, 0.70661, 0.0091170, -0.000139, 0.006772, 0.019169)),
        (6, 0.735522, [0.010517, -0.004252, 0.061597],
         (0.012516, 0.010027, 0.004815, -0.000428, -0.001196, -0.000741)),
    ):  # fmt: skip
        assert masses[link] == mass
        assert_same(coms[link], com, 0.0)
        written = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        assert_same(inertias[link], written, 1e-6)


def test_the_inertias_are_copies_and_those_of_the_arm_alone(either_panda):
    with_hand = panda.load("panda")
    for alone, carrying in zip(
        panda.inertias(either_panda), panda.inertias(with_hand), strict=True
    ):
        assert_same(alone, carrying, 0.0)
    panda.inertias(with_hand).masses[:] = 0.0
    assert panda.inertias(with_hand).masses[0] > 4.0


def test_the_hand_is_one_body_of_hand_and_fingers(either_panda):
    """The hand at the wrist's end, its fingers apart: by hand, in the hand's axes."""
    mass, com, inertia = panda.hand_inertia(panda.load("panda"), opening=0.02)
    R = se3.Rz(-np.pi / 4)[:3, :3]
    com_hand = np.array([0.73 * -0.01, 0.0, 0.73 * 0.03 + 0.03 * 0.0584]) / 0.76
    fingers = 2 * np.diag([2.375e-6, 2.375e-6, 7.5e-7])
    spread = np.diag([0.001, 0.0025, 0.0017]) + fingers
    for m, at in (
        (0.73, [-0.01, 0.0, 0.03]),
        (0.015, [0.0, 0.02, 0.0584]),
        (0.015, [0.0, -0.02, 0.0584]),
    ):
        d = np.array(at) - com_hand
        spread += m * (d @ d * np.eye(3) - np.outer(d, d))
    assert mass == pytest.approx(0.76, abs=1e-15)
    assert_same(com, R @ com_hand + [0.0, 0.0, 0.107], 1e-8)
    assert_same(inertia, R @ spread @ R.T, 1e-9)


def test_an_arm_without_a_hand_carries_nothing(either_panda):
    mass, com, inertia = panda.hand_inertia(either_panda)
    assert mass == 0.0
    assert_same(com, np.zeros(3), 0.0)
    assert_same(inertia, np.zeros((3, 3)), 0.0)
