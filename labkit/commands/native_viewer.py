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
from labkit.figures.studio import add_shape
from labkit.inspector.failing import COLOURS, RADII, Drawing, Thing
from robo47 import panda, simulate
from robo47.checks import Array

FRAME_SECONDS = 1 / 60
PROBE_SECONDS = 20
AXIS, THICK = 0.15, 0.006  # metres of a frame's axes
SEE_THROUGH = 0.4  # opacity of another arm
MOVING = int(mujoco.mjtCatBit.mjCAT_DYNAMIC)
# Both of MuJoCo's would leave a small window no room for the arm.
NO_PANELS = {"show_left_ui": False, "show_right_ui": False}
ABOUT = (
    "window: the arm at ready; Shift+Tab shows its sliders, under Control",
    "        (Tab shows the options). Close it, or Ctrl-C here, to end",
)
OF_A_CALL = (
    "window: white is an argument, red YOUR answer, blue the expected answer",
    "        (axes: x red, y green, z blue). Close it, or Ctrl-C here, to end",
)
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


def add_call(scene: mujoco.MjvScene, model: mujoco.MjModel, drawing: Drawing) -> None:
    """Add what a failing call was given, and both answers, to what is drawn."""
    from labkit.figures import overlay  # it needs Pillow, and `--help` does not

    for arm in drawing.others:
        first, others = scene.ngeom, mujoco.MjvOption()
        mujoco.mjv_addGeoms(
            model,
            simulate.start(model, arm.value),
            others,
            mujoco.MjvPerturb(),
            MOVING,
            scene,
        )
        for geom in scene.geoms[first : scene.ngeom]:
            geom.rgba[:] = rgba(COLOURS[arm.whose], SEE_THROUGH)
    for one in drawing.frames:
        origin = one.value[:3, 3]
        axes = one.value[:3, :3].T
        for axis, colour in zip(axes, (overlay.X, overlay.Y, overlay.Z), strict=True):
            _add_arrow(scene, origin, origin + AXIS * axis, rgba(colour))
        _add_ball(scene, one, origin, one.label)
    for one in drawing.points:
        for k, point in enumerate(one.value):
            _add_ball(scene, one, point, "" if k else one.label)


def rgba(colour: tuple[int, int, int], opacity: float = 1.0) -> Array:
    """Return a colour, 0 to 255, as MuJoCo has it, (4,)."""
    return np.array([*colour, 255 * opacity], np.float32) / 255


def _add_arrow(scene: mujoco.MjvScene, start: Array, end: Array, colour: Array) -> None:
    kind = mujoco.mjtGeom.mjGEOM_ARROW
    shape = add_shape(scene, kind, np.zeros(3), start, np.eye(3), colour)
    mujoco.mjv_connector(shape, kind, THICK, start, end)


def _add_ball(scene: mujoco.MjvScene, one: Thing, place: Array, label: str) -> None:
    kind, size = mujoco.mjtGeom.mjGEOM_SPHERE, np.full(3, RADII[one.whose])
    colour = rgba(COLOURS[one.whose])
    add_shape(scene, kind, size, place, np.eye(3), colour).label = label


def show(drawing: Drawing | None = None) -> int:
    """Open the window on `scene.xml` and simulate until it is closed.

    Args:
        drawing: of a failing call: nothing is simulated then.

    Returns:
        The exit code.
    """
    import mujoco.viewer

    model = panda.load("scene", meshes=True)
    camera = Camera(distance=2.6)
    data = at_ready(model)
    if drawing is not None and drawing.q is not None:
        data = simulate.start(model, drawing.q)
    steps = round(FRAME_SECONDS / model.opt.timestep)
    model.vis.scale.framelength *= 0.6  # the default triads hide the arm
    model.vis.scale.framewidth *= 0.4
    print("\n".join(ABOUT if drawing is None else OF_A_CALL))
    try:
        with mujoco.viewer.launch_passive(model, data, **NO_PANELS) as viewer:
            viewer.cam.lookat[:], viewer.cam.distance = camera.lookat, camera.distance
            angles = np.degrees([camera.azimuth, camera.elevation])
            viewer.cam.azimuth, viewer.cam.elevation = angles
            if drawing is None:
                viewer.opt.frame = int(mujoco.mjtFrame.mjFRAME_BODY)
                viewer.opt.label = int(mujoco.mjtLabel.mjLABEL_BODY)
            else:  # a frame may be inside of a link
                viewer.opt.flags[mujoco.mjtVisFlag.mjVIS_TRANSPARENT] = True
                add_call(viewer.user_scn, model, drawing)
            while viewer.is_running():
                start = time.perf_counter()
                with viewer.lock():
                    mujoco.mj_step(model, data, nstep=0 if drawing else steps)
                viewer.sync()
                time.sleep(max(0.0, start + FRAME_SECONDS - time.perf_counter()))
    except KeyboardInterrupt:
        print("\nwindow closed")
    finally:
        # Its thread is still tidying up: without the wait most runs crashed at exit.
        time.sleep(1.0)
    return cli.EXIT_OK
