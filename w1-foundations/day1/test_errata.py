"""The handout's mistakes, each reproduced, and the numbers that errata.md gives."""

import re
import subprocess
from pathlib import Path

import mujoco
import numpy as np
import pytest
from compare import assert_same
from test_day1 import lab

from conftest import ROOT
from robo47 import kinematics, panda, se3

PAGE = (ROOT / "w1-foundations/docs/errata.md").read_text("utf-8")
ERRATA = PAGE.partition("\n## Day 1\n")[2].partition("\n## ")[0]
GUIDE = (ROOT / "w1-foundations/docs/day1-lab.md").read_text("utf-8")


def pose_at(q):
    model = panda.load("panda_nohand")
    return kinematics.fk(kinematics.chain_to(model, "attachment_site"), q)


def orders_apart(q):
    T = pose_at(q)
    T_extra = se3.make_T(se3.Rz(np.pi / 4), [0.1, 0.0, 0.0])
    return np.linalg.norm((T @ T_extra)[:3, 3] - (T_extra @ T)[:3, 3])


def test_every_row_names_a_test_of_this_file():
    rows = [line for line in ERRATA.splitlines() if line.startswith("| ")][1:]
    assert len(rows) == 13
    for row in rows:
        name = row.rstrip("| ").split("`")[-1 if row.endswith("`") else -2]
        assert name in globals(), row


@pytest.mark.kit
@pytest.mark.meshes
def test_the_handouts_script_crashes_on_the_real_scene(real_panda):
    scene = mujoco.MjModel.from_xml_path(str(real_panda / "scene.xml"))
    site = mujoco.mj_name2id(scene, mujoco.mjtObj.mjOBJ_SITE, "attachment_site")
    assert site == -1
    with pytest.raises(IndexError):
        mujoco.MjData(scene).site_xpos[site]
    with pytest.raises(KeyError, match="Invalid name 'attachment_site'"):
        mujoco.MjData(scene).site("attachment_site")


def test_the_expected_height_is_that_of_the_zero_configuration(either_panda):
    assert_same(pose_at(np.zeros(7))[2, 3], 0.926, 1e-12)
    low, high = either_panda.joint("joint4").range
    assert not low <= 0.0 <= high
    home = f"{pose_at(panda.READY_Q)[2, 3]:.4f} m"
    assert home in ERRATA
    assert home in GUIDE


def test_the_distance_between_the_two_orders(either_panda):
    assert f"{orders_apart(panda.READY_Q):.4f} m at ready" in ERRATA
    assert f"{orders_apart(np.zeros(7)):.4f} m at zero" in ERRATA
    assert abs(orders_apart(panda.READY_Q) - 0.1414) > 0.1


@pytest.fixture
def wrong_pose(either_panda, monkeypatch):
    """Return the lab's chain with every quaternion read as (x, y, z, w)."""
    read = lab.quat_to_R
    monkeypatch.setattr(lab, "quat_to_R", lambda quat: read(np.roll(quat, -1)))
    return lab.compose_fk(either_panda, panda.READY_Q)


def test_a_wrong_pose_passes_the_identity_check(wrong_pose):
    assert_same(wrong_pose @ np.linalg.inv(wrong_pose), np.eye(4), 1e-10)


def test_the_wrong_pose_fails_the_comparison_with_mujoco(wrong_pose):
    distance, angle = se3.pose_distance(wrong_pose, pose_at(panda.READY_Q))
    assert distance > 0.05, "the lab guide says: in centimetres"
    assert angle > 0.1


def test_a_local_pos_is_not_a_world_position(either_panda):
    data = mujoco.MjData(either_panda)
    data.qpos[:] = panda.READY_Q
    mujoco.mj_forward(either_panda, data)
    assert_same(either_panda.body("link4").pos, [0.0825, 0.0, 0.0], 0.0)
    x, y, z = data.body("link4").xpos
    assert f"(0.0825, 0, 0) and ({x:.4f}, {y:z.0f}, {z:.4f}) at ready" in ERRATA


def test_the_viewer_never_reads_mujoco_gl():
    package = Path(mujoco.__file__).parent
    readers = {
        path.relative_to(package).as_posix()
        for path in package.rglob("*.py")
        if re.search(r"environ.*MUJOCO_GL", path.read_text("utf-8"))
    }
    assert any("gl_context" in path for path in readers), "the offscreen renderer does"
    assert not any("viewer" in path for path in readers)


def test_the_panda_alone_is_a_small_download():
    import mujoco_menagerie

    size = mujoco_menagerie.get("franka_emika_panda").download_size
    assert f"{size / 1e6:.1f} MB" in ERRATA


@pytest.mark.meshes
def test_the_handouts_path_starts_at_the_top_of_the_clone(real_panda, monkeypatch):
    monkeypatch.chdir(ROOT / "w1-foundations")
    with pytest.raises(ValueError, match="ParseXML: Error opening file"):
        mujoco.MjModel.from_xml_path("mujoco_menagerie/franka_emika_panda/scene.xml")


def test_the_identity_check_is_not_that_small(either_panda):
    data = mujoco.MjData(either_panda)
    data.qpos[:] = panda.READY_Q
    mujoco.mj_forward(either_panda, data)
    site = data.site("attachment_site")
    T = se3.make_T(site.xmat.reshape(3, 3), site.xpos)
    error = np.linalg.norm(T @ np.linalg.inv(T) - np.eye(4))
    assert 2.78e-17 < error < 1e-14


@pytest.mark.meshes
def test_there_is_no_table(real_panda):
    scene = mujoco.MjModel.from_xml_path(str(real_panda / "scene.xml"))
    on_the_world = [
        scene.body(i).name for i in range(1, scene.nbody) if scene.body_parentid[i] == 0
    ]
    assert on_the_world == ["link0"]
    assert scene.body("link0").pos[2] == 0
    assert [scene.geom(i).name for i in np.nonzero(scene.geom_bodyid == 0)[0]] == [
        "floor"
    ]


def test_the_robots_folder_is_no_repository(tmp_path):
    """Git looks for a repository upwards, so it finds the clone's."""
    git = ["git", "-C", str(tmp_path), "-c", "user.name=a", "-c", "user.email=a@b"]
    subprocess.run([*git, "init", "-q"], check=True)
    subprocess.run([*git, "commit", "-q", "--allow-empty", "-m", "kit"], check=True)
    (tmp_path / "mujoco_menagerie").mkdir()
    heads = [
        subprocess.run(
            ["git", "-C", str(tmp_path / folder), "rev-parse", "HEAD"],
            capture_output=True,
            check=True,
        ).stdout
        for folder in (".", "mujoco_menagerie")
    ]
    assert heads[0] == heads[1]
