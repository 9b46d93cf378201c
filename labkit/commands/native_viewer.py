"""The Panda in MuJoCo's own window, at ready and holding still.

MuJoCo ends the whole process where it cannot open a window, so that is found out
first, in a process that may die.
"""

import os
import subprocess
import sys
import time

import mujoco
import numpy as np

from labkit.base import cli
from labkit.figures.scene import Camera
from robo47 import panda, simulate

FRAME_SECONDS = 1 / 60
PROBE_SECONDS = 20
# Both of MuJoCo's would leave a small window no room for the arm.
NO_PANELS = {"show_left_ui": False, "show_right_ui": False}
# MuJoCo's viewer needs a GLFW window with an OpenGL context.
_PROBE = (
    "import glfw, sys; glfw.init() or sys.exit(1); "
    "glfw.window_hint(glfw.VISIBLE, False); "
    "w = glfw.create_window(64, 64, '', None, None); glfw.terminate(); "
    "sys.exit(0 if w else 1)"
)


def obstacle() -> str | None:
    """Return why no window can be opened from here, or None where one can."""
    if sys.platform == "darwin":
        import mujoco.viewer

        if getattr(mujoco.viewer, "_MJPYTHON", None) is None:
            return (
                "on macOS MuJoCo's window needs its own Python: "
                "mjpython scripts/view_panda.py --native"
            )
        return None
    if sys.platform != "win32" and not (
        os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    ):
        return "there is no display (DISPLAY and WAYLAND_DISPLAY are not set)"
    try:
        probe = subprocess.run(
            [sys.executable, "-W", "ignore", "-c", _PROBE],
            capture_output=True,
            timeout=PROBE_SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return "the display does not answer"
    return None if probe.returncode == 0 else "the display cannot open an OpenGL window"


def at_ready(model: mujoco.MjModel) -> mujoco.MjData:
    """Return the arm at `panda.READY_Q`, its actuators set to hold it there.

    That is the configuration whose matrices the lessons print; `home`, the model's own
    key, is another one.

    Args:
        model: the Panda, any entry, with its servos.
    """
    data = simulate.start(model, panda.READY_Q)
    _, _, motors = simulate.addresses(model)
    data.ctrl[motors] = panda.READY_Q  # the arm would sag at once without this
    return data


def show() -> int:
    """Open the window on `scene.xml` and simulate until it is closed.

    Returns:
        The exit code.
    """
    import mujoco.viewer

    model = panda.load("scene", meshes=True)
    camera = Camera(distance=2.6)
    data = at_ready(model)
    steps = round(FRAME_SECONDS / model.opt.timestep)
    model.vis.scale.framelength *= 0.6  # the default triads hide the arm
    model.vis.scale.framewidth *= 0.4
    print("window: the arm at ready; Shift+Tab shows its sliders, under Control")
    print("        (Tab shows the options). Close it, or Ctrl-C here, to end")
    try:
        with mujoco.viewer.launch_passive(model, data, **NO_PANELS) as viewer:
            viewer.opt.frame = int(mujoco.mjtFrame.mjFRAME_BODY)
            viewer.opt.label = int(mujoco.mjtLabel.mjLABEL_BODY)
            viewer.cam.lookat[:], viewer.cam.distance = camera.lookat, camera.distance
            angles = np.degrees([camera.azimuth, camera.elevation])
            viewer.cam.azimuth, viewer.cam.elevation = angles
            while viewer.is_running():
                start = time.perf_counter()
                with viewer.lock():
                    mujoco.mj_step(model, data, nstep=steps)
                viewer.sync()
                time.sleep(max(0.0, start + FRAME_SECONDS - time.perf_counter()))
    except KeyboardInterrupt:
        print("\nwindow closed")
    finally:
        # Its thread is still tidying up: without the wait most runs crashed at exit.
        time.sleep(1.0)
    return cli.EXIT_OK
