"""Run the tests on the oldest and the newest MuJoCo and Python that the kit supports.

    make test-matrix                                  all four
    python3 scripts/test_matrix.py --mujoco 3.10.0     another MuJoCo
    python3 scripts/test_matrix.py --pytest "-k se3"   only some of the tests

Each pair gets an environment of its own, .venv-matrix/…, made once. A Python that this
machine does not have, on its PATH or from pyenv, is named and left out; in CI
(ROBO47_CI=1) it is a failure.
"""

import os
import re
import shlex
import shutil
import sys
from pathlib import Path

from labkit.base import cli, processes, shell
from robo47.errors import Robo47Error
from robo47.paths import ROOT

PYTHONS = ("3.11", "3.13")
MUJOCOS = ("3.3.0", "4.0.0")  # pyproject.toml's floor, and constraints.txt's pin
FOLDER = ROOT / ".venv-matrix"


def find_python(version: str) -> str | None:
    """Return the path of a Python that starts and has that version."""
    test = f"import sys; sys.exit('%d.%d' % sys.version_info[:2] != {version!r})"
    known = map(shutil.which, (f"python{version}", "python3", sys.executable))
    for path in filter(None, [*known, *pyenvs(version)]):
        if processes.run([path, "-c", test]).returncode == 0:
            return path
    return None


def pyenvs(version: str) -> list[str]:
    """Return the Pythons of a version that pyenv has: on PATH is only what it chose."""
    root = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv")
    return [str(path) for path in root.glob(f"versions/{version}*/bin/python")]


def environment(python: str, version: str, mujoco: str) -> Path:
    """Return the Python of an environment with that MuJoCo, making it on first use."""
    home = FOLDER / f"python{version}-mujoco{mujoco}"
    inside = home / processes.IN_VENV
    ready = home / ".ready"
    if ready.exists():
        return inside
    pins = (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    kept = [pin for pin in pins if not re.match(r"mujoco(-core|-studio)?==", pin)]
    FOLDER.mkdir(exist_ok=True)
    constraints = FOLDER / f"constraints-{mujoco}.txt"
    constraints.write_text("\n".join([*kept, f"mujoco=={mujoco}"]) + "\n", "utf-8")
    run([python, "-m", "venv", "--clear", str(home)])
    install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    run([str(inside), *install, "-c", str(constraints), "-e", ".[test]"])
    ready.touch()
    return inside


def run(command: list[str]) -> None:
    """Run a quiet command in the clone, or say how it failed."""
    pip = command[1:3] == ["-m", "pip"]
    settings = shell.for_pip(command[0]) if pip else None
    done = processes.run(command, cwd=ROOT, env=settings)
    if done.returncode != 0:
        why = done.stderr[-500:].strip()
        raise Robo47Error(f"`{shlex.join(command)}` failed: {why}")


def main() -> int:
    """Run every pair and print one line for each."""
    parser = cli.parser(__doc__)
    parser.add_argument("--python", nargs="+", default=PYTHONS, metavar="X.Y")
    parser.add_argument("--mujoco", nargs="+", default=MUJOCOS, metavar="X.Y.Z")
    parser.add_argument("--pytest", default="", help="options for pytest, in quotes")
    options = parser.parse_args()
    failed = False
    lines = []
    for version in options.python:
        path = find_python(version)
        for mujoco in options.mujoco:
            name = f"Python {version}, MuJoCo {mujoco}"
            if path is None:
                failed = failed or bool(os.environ.get("ROBO47_CI"))
                lines.append(f"left out  {name}: no such Python on this machine")
                continue
            print(f"matrix: {name} ...", flush=True)
            inside = environment(path, version, mujoco)
            tests = [str(inside), "-m", "pytest", "-q", *shlex.split(options.pytest)]
            # It has what `make test` needs: for want of an extra a test may skip.
            others = {k: v for k, v in os.environ.items() if k != "ROBO47_CI"}
            done = processes.run(tests, cwd=ROOT, env=others)
            if done.returncode:
                failed = True
                print(done.stdout + done.stderr)
            verdict = "FAIL" if done.returncode else "PASS"
            lines.append(f"{verdict:8}  {name}: {done.stdout.splitlines()[-1]}")
    print("\n".join(lines))
    return cli.EXIT_FAILED if failed else cli.EXIT_OK
