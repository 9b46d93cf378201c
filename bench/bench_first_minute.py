"""The first minute: a fresh clone, nothing cached, until the lab has passed."""

import os
import subprocess
import tempfile
import time
from pathlib import Path

from robo47.paths import ROOT

HANDOUT_CLONE_MB = 554  # what `git clone` of the whole Menagerie downloads


def run() -> dict:
    """Clone, `make day1` with an empty HOME, and count what came over the network.

    Returns:
        {"seconds", "downloaded_mb", "robot_mb", "handout_clone_mb", "passed"}.
    """
    with tempfile.TemporaryDirectory() as folder:
        clone, cache = Path(folder) / "robo47", Path(folder) / "cache"
        environment = {
            **os.environ, "HOME": folder, "PIP_CACHE_DIR": str(cache),
            "UV_CACHE_DIR": str(cache), "XDG_CACHE_HOME": folder + "/xdg",
        }  # fmt: skip
        environment.pop("MENAGERIE_ROOT", None)
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
        # pip keeps every response in its cache: their size is what was downloaded.
        sizes = [p.stat().st_size for p in cache.rglob("*") if p.is_file()]
        official = "asking the package index" not in done.stdout
        return {
            "seconds": seconds,
            "downloaded_mb": sum(sizes) / 1e6 + (3.1 if official else 0.0),
            "robot_mb": 3.1 if official else max(sizes, default=0) / 1e6,
            "handout_clone_mb": HANDOUT_CLONE_MB,
            "passed": done.stdout.rstrip().endswith("All checks PASSED."),
        }
