"""MuJoCo's own window: opened only where it can be, with an arm that holds still."""

import sys
from contextlib import contextmanager, nullcontext
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from labkit.commands import native_viewer
from robo47 import panda

pytestmark = pytest.mark.kit


def test_no_display_is_an_obstacle_on_linux(monkeypatch):
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    assert "no display" in str(native_viewer.obstacle())


@pytest.mark.parametrize(
    ("code", "expected"), [(0, None), (1, "cannot open an OpenGL window")]
)
def test_with_a_display_a_child_process_finds_out(monkeypatch, code, expected):
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(native_viewer, "_PROBE", f"raise SystemExit({code})")
    found = native_viewer.obstacle()
    assert found is None if expected is None else expected in str(found)


def test_a_display_that_hangs_is_an_obstacle(monkeypatch):
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(native_viewer, "_PROBE", "import time; time.sleep(60)")
    monkeypatch.setattr(native_viewer, "PROBE_SECONDS", 0.5)
    assert "does not answer" in str(native_viewer.obstacle())


def test_macos_is_told_of_mjpython(monkeypatch):
    import mujoco.viewer

    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setattr(mujoco.viewer, "_MJPYTHON", None, raising=False)
    assert "mjpython scripts/view_panda.py --native" in str(native_viewer.obstacle())
    monkeypatch.setattr(mujoco.viewer, "_MJPYTHON", object())
    assert native_viewer.obstacle() is None


@pytest.mark.parametrize("source", ["real_panda", "twin"])
def test_the_arm_starts_at_ready_and_does_not_sag(request, source):
    request.getfixturevalue(source)
    model = panda.load("scene")
    data = native_viewer.at_ready(model)
    np.testing.assert_array_equal(data.qpos[:7], panda.READY_Q)
    np.testing.assert_array_equal(data.ctrl[:7], panda.READY_Q)
    start = data.qpos.copy()
    mujoco.mj_step(model, data, nstep=round(2.0 / model.opt.timestep))
    assert np.abs(data.qpos - start).max() < 0.01  # radians


@pytest.mark.parametrize("ctrl_c", [False, True])
def test_the_window_is_closed_and_given_a_second_before_the_end(
    monkeypatch, capsys, ctrl_c
):
    import mujoco.viewer

    happened: list[object] = []

    def is_running() -> bool:
        happened.append("looked")
        if ctrl_c:
            raise KeyboardInterrupt
        return happened.count("looked") < 3

    handle = SimpleNamespace(
        opt=mujoco.MjvOption(),
        cam=mujoco.MjvCamera(),
        is_running=is_running,
        lock=nullcontext,
        sync=lambda: happened.append("shown"),
    )

    @contextmanager
    def launch_passive(model, data, show_left_ui, show_right_ui):
        happened.append(float(data.ctrl[3]) if model.nu else "no motors")
        try:
            yield handle
        finally:
            happened.append("closed")

    monkeypatch.setattr(mujoco.viewer, "launch_passive", launch_passive)
    monkeypatch.setattr(
        native_viewer.time, "sleep", lambda s: happened.append(round(s, 3))
    )
    assert native_viewer.show() == 0
    assert happened[-2:] == ["closed", 1.0]
    assert happened.count("shown") == (0 if ctrl_c else 2)
    assert handle.cam.distance == 2.6
    assert handle.opt.frame == mujoco.mjtFrame.mjFRAME_BODY
    assert ("window closed" in capsys.readouterr().out) == ctrl_c
