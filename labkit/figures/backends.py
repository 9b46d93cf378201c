"""Choice of the OpenGL backend that really draws here, with or without a display.

MuJoCo reads MUJOCO_GL once, when it is imported, and raises there and then where the
library is missing. So every backend is tried in a process of its own, and this module
imports no MuJoCo. Nothing in this process's environment is changed.
"""

import importlib.metadata
import os
import platform
import subprocess
import sys
import textwrap

from labkit.base import processes, store
from robo47.errors import Robo47Error
from robo47.paths import ROOT

NAME = "gl_backend.json"  # a file in the kit's store
RENDERS = "renders"
LINUX = ("egl", "osmesa", "glfw")  # fastest first; glfw needs a display
DEBIAN_PACKAGES = {"egl": "libegl1 libgl1", "osmesa": "libosmesa6"}
# The meaning of a failing import or context.
MEANS = {
    "'NoneType' object has no attribute": "its library is not installed",
    "OpenGL platform library has not been loaded": "opens no window: no display?",
}
TIMEOUT = 60  # seconds; a broken driver hangs rather than fails
# A picture of one colour is a backend that starts and draws nothing.
PROBE = """
import mujoco
ball = "<mujoco><worldbody><geom size='.1' rgba='1 0 0 1'/></worldbody></mujoco>"
model = mujoco.MjModel.from_xml_string(ball)
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with mujoco.Renderer(model, 32, 32) as renderer:
    renderer.update_scene(data)
    print("renders" if renderer.render().std() > 0 else "draws an empty picture")
"""


def candidates() -> dict[str, dict[str, str]]:
    """Return the backends to try, best first, and what each adds to the environment.

    The user's own MUJOCO_GL is the only candidate where it is set. Only Linux has a
    choice to make; elsewhere MuJoCo's default is the one that works.

    Returns:
        {name: variables}, such as {"egl": {"MUJOCO_GL": "egl"}, ...}.
    """
    if chosen := os.environ.get("MUJOCO_GL", "").strip():
        return {chosen: {}}
    if sys.platform.startswith("linux"):
        return {name: {"MUJOCO_GL": name} for name in LINUX}
    return {"cgl" if sys.platform == "darwin" else "default": {}}


def probe(variables: dict[str, str]) -> str:
    """Return "renders", or in one line why a backend of such variables does not."""
    try:
        command = [sys.executable, "-c", PROBE]
        environment = {**os.environ, **variables}
        done = processes.run(command, env=environment, timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        return f"gave no picture within {TIMEOUT} seconds"
    if said := done.stdout.split("\n")[0]:
        return said  # whatever happened afterwards, at exit
    last_words = done.stderr.strip().split("\n")[-1]
    for sign, meaning in MEANS.items():
        if sign in last_words:
            return meaning
    return (
        textwrap.shorten(last_words, 120) or f"ended with exit code {done.returncode}"
    )


def probe_backends() -> dict[str, str]:
    """Return for each backend "renders", or the reason why it does not."""
    return {name: probe(variables) for name, variables in candidates().items()}


def rendering_environment(*, forget: bool = False) -> dict[str, str]:
    """Return this process's environment with a MUJOCO_GL that draws.

    Args:
        forget: try anew instead of trusting what was found the last time.

    Raises:
        Robo47Error: nothing draws here; the line names what to install.
    """
    options = candidates()
    record = {} if forget else store.read(NAME, ROOT)
    known = record.get("backend")
    if known in options and record.get("key") == _key():
        return {**os.environ, **options[known]}
    reasons = {}
    for name, variables in options.items():
        reasons[name] = probe(variables)
        if reasons[name] == RENDERS:
            store.write(NAME, {"key": _key(), "backend": name}, ROOT)
            return {**os.environ, **variables}
    raise Robo47Error(_advice(reasons))


def _advice(reasons: dict[str, str]) -> str:
    if chosen := os.environ.get("MUJOCO_GL", "").strip():
        packages = DEBIAN_PACKAGES.get(chosen.lower())
        install = (
            f", or on Debian and Ubuntu: apt install {packages}" if packages else ""
        )
        return (
            f"no picture with MUJOCO_GL={chosen} ({reasons[chosen]}). "
            f"Unset it and the kit picks a backend that works{install}"
        )
    if sys.platform.startswith("linux"):
        return (
            "no OpenGL library draws here. On Debian and Ubuntu: "
            f"apt install {DEBIAN_PACKAGES['egl']} (or {DEBIAN_PACKAGES['osmesa']}), "
            "then run this again"
        )
    (reason,) = reasons.values()
    return f"MuJoCo cannot draw here ({reason}). Update the graphics driver"


def _key() -> dict[str, str]:
    """Return everything that the answer depends on."""
    return {
        "machine": platform.platform() + " " + platform.node(),
        "python": sys.executable,
        "mujoco": importlib.metadata.version("mujoco"),
        "MUJOCO_GL": os.environ.get("MUJOCO_GL", ""),
        "DISPLAY": os.environ.get("DISPLAY", ""),
    }
