"""Ask Pinocchio for the Panda's poses and forces and keep its answers for the tests.

    make oracle                      write the files in tests/data/
    make oracle ARGS=--check         compute anew and compare with them

pinocchio_panda.json holds poses of every frame; dynamics_oracle.json what crba and rnea
say: both with the armature, which Pinocchio reads from the file, without damping.
kinematics_oracle.json holds Pinocchio's three Jacobians, its twists turned into
(omega; v), and what the textbook's own package (modern_robotics) says, given our
screws.

Pinocchio (pin) reads the same MJCF files but shares no code with MuJoCo or with us.
It is 480 MB installed and has no Windows wheel, so it gets an environment of its own,
.venv-oracle, and the tests read its answers from a small file.
"""

import json
import os
import subprocess
import venv
from pathlib import Path
from typing import Any

import numpy as np

from labkit.base import cli
from robo47 import panda, verify
from robo47.errors import Robo47Error
from robo47.panda import files
from robo47.paths import ROOT, shown

ORACLE = ROOT / "tests" / "data" / "pinocchio_panda.json"
DYNAMICS = ROOT / "tests" / "data" / "dynamics_oracle.json"
ENVIRONMENT = ROOT / ".venv-oracle"
KINEMATICS = ROOT / "tests" / "data" / "kinematics_oracle.json"
PIN, TEXTBOOK = "pin==4.1.0", "modern-robotics==1.1.1"
CONFIGURATIONS, SEED = 15, 47
JACOBIANS = 24  # configurations, for the Jacobians
SAME = 1e-12  # two builds of Pinocchio need not agree to the last bit

# Runs inside .venv-oracle: a robot's file and what is asked of it in, answers out.
ASK = """
import json, sys
import numpy as np, pinocchio as pin
xml, given = json.load(sys.stdin)
model = pin.buildModelFromMJCF(xml)
data = model.createData()
answer = {"pinocchio": pin.__version__, **given}
%s
json.dump(answer, sys.stdout)
"""

ASK_POSES = """
frames = [f for f in model.frames if f.type in (pin.BODY, pin.OP_FRAME)]
answer["poses"] = {f.name: [] for f in frames if f.name != "universe"}
for q in given["q"]:
    pin.framesForwardKinematics(model, data, np.array(q))
    for name, rows in answer["poses"].items():
        T = data.oMf[model.getFrameId(name)].homogeneous
        rows.append(T[:3].ravel().tolist())
"""

# Of motions: mass matrix, torque of a motion, torque at rest.
ASK_FORCES = """
answer |= {"crba": [], "rnea": [], "bias": []}
for row in zip(*(np.array(given[name]) for name in ("q", "qd", "qdd"))):
    M = np.triu(pin.crba(model, data, row[0]))
    answer["crba"].append((M + np.triu(M, 1).T).tolist())
    answer["rnea"].append(pin.rnea(model, data, *row).tolist())
    answer["bias"].append(pin.nonLinearEffects(model, data, *row[:2]).tolist())
"""

# Pinocchio's, and those of the textbook's package beside it.
ASK_JACOBIANS = """
import modern_robotics as mr
frame, S, M = (answer.pop(name) for name in ("frame", "S", "M"))
q = np.array(given["q"])
index, S, M = model.getFrameId(frame), np.array(S).T, np.array(M)
B = mr.Adjoint(mr.TransInv(M)) @ S
ask = {
    kind: lambda row, r=r: pin.computeFrameJacobian(model, data, row, index, r)[
        [3, 4, 5, 0, 1, 2]
    ]
    for kind, r in pin.ReferenceFrame.names.items()
}
ask["FKinSpace"] = lambda row: mr.FKinSpace(M, S, row)[:3]
ask["FKinBody"] = lambda row: mr.FKinBody(M, B, row)[:3]
ask["JacobianSpace"] = lambda row: mr.JacobianSpace(S, row)
ask["JacobianBody"] = lambda row: mr.JacobianBody(B, row)
answer["answers"] = {
    name: [(np.round(f(row), 15) + 0.0).ravel().tolist() for row in q]
    for name, f in ask.items()
}
"""


def oracle_python() -> Path:
    """Return the Python that has Pinocchio, installing it on first use."""
    inside = "Scripts/python.exe" if os.name == "nt" else "bin/python"
    python = ENVIRONMENT / inside
    found = [str(python), "-c", "import pinocchio, modern_robotics"]
    if python.exists() and subprocess.run(found, check=False).returncode == 0:
        return python
    print(f"installing {PIN} (about 100 MB) into {shown(ENVIRONMENT)} ...", flush=True)
    venv.create(ENVIRONMENT, clear=True, with_pip=True)
    install = [str(python), "-m", "pip", "install", "-q", PIN, TEXTBOOK, "numpy"]
    done = subprocess.run(install, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Robo47Error(f"{PIN} could not be installed: {done.stderr.strip()[-300:]}")
    return python


def ask_for_poses() -> dict:
    """Return Pinocchio's poses of both entries at seeded configurations."""
    answers = {}
    for entry in ("panda", "panda_nohand"):
        q = verify.random_q(panda.load(entry), CONFIGURATIONS, SEED)
        answers[entry] = ask(ASK_POSES, entry, q=np.round(q, 6).tolist())
        version = answers[entry].pop("pinocchio")
    return {"pinocchio": version, "entries": answers}


def ask_for_forces() -> dict:
    """Return Pinocchio's dynamics of panda_nohand at seeded motions."""
    q = verify.random_q(panda.load("panda_nohand"), CONFIGURATIONS, SEED)
    rng = np.random.default_rng(SEED)
    motion = {"q": q, "qd": rng.uniform(-2, 2, q.shape)}
    motion["qdd"] = rng.uniform(-10, 10, q.shape)
    rounded = {name: np.round(part, 6).tolist() for name, part in motion.items()}
    answer = ask(ASK_FORCES, "panda_nohand", **rounded)
    return {"pinocchio": answer.pop("pinocchio"), "panda_nohand": answer}


def ask_for_jacobians() -> dict:
    """Return three Jacobians of Pinocchio's and the textbook's, of panda_nohand."""
    model, frame = panda.load("panda_nohand"), panda.END_FRAME["panda_nohand"]
    q = np.round(verify.random_q(model, JACOBIANS, SEED), 6).tolist()
    arm = {"S": panda.screws(model).tolist(), "M": panda.home_pose(model).tolist()}
    return ask(ASK_JACOBIANS, "panda_nohand", q=q, frame=frame.partition(":")[2], **arm)


def ask(code: str, entry: str, **given: object) -> dict:
    """Run code where Pinocchio is, with the real Panda; return its answer."""
    folder = files.panda_folder()
    if folder is None:
        raise Robo47Error("no Panda here; run python3 scripts/fetch_menagerie.py first")
    done = subprocess.run(
        [str(oracle_python()), "-c", ASK % code],
        input=json.dumps([str(folder / f"{entry}.xml"), given]),
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        raise Robo47Error(f"Pinocchio failed: {done.stderr.strip()[-300:]}")
    return json.loads(done.stdout)


def largest_difference(ours: Any, theirs: Any) -> float:
    """Return the largest absolute difference between two answers."""
    if isinstance(ours, str):  # Pinocchio's version
        return 0.0
    if not isinstance(ours, dict):
        return float(np.abs(np.subtract(ours, theirs)).max())
    if ours.keys() != theirs.keys():
        return np.inf
    return max(largest_difference(ours[name], theirs[name]) for name in ours)


ORACLES = {
    ORACLE: ask_for_poses,
    DYNAMICS: ask_for_forces,
    KINEMATICS: ask_for_jacobians,
}


def main() -> int:
    """Write the oracle files, or check them."""
    parser = cli.parser(__doc__)
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    options = parser.parse_args()
    all_same = True
    for path, ask_anew in ORACLES.items():
        fresh = ask_anew()
        if options.check:
            worst = largest_difference(fresh, json.loads(path.read_text("utf-8")))
            same = worst < SAME
            print(f"{'PASS' if same else 'FAIL'}  {shown(path)} differs by {worst:.1e}")
            all_same &= same
        else:
            path.write_text(json.dumps(fresh).replace("}, ", "},\n") + "\n", "utf-8")
            print(f"wrote {shown(path)}: Pinocchio {fresh['pinocchio']}")
    return cli.EXIT_OK if all_same else cli.EXIT_FAILED
