"""Paths in the student's clone; of an installed wheel, in a folder of their home."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# An installed package has no clone around it: it writes into a folder of the user's.
HOME = ROOT if (ROOT / "scripts").is_dir() else Path.home() / "robo47"
# ROBO47_METRICS sends a run's rows elsewhere: tests, and trying things out.
METRICS_CSV = Path(os.environ.get("ROBO47_METRICS") or HOME / "metrics" / "metrics.csv")
TWIN_XML = ROOT / "robo47" / "panda" / "models" / "panda_twin.xml"


def menagerie_root() -> Path:
    """Return the folder that holds `franka_emika_panda/`: MENAGERIE_ROOT, else ours."""
    chosen = os.environ.get("MENAGERIE_ROOT")
    return Path(chosen).expanduser() if chosen else HOME / "mujoco_menagerie"


def shown(path: Path) -> str:
    """Return a path as people read it: relative to the clone, or to the home `~`."""
    for base, prefix in ((ROOT, ""), (Path.home(), "~/")):
        if path.is_relative_to(base):
            return prefix + path.relative_to(base).as_posix()
    return str(path)
