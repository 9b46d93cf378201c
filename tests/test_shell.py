"""A student's shell: variables for another Python, and where a command is typed."""

import os
import re
import shutil
import subprocess
import sys

import pytest

from conftest import ROOT, SKIPPED, need, run_copy
from labkit.base import shell

pytestmark = pytest.mark.kit

MAKEFILE = (ROOT / "Makefile").read_text("utf-8").replace("\\\n", " ")
VERBS = re.search(r"^VERBS := (.*)", MAKEFILE, re.M)[1].split()


def make(folder, *goals, **variables):
    """Run make in a folder; return the process, ended."""
    need(shutil.which("make") is not None, "make")
    # When make itself runs the tests, its flags and its ARGS would reach this make too.
    outer = {k: v for k, v in os.environ.items() if "MAKE" not in k and k != "ARGS"}
    return subprocess.run(
        ["make", *goals],
        cwd=folder,
        env={**outer, **variables},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


@pytest.fixture
def foreign(tmp_path):
    """A folder as another Python has on its path: its modules fail here."""
    folder = tmp_path / "other"
    folder.mkdir()
    for name in ("numpy", "mujoco", "typing", "subprocess", "tqdm"):
        (folder / f"{name}.py").write_text("raise SystemError('of another Python')\n")
    return {
        "PYTHONPATH": str(folder),
        "PYTHONSAFEPATH": "1",
        "PYTHONINSPECT": "1",
        "PYTHONSTARTUP": str(folder / "numpy.py"),
        "PYTEST_ADDOPTS": "--no-such-option",
        "PYTEST_PLUGINS": "launch_testing",
    }


def test_make_leaves_out_what_the_list_names():
    listed = re.search(r"^OTHERS := (.*)", MAKEFILE, re.M)[1].split()
    assert tuple(listed) == shell.NAMES
    assert re.search(r"^unexport \$\(OTHERS\)$", MAKEFILE, re.M)


@pytest.mark.parametrize(
    "script", ["check_day.py", "run_day.py", "start_day.py", "setup_env.py"]
)
def test_a_script_runs_without_what_is_set_for_another_python(clone, foreign, script):
    """The first Python that starts has it all: what it imports stands before it."""
    done = subprocess.run(
        [sys.executable, clone / "scripts" / script, "--help"],
        env={**os.environ, **foreign, "PYTHONPATH": foreign["PYTHONPATH"]},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
    )
    if script == "setup_env.py":
        assert (done.returncode, done.stderr) == (0, "")
    else:  # a clone without .venv gets as far as that
        assert "the kit is not set up" in done.stderr
        assert done.stderr.count("\n") == 1


def test_a_copy_on_the_path_is_the_kits_own_and_the_rest_goes(clone, foreign):
    path = os.pathsep.join([foreign["PYTHONPATH"], str(clone)])
    started = run_copy(clone, "scripts/start_day.py", "1", PYTHONPATH=path)
    assert (started.returncode, started.stderr) == (0, "")
    lab = "w1-foundations/work/day1_transforms.py"
    others = {**foreign, "PYTHONPATH": path, "PYTHONSAFEPATH": ""}
    done = run_copy(clone, lab, "--no-log", **others)
    assert "to do" in done.stderr
    assert "another Python" not in done.stderr + done.stdout


def test_what_is_left_out_is_remembered_for_the_doctor():
    variables = {"PYTHONPATH": os.pathsep.join(["/ros", str(ROOT)]), "PYTHONHOME": "/x"}
    left = shell.without(variables, str(ROOT))
    assert left == {"PYTHONPATH": str(ROOT), shell.FOUND: "PYTHONPATH PYTHONHOME"}
    assert shell.without(left, str(ROOT)) == left


def test_the_doctor_names_what_is_set(foreign):
    done = make(ROOT, "doctor", **foreign)
    found = [x for x in done.stdout.split("\nn") if x.startswith("ote  shell")]
    assert len(found) == 1, done.stdout + done.stderr
    (line,) = found
    for name in foreign:
        assert name in line
    others = re.findall(r"^todo +(\w+)", done.stdout, re.M)
    assert "MuJoCo" not in others
    assert "pictures" not in others


def test_a_foreign_pytest_plugin_does_not_stop_make_test(foreign, tmp_path):
    """ROS brings plugins by PYTHONPATH, which need what the kit does not have."""
    info = tmp_path / "other" / "launch_testing-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Name: launch-testing\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[pytest11]\nlaunch = launch_testing\n")
    arguments = "ARGS=--collect-only -q tests/test_text.py"
    done = make(ROOT, "test", arguments, **foreign)
    assert done.returncode == 0, done.stderr
    assert "tests/test_text.py" in done.stdout


def folders():
    """Return the folders of the kit, without what git ignores."""
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    need(listed.returncode == 0, "a repository")
    files = [ROOT / name for name in listed.stdout.splitlines()]
    return {parent for file in files for parent in file.relative_to(ROOT).parents}


def test_no_folder_lets_make_find_that_nothing_is_to_be_done():
    """A file or folder that has a command's name, without a Makefile, is up to date."""
    bare = {
        (str(folder), name)
        for folder in folders()
        for name in VERBS
        if not str(folder).startswith((".c", "tests"))  # no student works there
        and (ROOT / folder / name).exists()
        and not (ROOT / folder / "Makefile").exists()
    }
    assert not bare


@pytest.mark.parametrize("folder", ["labkit", "robo47", "w1-foundations"])
def test_a_command_typed_in_another_folder_is_the_kits(folder):
    text = (ROOT / folder / "Makefile").read_text("utf-8")
    assert text == (ROOT / "w1-foundations" / "Makefile").read_text("utf-8")
    done = make(ROOT / folder, "-n", "check", "DAY=1")
    assert "scripts/check_day.py 1" in done.stdout


def test_a_mistyped_command_is_told_what_it_may_be():
    done = make(ROOT, "chekc", "DAY=1")
    assert done.returncode == 2
    first = done.stderr.splitlines()[0]
    assert first == (
        "error: make chekc is no command of the kit. Do you mean make check?"
    )
    assert "All commands: make help" in make(ROOT, "xyzzy").stderr


def test_the_tests_pass_whatever_a_students_folder_holds(clone):
    """Their own conftest.py and tests, MuJoCo's log, a report, a broken lab."""
    shutil.copytree(ROOT / "tests", clone / "tests", ignore=SKIPPED)
    for name in ("conftest.py", "pyproject.toml", "constraints.txt"):
        shutil.copy(ROOT / name, clone)
    work = clone / "w1-foundations" / "work"
    work.mkdir()
    (work / "conftest.py").write_text("import nothing_at_all\n")
    (work / "test_mine.py").write_text("def test_x(): raise ValueError\n")
    (work / "day1_transforms.py").write_text("this is no ( Python\n")
    (work / "random.py").write_text("x = 1\n")
    (clone / "MUJOCO_LOG.TXT").write_text("WARNING: Nan in QACC\n")
    (clone / "metrics" / "report.html").write_text("of an older run")
    (clone / "metrics" / "metrics.csv").write_text("not,the,header\n")
    exploding = "w2-autonomy/day14/test_day14.py"  # MuJoCo writes its log there
    days = ("w1-foundations", exploding, "-k", "explodes or test_day1.py")
    done = run_copy(clone, "-m", "pytest", "-q", "-n", "0", *days)
    assert done.returncode == 0, done.stdout
    assert "test_mine" not in done.stdout
