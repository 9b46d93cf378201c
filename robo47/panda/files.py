"""The robot's files: where they are, where they came from, whether they are intact.

All code reads the robot from one place: MENAGERIE_ROOT if set, else mujoco_menagerie/
in the clone, laid out as the MuJoCo Menagerie is. `scripts/fetch_menagerie.py` fills
it; this module reads it. PROVENANCE.json beside the robot's folder records the source
and the sha256 of every file.
"""

import hashlib
import json
import os
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

from robo47.errors import Robo47Error
from robo47.paths import menagerie_root, shown

PANDA = "franka_emika_panda"
ENTRIES = ("panda", "panda_nohand", "scene")


def remedy() -> str:
    """Return what to do about broken files, as a sentence."""
    if os.environ.get("MENAGERIE_ROOT"):
        return "Fix them there, or unset MENAGERIE_ROOT to use the kit's own copy."
    return (
        f"Delete {shown(menagerie_root() / PANDA)} and run `make robot` to fetch it"
        " anew (without make: python3 scripts/fetch_menagerie.py)."
    )


def panda_folder() -> Path | None:
    """Return the Panda's folder, or None where there is none to be had yet.

    Raises:
        Robo47Error: MENAGERIE_ROOT is set, and no Panda is there.
    """
    folder = menagerie_root() / PANDA
    if folder.is_dir():
        return folder
    if os.environ.get("MENAGERIE_ROOT"):
        raise Robo47Error(
            f"MENAGERIE_ROOT={os.environ['MENAGERIE_ROOT']} has no folder {PANDA}/. "
            "Point it at a MuJoCo Menagerie, or unset it to use the kit's own copy."
        )
    return None


def read_provenance() -> dict[str, Any]:
    """Return PROVENANCE.json, or what is known of a folder that has no readable one.

    Returns:
        A dict with at least "source" and "commit" (None where nobody recorded it).
    """
    root = menagerie_root()
    return record_of(root) or describe_copy(root)


def record_of(root: Path) -> dict[str, Any]:
    """Return PROVENANCE.json, or {} where it is missing, torn or something else."""
    try:
        found = json.loads((root / "PROVENANCE.json").read_text("utf-8"))
    except (OSError, ValueError):
        return {}
    if not isinstance(found, dict) or not isinstance(found.get("source"), str):
        return {}
    commit = found.setdefault("commit", None)
    files = found.get("files", {})
    right = isinstance(commit, str | None) and isinstance(files, dict)
    return found if right else {}


def describe_copy(root: Path) -> dict[str, Any]:
    """Return the provenance of a folder of robots that somebody else put there."""
    git = ["git", "-C", str(root), "rev-parse", "--show-toplevel", "HEAD"]
    try:
        said = subprocess.run(git, capture_output=True, text=True, check=True).stdout
        top, commit = said.split("\n")[:2]
        is_clone = Path(top).resolve() == root.resolve()
    except (OSError, subprocess.CalledProcessError):
        is_clone = False
    if is_clone:
        return {"source": "a clone of the Menagerie", "commit": commit}
    return {"source": "a copy of the Menagerie", "commit": None}


def hash_file(path: Path) -> str:
    """Return the sha256 of a file, in hexadecimal."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def hash_files(folder: Path) -> dict[str, str]:
    """Return {path relative to the folder: sha256} of every file below it."""
    return {
        path.relative_to(folder).as_posix(): hash_file(path)
        for path in sorted(folder.rglob("*"))
        if path.is_file() and ".git" not in path.parts
    }


def changed_files(folder: Path, recorded: dict[str, str]) -> list[str]:
    """Return which recorded files are missing or differ, one line each."""
    now = hash_files(folder)
    return [
        f"{name}: {'changed' if name in now else 'missing'}"
        for name, sha256 in recorded.items()
        if now.get(name) != sha256
    ]


def missing_files(folder: Path) -> list[str]:
    """Return the files that the kit's entries need and the robot's folder lacks."""
    missing = []
    for entry in ENTRIES:
        xml = folder / f"{entry}.xml"
        try:
            root = ET.parse(xml).getroot()
        except (OSError, ET.ParseError):
            missing.append(xml.name)
            continue
        meshes = [m.get("file") for m in root.iter("mesh") if m.get("file")]
        missing += [m for m in meshes if m and not (folder / "assets" / m).is_file()]
    return sorted(set(missing))
