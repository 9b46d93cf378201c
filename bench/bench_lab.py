"""The whole lab beside the handout's own script, and beside the floor under both."""

import shutil
import sys

from bench.timing import programs, take_turns
from robo47.panda import files
from robo47.paths import ROOT

LAB = ROOT / "w1-foundations/src/day1_transforms.py"
HANDOUT = ROOT / "bench/handout_day1.py"


def run(rounds: int = 9) -> dict:
    """Time whole processes, warm, taking turns; return {"seconds": {name: ...}}."""
    folder = files.panda_folder()
    commands = {
        "imports alone (python, numpy, mujoco)": [
            sys.executable, "-c", "import numpy, mujoco",
        ],
        "our lab": [sys.executable, str(LAB), "--no-log"],
    }  # fmt: skip
    if shutil.which("make"):
        commands["make day1"] = ["make", "day1", "ARGS=--no-log"]
    if folder is not None:
        xml = str(folder / "panda_nohand.xml")
        commands["the handout's script, fixed"] = [sys.executable, str(HANDOUT), xml]
    return {"seconds": take_turns(programs(commands), rounds)}
