"""How long `make test` takes, and its ten slowest tests."""

import os
import re
import subprocess
import time

from robo47.errors import Robo47Error
from robo47.paths import ROOT

FROM_MAKE = ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")


def run() -> dict:
    """Run the tests once.

    Returns:
        {"seconds", "passed", "slowest": ["1.2s test_...", ...]}.

    Raises:
        Robo47Error: a test failed; a time without a pass says nothing.
    """
    # `make bench` hands its own settings on (`-j`, `-k`): they are not `make test`'s.
    own = {name: os.environ[name] for name in os.environ if name not in FROM_MAKE}
    start = time.perf_counter()
    done = subprocess.run(
        ["make", "test", "ARGS=-q --durations=10"],
        cwd=ROOT,
        env=own,
        capture_output=True,
        text=True,
        check=False,
    )
    seconds = time.perf_counter() - start
    passed = re.search(r"(\d+) passed", done.stdout)
    if done.returncode != 0 or not passed:
        failed = ", ".join(re.findall(r"^FAILED (\S+)", done.stdout, re.MULTILINE))
        raise Robo47Error(f"`make test` fails, so its time says nothing: {failed}")
    slow = re.findall(r"^([\d.]+s) call +tests/\S+::(\S+)", done.stdout, re.MULTILINE)
    return {
        "seconds": seconds,
        "passed": int(passed[1]),
        "slowest": [f"{took} {name[:68]}" for took, name in slow],
    }
