"""Ask Pinocchio for the Panda's poses and keep its answers for the tests.

    make oracle                      write tests/data/pinocchio_panda.json
    make oracle ARGS=--check         compute anew and compare with it

Pinocchio (pin) reads the same MJCF files but shares no code with MuJoCo or with us.
It is 480 MB installed and has no Windows wheel, so it gets an environment of its own,
.venv-oracle, and the tests read its answers from a small file.
"""

import json
import os
import subprocess
import venv
from pathlib import Path

import kit  # noqa: F401 (goes on in the kit's own Python)
import numpy as np

from robo47 import cli, menagerie, panda, verify
from robo47.errors import Robo47Error
from robo47.paths import ROOT, shown

ORACLE = ROOT / "tests" / "data" / "pinocchio_panda.json"
ENVIRONMENT = ROOT / ".venv-oracle"
PIN = "pin==4.1.0"
CONFIGURATIONS, SEED = 15, 47
SAME = 1e-12  # two builds of Pinocchio need not agree to the last bit

# Runs inside .venv-oracle: a file name and configurations in, poses out, as JSON.
ASK_PINOCCHIO = """
import json, sys
import numpy as np, pinocchio as pin
answers = {}
for entry, (xml, qs) in json.load(sys.stdin).items():
    model = pin.buildModelFromMJCF(xml)
    data = model.createData()
    frames = [f for f in model.frames if f.type in (pin.BODY, pin.OP_FRAME)]
    poses = {f.name: [] for f in frames if f.name != "universe"}
    for q in qs:
        pin.framesForwardKinematics(model, data, np.array(q))
        for name, rows in poses.items():
            T = data.oMf[model.getFrameId(name)].homogeneous
            rows.append(T[:3].ravel().tolist())
    answers[entry] = {"q": qs, "poses": poses}
json.dump({"pinocchio": pin.__version__, "entries": answers}, sys.stdout)
"""


def oracle_python() -> Path:
    """Return the Python that has Pinocchio, installing it on first use."""
    inside = "Scripts/python.exe" if os.name == "nt" else "bin/python"
    python = ENVIRONMENT / inside
    found = [str(python), "-c", "import pinocchio"]
    if python.exists() and subprocess.run(found, check=False).returncode == 0:
        return python
    print(f"installing {PIN} (about 100 MB) into {shown(ENVIRONMENT)} ...", flush=True)
    venv.create(ENVIRONMENT, clear=True, with_pip=True)
    install = [str(python), "-m", "pip", "install", "--quiet", PIN, "numpy"]
    done = subprocess.run(install, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Robo47Error(f"{PIN} could not be installed: {done.stderr.strip()[-300:]}")
    return python


def ask() -> dict:
    """Return Pinocchio's poses of both entries at seeded configurations."""
    folder = menagerie.panda_folder()
    if folder is None:
        raise Robo47Error("no Panda here; run python scripts/fetch_menagerie.py first")
    question = {}
    for entry in ("panda", "panda_nohand"):
        q = verify.random_q(panda.load(entry), CONFIGURATIONS, SEED)
        question[entry] = (str(folder / f"{entry}.xml"), np.round(q, 6).tolist())
    done = subprocess.run(
        [str(oracle_python()), "-c", ASK_PINOCCHIO],
        input=json.dumps(question),
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        raise Robo47Error(f"Pinocchio failed: {done.stderr.strip()[-300:]}")
    return json.loads(done.stdout)


def largest_difference(ours: dict, theirs: dict) -> float:
    """Return the largest absolute difference between two sets of answers."""
    worst = 0.0
    for entry, answer in ours["entries"].items():
        other = theirs["entries"][entry]
        if answer["q"] != other["q"] or answer["poses"].keys() != other["poses"].keys():
            return np.inf
        for name, rows in answer["poses"].items():
            off = np.abs(np.array(rows) - np.array(other["poses"][name])).max()
            worst = max(worst, float(off))
    return worst


def main() -> int:
    """Write the oracle file, or check it."""
    parser = cli.parser(__doc__)
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    options = parser.parse_args()
    fresh = ask()
    if options.check:
        worst = largest_difference(fresh, json.loads(ORACLE.read_text("utf-8")))
        ok = worst < SAME
        print(f"{'PASS' if ok else 'FAIL'}  {shown(ORACLE)} differs by {worst:.1e}")
        return cli.EXIT_OK if ok else cli.EXIT_FAILED
    ORACLE.write_text(json.dumps(fresh).replace("}, ", "},\n") + "\n", "utf-8")
    print(f"wrote {shown(ORACLE)}: Pinocchio {fresh['pinocchio']}")
    return cli.EXIT_OK


if __name__ == "__main__":
    cli.run(main)
