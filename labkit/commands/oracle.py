"""Compute the Panda's poses and forces with Pinocchio, and store them for the tests.

    make oracle                      write the files in tests/data/
    make oracle ARGS=--check         compute them again and compare

pinocchio_panda.json holds the poses of every frame. dynamics_oracle.json holds the
results of crba and rnea, both with the armature, which Pinocchio reads from the file,
and without damping. kinematics_oracle.json holds Pinocchio's three Jacobians, with
twists converted to (omega; v), and the results of the textbook's package
(modern_robotics) for our screws.

Pinocchio (pin) reads the same MJCF files but shares no code with MuJoCo or with us.
It is 480 MB installed and has no Windows wheel, so it gets an environment of its own,
.venv-oracle, and the tests read its answers from a small file.
"""

import importlib
import json
import site
import sys
from importlib.util import find_spec
from typing import Any

import numpy as np

from labkit.base import cli, processes
from robo47 import panda, verify
from robo47.errors import Robo47Error
from robo47.panda import files
from robo47.paths import ROOT, shown

DATA = ROOT / "tests" / "data"
ENVIRONMENT = ROOT / ".venv-oracle"
PIN, TEXTBOOK = "pin==4.1.0", "modern-robotics==1.1.1"
CONFIGURATIONS, SEED = 15, 47
JACOBIANS = 24  # configurations, for the Jacobians
SAME = 1e-12  # two builds of Pinocchio need not agree to the last bit


def bring_pinocchio() -> None:
    """Let Python find both packages beside the kit's, installing them on first use."""
    site.addsitedir(str(ENVIRONMENT))
    if find_spec("pinocchio") and find_spec("modern_robotics"):
        return
    print(f"installing {PIN} (about 100 MB) into {shown(ENVIRONMENT)} ...", flush=True)
    install = [sys.executable, "-m", "pip", "install", "-q", "--upgrade", "--target"]
    done = processes.run([*install, str(ENVIRONMENT), PIN, TEXTBOOK])
    if done.returncode != 0:
        raise Robo47Error(f"{PIN} could not be installed: {done.stderr.strip()[-300:]}")
    importlib.invalidate_caches()
    site.addsitedir(str(ENVIRONMENT))  # the environment exists now


def read_robot(entry: str) -> tuple[Any, Any, Any]:
    """Return Pinocchio, and its model and data of an entry."""
    import pinocchio as pin

    folder = files.panda_folder()
    if folder is None:
        raise Robo47Error("no Panda here; run python3 scripts/fetch_menagerie.py first")
    model = pin.buildModelFromMJCF(str(folder / f"{entry}.xml"))
    return pin, model, model.createData()


def ask_for_poses() -> dict:
    """Return Pinocchio's poses of both entries at seeded configurations."""
    answers = {}
    for entry in ("panda", "panda_nohand"):
        q = verify.random_q(panda.load(entry), CONFIGURATIONS, SEED).round(6)
        pin, model, data = read_robot(entry)
        frames = [f.name for f in model.frames if f.type in (pin.BODY, pin.OP_FRAME)]
        poses: dict[str, list] = {name: [] for name in frames if name != "universe"}
        for row in q:
            pin.framesForwardKinematics(model, data, row)
            for name, rows in poses.items():
                T = data.oMf[model.getFrameId(name)].homogeneous
                rows.append(T[:3].ravel().tolist())
        answers[entry] = {"q": q.tolist(), "poses": poses}
    return {"pinocchio": pin.__version__, "entries": answers}


def ask_for_forces() -> dict:
    """Return Pinocchio's dynamics of panda_nohand at seeded motions.

    Mass matrix, torque of a motion, its part without acceleration, and how the kinetic
    energy changes with q: C^T qd.
    """
    pin, model, data = read_robot("panda_nohand")
    q = verify.random_q(panda.load("panda_nohand"), CONFIGURATIONS, SEED)
    rng = np.random.default_rng(SEED)
    motion = {"q": q, "qd": rng.uniform(-2, 2, q.shape)}
    motion["qdd"] = rng.uniform(-10, 10, q.shape)
    motion = {name: part.round(6) for name, part in motion.items()}
    answer = {name: part.tolist() for name, part in motion.items()}
    answer |= {"crba": [], "rnea": [], "bias": [], "slope": []}
    for row in zip(*motion.values(), strict=True):
        M = np.triu(pin.crba(model, data, row[0]))
        answer["crba"].append((M + np.triu(M, 1).T).tolist())
        answer["rnea"].append(pin.rnea(model, data, *row).tolist())
        answer["bias"].append(pin.nonLinearEffects(model, data, *row[:2]).tolist())
        C = pin.computeCoriolisMatrix(model, data, *row[:2])
        answer["slope"].append((C.T @ row[1]).tolist())
    return {"pinocchio": pin.__version__, "panda_nohand": answer}


def ask_for_jacobians() -> dict:
    """Return three Jacobians of Pinocchio's and the textbook's, of panda_nohand."""
    import modern_robotics as mr

    pin, model, data = read_robot("panda_nohand")
    ours = panda.load("panda_nohand")
    q = verify.random_q(ours, JACOBIANS, SEED).round(6)
    frame = model.getFrameId(panda.END_FRAME["panda_nohand"].partition(":")[2])
    S = panda.screws(ours).T
    M = panda.home_pose(ours)
    B = mr.Adjoint(mr.TransInv(M)) @ S
    jacobian = pin.computeFrameJacobian
    turned = [3, 4, 5, 0, 1, 2]  # the order becomes (omega; v)
    ask: dict[str, Any] = {
        kind: lambda row, r=r: jacobian(model, data, row, frame, r)[turned]
        for kind, r in pin.ReferenceFrame.names.items()
    }
    ask["FKinSpace"] = lambda row: mr.FKinSpace(M, S, row)[:3]
    ask["FKinBody"] = lambda row: mr.FKinBody(M, B, row)[:3]
    ask["JacobianSpace"] = lambda row: mr.JacobianSpace(S, row)
    ask["JacobianBody"] = lambda row: mr.JacobianBody(B, row)
    answers = {
        name: [(np.round(f(row), 15) + 0.0).ravel().tolist() for row in q]
        for name, f in ask.items()
    }
    return {"pinocchio": pin.__version__, "q": q.tolist(), "answers": answers}


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
    "pinocchio_panda.json": ask_for_poses,
    "dynamics_oracle.json": ask_for_forces,
    "kinematics_oracle.json": ask_for_jacobians,
}


def main() -> int:
    """Write the oracle files, or check them."""
    parser = cli.parser(__doc__)
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    options = parser.parse_args()
    bring_pinocchio()
    all_same = True
    for name, ask_anew in ORACLES.items():
        path = DATA / name
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
