"""Pictures: drawn with every backend, and the frames where the links are."""

import os
import sys

import mujoco
import numpy as np
import pytest
from pictures import count, differing, pixels

from conftest import load_script
from labkit import figures
from labkit.figures import backends
from labkit.figures.scene import FOVY, Camera, Ghost, Scene
from labkit.lesson.day import find_day
from robo47 import panda
from robo47.errors import Robo47Error

if not os.environ.get("ROBO47_CI"):
    pytest.importorskip("PIL", reason="needs Pillow: make figures")
    pytest.importorskip("matplotlib", reason="needs matplotlib: make figures")

from PIL import Image

from labkit.figures import client, overlay, portrait, studio

pytestmark = pytest.mark.kit

SMALL = (300, 200)
AXIS_COLOURS = (overlay.X, overlay.Y, overlay.Z)


def draws(test):
    """Mark a test that needs a backend."""
    return pytest.mark.gl(pytest.mark.usefixtures("gl")(test))


@pytest.fixture(scope="module", autouse=True)
def own_memory(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(backends, "ROOT", tmp_path_factory.mktemp("gl"))
        yield
    client.close()


@pytest.fixture
def fresh_start():
    client.close()
    yield
    client.close()


@pytest.mark.gl
@pytest.mark.usefixtures("fresh_start")
@pytest.mark.parametrize("backend", ["egl", "osmesa"])
def test_every_backend_draws_the_robot_on_a_dark_ground(monkeypatch, request, backend):
    monkeypatch.setenv("MUJOCO_GL", backend)
    request.getfixturevalue("gl")
    picture = figures.render_panda(panda.READY_Q, SMALL, frames=False)
    assert picture.size == SMALL
    grey = pixels(picture).mean(axis=2)
    assert np.median(grey) < 60  # the room
    assert (grey > 150).sum() > 500  # the arm


# In this order the process that draws loads the robot three times: it keeps two.
@draws
def test_frames_are_drawn_in_the_three_colours_and_only_on_request():
    plain = figures.render_panda(panda.READY_Q, frames=False)
    framed = figures.render_panda(panda.READY_Q)
    for colour in AXIS_COLOURS:
        assert count(plain, colour) < 20
        assert count(framed, colour) > 500


@draws
def test_drawing_changes_nothing_in_this_process():
    before = dict(os.environ)
    figures.render_panda(panda.READY_Q, SMALL)
    assert dict(os.environ) == before


@draws
def test_the_hand_is_drawn_where_its_frame_says_it_is():
    q, camera = portrait.with_fingers(panda.READY_Q), Camera()
    tinted = Scene(q, SMALL, camera, (Ghost("hand", np.eye(4)),), fast=True)
    plain = client.draw(Scene(q, SMALL, camera, fast=True)).astype(int)
    y, x = np.nonzero(np.abs(client.draw(tinted) - plain).max(axis=2) > 30)
    T_world_ee = portrait.link_frames(q)["ee"]  # the hand's origin and z axis too
    p_world_middle = T_world_ee[:3, 3] + 0.05 * T_world_ee[:3, 2]
    expected = camera.project(p_world_middle, SMALL)[:2]
    assert len(x) > 100
    assert np.linalg.norm([x.mean(), y.mean()] - expected) < 5  # of 300 pixels


def test_the_frame_that_is_drawn_is_the_one_whose_matrix_the_lab_prints(
    monkeypatch, capsys
):
    T_world_ee = portrait.link_frames(portrait.with_fingers(panda.READY_Q))["ee"]
    monkeypatch.setattr(sys, "argv", ["day1_transforms.py", "--no-log"])
    load_script(find_day(1).source).main()
    step = capsys.readouterr().out.split("\n2. ")[1].split("\n3. ")[0]
    printed = [line.split() for line in step.splitlines() if line.startswith("    ")]
    np.testing.assert_allclose(T_world_ee, np.float64(printed[:4]), atol=1e-6)


@pytest.mark.parametrize("q", [panda.READY_Q, np.zeros(7), np.full(7, 0.5)])
@pytest.mark.parametrize("azimuth", [118.0, 58.0, -30.0])
def test_the_whole_arm_is_in_the_picture(q, azimuth):
    poses = portrait.link_frames(portrait.with_fingers(q))
    points = portrait.corners(poses)
    camera = Camera(azimuth=np.radians(azimuth)).stepped_back(points, SMALL)
    pixels = camera.project(points, SMALL)[:, :2]
    assert (pixels > 0).all()
    assert (pixels < SMALL).all()


@draws
def test_a_preview_shows_the_same_arm_without_its_shadow():
    full = figures.render_panda(panda.READY_Q, SMALL, frames=False)
    fast = figures.render_panda(panda.READY_Q, SMALL, frames=False, fast=True)
    assert 0.005 < differing(full, fast) < 0.2


@draws
def test_the_fingers_may_be_left_out_or_given():
    arm = figures.render_panda(panda.READY_Q, SMALL, fast=True)
    opened = figures.render_panda([*panda.READY_Q, 0.04, 0.04], SMALL, fast=True)
    closed = figures.render_panda([*panda.READY_Q, 0.0, 0.0], SMALL, fast=True)
    assert differing(arm, opened) == 0
    assert differing(arm, closed) > 0.0002


@draws
def test_a_process_that_was_ended_is_started_again(monkeypatch):
    def look_again(variables):
        asked.append(variables)
        return backends.RENDERS

    asked = []
    monkeypatch.setattr(backends, "probe", look_again)
    first = figures.render_panda(panda.READY_Q, SMALL, fast=True)
    client._studio.process.kill()
    client._studio.process.wait()
    again = figures.render_panda(panda.READY_Q, SMALL, fast=True)
    assert len(asked) == 1
    assert differing(first, again) == 0


@draws
@pytest.mark.usefixtures("fresh_start")
def test_a_robot_that_cannot_be_loaded_is_told_in_one_line(monkeypatch):
    monkeypatch.setenv("MENAGERIE_ROOT", "nowhere")
    q = portrait.with_fingers(panda.READY_Q)
    with pytest.raises(Robo47Error, match=r"^MENAGERIE_ROOT=nowhere has no folder"):
        client.draw(Scene(q, SMALL))


@pytest.mark.usefixtures("fresh_start")
def test_a_process_that_cannot_start_is_told_by_its_last_words(monkeypatch):
    broken = {**os.environ, "MUJOCO_GL": "nonsense"}
    monkeypatch.setattr(backends, "rendering_environment", lambda forget: broken)
    with pytest.raises(Robo47Error, match=r"^cannot draw: .*MUJOCO_GL: nonsense"):
        client.draw(Scene(portrait.with_fingers(panda.READY_Q), SMALL))


@pytest.mark.parametrize("q", [[0.0] * 6, [0.0] * 8, [[0.0] * 7], [np.nan] * 7])
def test_a_configuration_of_another_robot_is_refused(q):
    with pytest.raises(ValueError, match=r"qpos"):
        figures.render_panda(q)


@pytest.mark.usefixtures("twin")
def test_the_embedded_twin_can_be_drawn_too():
    model = panda.load("panda", meshes=True, edit=studio.light_up)
    assert model.geom("floor").bodyid[0] == 0
    assert model.ngeom > 10


@pytest.mark.parametrize(("azimuth", "elevation"), [(118, -14), (0, 0), (-130, 60)])
def test_our_camera_is_mujocos(azimuth, elevation):
    camera = Camera((0.1, 0.2, 0.3), 2.0, np.radians(azimuth), np.radians(elevation))
    model = panda.load("panda")
    model.vis.global_.fovy = np.degrees(FOVY)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    scene = mujoco.MjvScene(model, 100)
    mujoco.mjv_updateScene(
        model, data, mujoco.MjvOption(), None, studio.free_camera(camera),
        mujoco.mjtCatBit.mjCAT_ALL, scene,
    )  # fmt: skip
    left, right = (np.array(eye.pos) for eye in scene.camera)
    np.testing.assert_allclose(camera.T_world_cam[:3, 3], (left + right) / 2, atol=1e-6)
    np.testing.assert_allclose(
        -camera.T_world_cam[:3, 2], scene.camera[0].forward, atol=1e-6
    )
    np.testing.assert_allclose(camera.T_world_cam[:3, 1], scene.camera[0].up, atol=1e-6)
    # The frustum's top, seen from its near plane, is half of the angle of view.
    eye = scene.camera[0]
    assert np.isclose(eye.frustum_top / eye.frustum_near, np.tan(FOVY / 2), atol=1e-6)


def test_the_camera_puts_its_point_in_the_middle_and_up_on_top():
    camera = Camera()
    middle = camera.project(camera.lookat, (600, 400))
    np.testing.assert_allclose(middle, [300, 200, camera.distance], atol=1e-9)
    above = camera.project(np.add(camera.lookat, [0, 0, 0.1]), (600, 400))
    assert np.isclose(above[0], 300)
    assert above[1] < 200
    right = camera.project(camera.T_world_cam[:3, 0] + camera.lookat, (600, 400))
    assert right[0] > 300


def test_the_camera_steps_back_only_as_far_as_the_arm_reaches():
    camera, near = Camera(), np.array([[0.1, 0.0, 0.3]])
    assert camera.stepped_back(near, SMALL) == camera
    far = camera.stepped_back(np.array([[0.0, 0.0, 1.2]]), SMALL)
    assert camera.distance < far.distance < 4
    assert 0 < far.project([0.0, 0.0, 1.2], SMALL)[1] < SMALL[1] / 2


def test_labels_move_apart_and_no_further_than_they_must():
    np.testing.assert_allclose(overlay.spread(np.array([0.0, 50, 90]), 20), [0, 50, 90])
    np.testing.assert_allclose(overlay.spread(np.array([10.0, 10]), 20), [0, 20])
    rng = np.random.default_rng(47)
    for _ in range(100):
        wanted = np.sort(rng.uniform(0, 100, 8))
        assert (np.diff(overlay.spread(wanted, 15.0)) > 15 - 1e-9).all()


def test_a_frame_alone_can_be_drawn():
    picture = Image.new("RGB", (1200, 800), "white")
    framed = overlay.draw_frames(picture, Camera(), {"alone": np.eye(4)})
    assert all(count(framed, colour) > 20 for colour in AXIS_COLOURS)


def test_a_frame_on_top_of_another_is_drawn_shorter():
    apart = np.eye(4)
    apart[0, 3] = 1.0
    lengths = overlay.axis_lengths({"a": np.eye(4), "b": np.eye(4), "c": apart})
    assert lengths[1] < lengths[0] == lengths[2]


@pytest.mark.skipif(sys.platform == "win32", reason="signals are POSIX")
@draws
def test_no_process_is_left_behind(run, tmp_path):
    script = tmp_path / "draw.py"
    script.write_text(
        "from robo47 import panda\nfrom labkit import figures\n"
        "from labkit.figures import client\n"
        "figures.render_panda(panda.READY_Q, (60, 40), fast=True)\n"
        "print(client._studio.process.pid)\n"
    )
    done = run(script)
    with pytest.raises(ProcessLookupError):
        os.kill(int(done.stdout), 0)
