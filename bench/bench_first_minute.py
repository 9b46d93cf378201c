"""The first minute: a fresh clone, nothing cached, until the lab has passed."""

import os
import subprocess
import tempfile
import time
from pathlib import Path

from robo47.paths import ROOT

HANDOUT_CLONE_MB = 554  # what `git clone` of the whole Menagerie downloads
OFFICIAL_MB, WHEEL_MB = 3.1, 83.6  # the Panda alone, from either source


def run() -> dict:
    """Clone, `make day1` with an empty HOME, and count what came over the network.

    Returns:
        {"seconds", "downloaded_mb", "robot_mb", "handout_clone_mb", "passed"}.
    """
    with tempfile.TemporaryDirectory() as folder:
        clone = Path(folder) / "robo47"
        cache = Path(folder) / "cache"
        environment = {
            **os.environ, "HOME": folder, "PIP_CACHE_DIR": str(cache),
            "UV_CACHE_DIR": str(cache), "XDG_CACHE_HOME": folder + "/xdg",
        }  # fmt: skip
        # `make bench` hands its own settings on, and the last line is then "Leaving
        # directory", which no lab has said.
        for name in ("MENAGERIE_ROOT", "MAKEFLAGS", "MAKELEVEL", "MFLAGS"):
            environment.pop(name, None)
        before = _received()
        start = time.perf_counter()
        subprocess.run(
            ["git", "clone", "--quiet", str(ROOT), str(clone)],
            check=True,
            env=environment,
        )
        done = subprocess.run(
            ["make", "day1", "ARGS=--no-log"],
            cwd=clone,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        seconds = time.perf_counter() - start
        received = _received()
        official = "asking the package index" not in done.stdout
        return {
            "seconds": seconds,
            "downloaded_mb": None if received is None else (received - before) / 1e6,
            "robot_mb": OFFICIAL_MB if official else WHEEL_MB,
            "handout_clone_mb": HANDOUT_CLONE_MB,
            "passed": passed(done),
        }


def passed(lab: subprocess.CompletedProcess[str]) -> bool:
    """Return whether a lab's run ended well; advice may stand below its last line."""
    return lab.returncode == 0 and "All checks PASSED." in lab.stdout.splitlines()


def _received() -> int | None:
    """Return the bytes received over the network so far; None where nobody counts."""
    try:
        lines = Path("/proc/net/dev").read_text("utf-8").splitlines()[2:]
    except OSError:
        return None
    counts = dict(line.split(":", 1) for line in lines)
    return sum(int(n.split()[0]) for name, n in counts.items() if name.strip() != "lo")
