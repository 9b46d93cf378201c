"""The doctor's probes: code for a process of its own that prints one JSON value.

Read by a bare Python, old ones included: the standard library alone.
"""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 60

PYTHON_PROBE = "import json, platform; print(json.dumps(platform.python_version()))"
VERSIONS_PROBE = """
import json
from importlib import metadata
found = {}
for name in ("mujoco", "mujoco-core", "numpy"):
    try:
        found[name] = metadata.version(name)
    except metadata.PackageNotFoundError:
        pass
print(json.dumps(found))
"""
MUJOCO_PROBE = """
import json, mujoco
mujoco.mj_forward(m := mujoco.MjModel.from_xml_string("<mujoco/>"), mujoco.MjData(m))
print(json.dumps(mujoco.__version__))
"""
ROBOT_PROBE = """
import json
from robo47 import panda
from robo47.panda import files as menagerie
from robo47.paths import menagerie_root
found = panda.provenance()
found["loads"] = panda.load("panda_nohand").nq
folder = menagerie.panda_folder()
if folder:
    record = menagerie.read_provenance().get("files")
    found["files"] = len(record or ())
    found["changed"] = menagerie.changed_files(folder, record or {})[:3]
    found["missing"] = menagerie.missing_files(folder)[:3]
print(json.dumps(found))
"""
LESSONS_PROBE = """
import json
from labkit.lesson import originals
from labkit.lesson.day import all_days
from robo47.paths import shown
days = all_days()
others = [shown(day.source) for day in days if not originals.is_kits(day)]
print(json.dumps({"days": len(days), "others": others}))
"""
WALL_PROBE = """
import json
from labkit.sandbox.wall import wall
print(json.dumps(wall().name))
"""
GL_PROBE = """
import json
from labkit.figures import probe_backends
print(json.dumps(probe_backends()))
"""


def probe(python: str, code: str, gl: bool = False) -> tuple[Any, str]:
    """Run code that prints one JSON value; return it, or None and the last words.

    MUJOCO_GL stops MuJoCo's import where it is wrong: only the look at OpenGL gets it.
    """
    kept = dict(os.environ)
    if not gl:
        kept.pop("MUJOCO_GL", None)
    try:
        done = subprocess.run(
            [python, "-c", code],
            cwd=str(ROOT),
            env=kept,
            capture_output=True,
            timeout=SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return None, "no answer after {} s".format(SECONDS)  # noqa: UP032
    except OSError as error:
        return None, str(error.strerror)
    try:
        return json.loads(done.stdout.decode("utf-8", "replace").splitlines()[-1]), ""
    except (ValueError, IndexError):
        said = done.stderr.decode("utf-8", "replace").strip().splitlines()
        return None, said[-1] if said else f"ended with code {done.returncode}"
