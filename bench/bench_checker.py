"""Save to verdict: the checker as a whole process, on a day's file."""

import subprocess
import sys

from bench.timing import take_turns
from robo47.paths import ROOT

CHECK = ROOT / "scripts/check_day.py"
SOLVED = ROOT / "w1-foundations/src/day1_transforms.py"


def run(rounds: int = 5) -> dict:
    """Return seconds for the whole day and for one task, on the reference solution."""
    commands = {
        "the whole day": ["1", "--file", str(SOLVED)],
        "one task (1.6)": ["1", "--file", str(SOLVED), "--task", "1.6"],
    }
    return take_turns(
        {
            name: lambda words=words: subprocess.run(
                [sys.executable, str(CHECK), *words], capture_output=True, check=False
            )
            for name, words in commands.items()
        },
        rounds,
    )
