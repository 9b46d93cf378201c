"""Test whether this machine has what the labs need, and print a remedy if not.

    make doctor                       or, without make:
    python3 scripts/doctor.py
    python3 scripts/doctor.py --json  for tools

Paste the output when you ask for help: it contains no home folder and no user name.
Exit code: 0 no problem, 1 a line has a remedy.
"""

from __future__ import annotations  # it runs on old Pythons too

import functools
import json
import os
import platform
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from labkit.base import cli, processes, shell
from labkit.base.git import short_sha
from robo47.paths import ROOT

VENV_PYTHON = ROOT / ".venv" / processes.IN_VENV
OLDEST = (3, 11)
LEAST_FREE_GB = 1
_STRENGTH = {
    "bubblewrap": "bubblewrap, strong: student code sees no file of yours",
    "landlock": "Landlock, good: opens no file of yours, but sees names, sizes",
    "none": "none: student code runs with your rights",
}
SECONDS = 60

# It runs on bare Pythons, broken installs included: the standard library alone. What
# can fail is tried by a probe: code for a process of its own, whose `found` is wanted.
PYTHON_PROBE = "import platform; found = platform.python_version()"
VERSIONS_PROBE = """
from importlib import metadata
there = {one.metadata["Name"]: one.version for one in metadata.distributions()}
found = {name: there[name] for name in ("mujoco", "numpy") if name in there}
"""
MUJOCO_PROBE = """
import mujoco
mujoco.mj_forward(m := mujoco.MjModel.from_xml_string("<mujoco/>"), mujoco.MjData(m))
found = mujoco.__version__
"""
ROBOT_PROBE = """
from robo47 import panda
from robo47.panda import files as menagerie
from robo47.paths import menagerie_root
found = panda.provenance()
found["loads"] = panda.load("panda_nohand").nq
folder = menagerie.panda_folder()
if folder:
    record = menagerie.read_provenance().get("files")
    found["files"] = len(record or ())
    found["changed"] = menagerie.changed_files(folder, record or {})[:3]
    found["missing"] = menagerie.missing_files(folder)[:3]
"""
LESSONS_PROBE = """
from labkit.lesson.starter import is_kits
from labkit.lesson.day import all_days
from robo47.paths import shown
days = all_days()
others = [shown(day.source) for day in days if not is_kits(day)]
found = {"days": len(days), "others": others}
"""
NAMES_PROBE = """
from labkit.lesson.clash import clashes
from robo47.paths import ROOT, shown
found = [shown(path) for work in sorted(ROOT.glob("w*/work")) for path in clashes(work)]
"""
WALL_PROBE = """
from labkit.sandbox.process import wall
found = wall().name
"""
GL_PROBE = """
from labkit.figures import probe_backends
found = probe_backends()
"""


class Line(NamedTuple):
    """One finding: "good", "note" (fine, but know it) or "todo", and what to do."""

    status: str
    about: str
    found: str
    remedy: str = ""


def probe(python: str, code: str, gl: bool = False) -> tuple[Any, str]:
    """Run code elsewhere; return its `found`, or None and the last words.

    MUJOCO_GL stops MuJoCo's import where it is wrong: only the look at OpenGL gets it.
    """
    kept = dict(os.environ)
    if not gl:
        kept.pop("MUJOCO_GL", None)
    try:
        prints = f"{code}\nimport json; print(json.dumps(found))"
        command = [python, "-c", prints]
        done = processes.run(command, cwd=ROOT, env=kept, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return None, f"no answer after {SECONDS} s"
    except OSError as error:
        return None, str(error.strerror)
    try:
        return json.loads(done.stdout.splitlines()[-1]), ""
    except (ValueError, IndexError):
        said = done.stderr.strip().splitlines()
        return None, said[-1] if said else f"ended with code {done.returncode}"


def check_python(python: str) -> Line:
    """Python itself, and whether the kit's environment is there."""
    version = probe(python, PYTHON_PROBE)[0] or platform.python_version()
    own = python == str(VENV_PYTHON)
    found = version + (" in .venv" if own else ", no .venv")
    if tuple(int(part) for part in version.split(".")[:2]) < OLDEST:
        remedy = "The kit needs 3.11 or newer: install it, then "
        return Line("todo", "Python", found, remedy + "make day1 PYTHON=python3.13")
    if not own:
        broken = VENV_PYTHON.exists()
        remedy = ".venv does not start: make setup" if broken else "Set up: make day1"
        return Line("todo", "Python", found, remedy)
    return Line("good", "Python", found)


def check_kit() -> Line:
    """The kit's version and commit, by which somebody else has the same."""
    text = (ROOT / "robo47" / "__init__.py").read_text("utf-8")
    version = text.partition('__version__ = "')[2].partition('"')[0]
    commit = short_sha(ROOT)
    return Line("good", "kit", f"{version} ({commit})" if commit else version)


def check_platform() -> Line:
    """Operating system and processor."""
    release = platform.release()
    wsl = " (WSL)" if "microsoft" in release.lower() else ""
    parts = (platform.system(), release, platform.machine())
    return Line("good", "platform", " ".join(parts) + wsl)


def check_mujoco(python: str) -> Line:
    """MuJoCo: there, importable, computing; and the upgrade that leaves it broken."""
    version, why = probe(python, MUJOCO_PROBE)
    if version:
        return Line("good", "MuJoCo", version)
    installed = probe(python, VERSIONS_PROBE)[0] or {}
    if "mujoco" not in installed:
        return Line("todo", "MuJoCo", "not installed", "make setup")
    remedy = "make setup"
    if not installed["mujoco"].startswith("3.") and "numpy" in installed:
        # Version 4 split the package; upgrading in place deletes files of the new half.
        where = ".venv/" + processes.IN_VENV if python == str(VENV_PYTHON) else "python"
        remedy = where + " -m pip install --force-reinstall --no-deps"
        remedy += " mujoco mujoco-core mujoco-studio"
    found = "{} does not work: {}".format(installed["mujoco"], why)
    return Line("todo", "MuJoCo", found, remedy)


def check_robot(python: str) -> Line:
    """The Panda: its source, and whether its files are as they were fetched."""
    found, why = probe(python, ROBOT_PROBE)
    if found is None:
        return Line("todo", "robot", why.split("Robo47Error: ")[-1])
    if "files" not in found:
        says = "not fetched; the labs run on the embedded twin"
        return Line("note", "robot", says, "With a network: make robot")
    broken = sorted({*found["missing"], *found["changed"]})
    if broken:
        remedy = "Delete " + found["folder"] + ", then: make robot"
        return Line("todo", "robot", "not as fetched: " + ", ".join(broken), remedy)
    where = found["commit"] or "sha256 " + found["content"]
    hashes = "{} files match".format(found["files"]) if found["files"] else "no hashes"
    return Line("good", "robot", ", ".join([found["source"], where[:15], hashes]))


def check_lessons(python: str) -> Line:
    """The lab scripts of the lessons: the kit's own, or something saved over them."""
    found, why = probe(python, LESSONS_PROBE)
    if found is None:
        return Line("todo", "lessons", why.split("Robo47Error: ")[-1])
    if found["others"]:
        says = "not the kit's: " + ", ".join(found["others"])
        remedy = "To get it back: git checkout -- " + found["others"][0]
        return Line("todo", "lessons", says, remedy)
    return Line("good", "lessons", "days: {}".format(found["days"]))


def check_names(python: str) -> Line:
    """The student's files: none has the name of a module that a lab imports."""
    found, why = probe(python, NAMES_PROBE)
    if found is None:
        return Line("note", "names", "not tried: " + why)
    if not found:
        return Line("good", "names", "no file in work/ has a Python module's name")
    says = "has the name of a Python module: " + ", ".join(found)
    return Line("todo", "names", says, "Rename it, for example with my_ before it.")


def check_shell() -> Line:
    """Variables of the shell that are meant for another Python."""
    found = os.environ.get(shell.FOUND, "").split()
    found += shell.foreign(os.environ, str(ROOT))
    if not found:
        return Line("good", "shell", "nothing is set for another Python")
    says = "set for another Python: " + ", ".join(dict.fromkeys(found))
    says += "; the kit's commands leave it out"
    remedy = "Before you start .venv's Python yourself: unset " + " ".join(found)
    return Line("note", "shell", says, remedy)


def check_gl(python: str) -> Line:
    """Which OpenGL back ends really draw."""
    chosen = os.environ.get("MUJOCO_GL", "")
    found, why = probe(python, GL_PROBE, gl=True)
    if found is None:
        return Line("note", "pictures", "not tried: " + why)
    draws = [name for name, says in found.items() if says == "renders"]
    if draws:
        return Line("good", "pictures", "drawn with " + ", ".join(draws))
    why = "; ".join(name + ": " + says for name, says in found.items())
    if chosen:  # the one that was tried
        says = "MUJOCO_GL=" + chosen + " does not draw here: " + found[chosen.strip()]
        return Line("todo", "pictures", says, "Unset it: unset MUJOCO_GL")
    says = "nothing draws: " + why
    remedy = "Update the GPU's driver."
    if sys.platform.startswith("linux"):
        says = "nothing draws (" + why + ")"
        remedy = "Debian, Ubuntu: sudo apt install libegl1 libgl1 libosmesa6"
    return Line("todo", "pictures", says, remedy)


def check_wall(python: str) -> Line:
    """What keeps student code from this machine, which counts for who grades."""
    found, why = probe(python, WALL_PROBE)
    if found is None:
        return Line("note", "wall", why.split("Error: ")[-1])
    return Line("note" if found == "none" else "good", "wall", _STRENGTH[found])


def check_display() -> Line:
    """Whether a window can open."""
    if not sys.platform.startswith("linux"):
        return Line("good", "display", platform.system() + " has one")
    for name in ("WAYLAND_DISPLAY", "DISPLAY"):
        if os.environ.get(name):
            return Line("good", "display", name + " is set")
    return Line("note", "display", "none", "make view shows the arm in a browser")


def check_disk() -> Line:
    """Free space where the clone is."""
    free = shutil.disk_usage(str(ROOT)).free / 1e9
    found = f"{free:.0f} GB free"
    if free < LEAST_FREE_GB:
        return Line("todo", "disk", found, "Free about 1 GB.")
    return Line("good", "disk", found)


def check_git() -> Line:
    """Git, and whether commits will carry a name. The name itself is not shown."""
    if not shutil.which("git"):
        return Line("todo", "git", "not installed", "https://git-scm.com/downloads")
    values = {"user.name": '"Your Name"', "user.email": "you@example.org"}
    config = ["git", "-C", str(ROOT), "config"]
    told = {key: processes.run([*config, key]).stdout.strip() for key in values}
    missing = [key for key in values if not told[key]]
    if not missing:
        return Line("good", "git", "name and e-mail are set")
    each = [f"git config --global {key} {values[key]}" for key in missing]
    found = "does not know your " + " and ".join(missing)
    return Line("todo", "git", found, " && ".join(each))


def discreet(text: str) -> str:
    """Return text without home folders and user names."""
    for path, instead in ((ROOT, "."), (Path.home(), "~")):
        for written in (str(path), path.as_posix()):
            if len(written) > 1:
                text = text.replace(written, instead)
    return re.sub(r"(/home/|/Users/|[A-Za-z]:\\Users\\)[^/\\\s'\"]+", "~", text)


def examine() -> list[Line]:
    """Return every finding; a check that fails itself is a finding too."""
    own = VENV_PYTHON.exists() and probe(str(VENV_PYTHON), PYTHON_PROBE)[0]
    python = str(VENV_PYTHON) if own else sys.executable
    here = check_python(python)
    checks: list[Callable[[], Line]] = [check_kit, lambda: here, check_platform]
    checks += [check_shell]
    if here.status == "good":  # the other lines would repeat the same fault
        inside = [check_mujoco, check_robot, check_lessons, check_names]
        inside += [check_wall, check_gl]
        checks += [functools.partial(check, python) for check in inside]
    checks += [check_display, check_disk, check_git]
    lines = []
    for check in checks:
        try:
            line = check()
        except Exception as error:  # whatever it is, the other lines still count
            line = Line("note", "doctor", f"{type(error).__name__}: {error}")
        lines.append(Line(*(discreet(part) for part in line)))
    return lines


def as_text(line: Line) -> str:
    """Return a finding in 80 columns, what to do on lines of its own."""
    label = f"{line.status:5} {line.about:9} "
    text = cli.wrapped(label + line.found, " " * len(label))
    mood = "bad" if line.status == "todo" else line.status
    text = cli.paint(text[:5], mood) + text[5:]
    if line.remedy:
        text += "\n" + cli.wrapped(" " * 16 + "-> " + line.remedy, " " * 19)
    return text


def main() -> int:
    """Print the findings."""
    parser = cli.parser(__doc__)
    parser.add_argument("--json", action="store_true", help="print JSON")
    options = parser.parse_args()
    lines = examine()
    if options.json:
        print(json.dumps([line._asdict() for line in lines], indent=1))
    else:
        for line in lines:
            print(as_text(line))
    todo = any(line.status == "todo" for line in lines)
    return cli.EXIT_FAILED if todo else cli.EXIT_OK
