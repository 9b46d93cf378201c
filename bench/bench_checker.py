"""Save to verdict: the checker as a whole process, on a day's file."""

import sys

from bench.timing import programs, take_turns
from robo47.paths import ROOT

CHECK = ROOT / "scripts/check_day.py"
SOLVED = ROOT / "w1-foundations/src/day1_transforms.py"


def run(rounds: int = 5) -> dict:
    """Return seconds for the whole day and for one task, on the reference solution."""
    check = [sys.executable, str(CHECK), "1", "--file", str(SOLVED)]
    commands = {"the whole day": check, "one task (1.6)": [*check, "--task", "1.6"]}
    return take_turns(programs(commands, check=False), rounds)
