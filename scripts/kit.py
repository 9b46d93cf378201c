"""Importing this goes on in the kit's own Python, whichever started the script.

`python scripts/check_day.py` then works from a bare system Python too: everything the
kit needs is in .venv, and that is where the script goes on.
"""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NEEDED = ("robo47", "numpy", "mujoco", "tqdm")
OWN = ROOT / ".venv" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def here() -> bool:
    """Return whether this Python can run the kit."""
    return all(importlib.util.find_spec(name) for name in NEEDED)


if not here():
    if os.environ.get("ROBO47_HANDED_ON") or not OWN.exists():
        sys.exit(
            "error: the kit is not set up"
            + (" completely" if OWN.exists() else "")
            + ". Run `make setup` (without make: python3 scripts/setup_env.py --anew)."
        )
    os.environ["ROBO47_HANDED_ON"] = "1"  # once: a broken .venv must not go in circles
    command = [str(OWN), *sys.argv]
    if os.name == "nt":  # execv there returns to the shell before the script has ended
        sys.exit(subprocess.run(command, check=False).returncode)
    os.execv(command[0], command)
