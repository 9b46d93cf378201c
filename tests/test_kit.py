"""Any Python will do: scripts go on in the kit's own one."""

import ast
import os
import shutil
import subprocess
import sys

import pytest

from conftest import ROOT, need

pytestmark = pytest.mark.kit


@pytest.fixture
def bare():
    """A Python without the kit: this one's base, isolated from its packages."""

    def run(script, *arguments):
        command = [sys._base_executable, "-S", str(script), *arguments]
        quiet = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
        return subprocess.run(
            command, env=quiet, capture_output=True, text=True, check=False
        )

    return run


SCRIPTS = [
    path
    for path in sorted((ROOT / "scripts").glob("*.py"))
    if path.stem != "kit"  # which is imported
]


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_every_script_helps_from_a_bare_python(bare, path):
    need((ROOT / ".venv").exists(), "the kit's own .venv: make day1")
    done = bare(path, "--help")
    assert done.returncode == 0, done.stderr
    assert "usage: " in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_every_script_helps_without_the_extras():
    extras = ["PIL", "matplotlib", "jupytext", "distributed", "viser", "sphinx"]
    code = f"""
import runpy, sys
sys.path.insert(0, "")
sys.modules.update(dict.fromkeys({extras}))
for path in {list(map(str, SCRIPTS))}:
    sys.argv = [path, "--help"]
    try:
        runpy.run_path(path, run_name="__main__")
    except SystemExit as end:
        assert not end.code, path
"""
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=ROOT / "scripts", capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.count("usage: ") == len(SCRIPTS)


READ_FIRST = [  # by whatever Python starts a script
    *sorted((ROOT / "scripts").glob("*.py")),
    *(ROOT / "labkit" / name for name in ("__init__.py", "base/__init__.py")),
    ROOT / "labkit" / "base" / "shell.py",
]


@pytest.mark.parametrize("path", READ_FIRST, ids=lambda path: path.name)
def test_every_script_can_be_read_by_an_old_python_which_then_hands_on(path):
    """3.6 reads as 3.7 does, but cannot be asked for here."""
    tree = ast.parse(path.read_text("utf-8"), feature_version=(3, 7))
    for node in ast.walk(tree):
        assert not isinstance(node, ast.JoinedStr | ast.AnnAssign | ast.NamedExpr)
        if isinstance(node, ast.FunctionDef):
            assert node.returns is None
            assert not node.args.kwonlyargs
            assert all(arg.annotation is None for arg in node.args.args)
        if isinstance(node, ast.List | ast.Tuple):
            assert not any(isinstance(item, ast.Starred) for item in node.elts)


def test_make_helps_in_80_columns():
    need(shutil.which("make") is not None, "make")
    done = subprocess.run(
        ["make", "help"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert max(map(len, done.stdout.splitlines())) <= 80
    assert "make day1 " in done.stdout


@pytest.fixture
def lab(tmp_path):
    """A lab that starts as the labs do, in a folder like the clone's."""
    for folder in ("scripts", "w1-foundations/src", "w1-foundations/work"):
        (tmp_path / folder).mkdir(parents=True)
    shutil.copy(ROOT / "scripts/kit.py", tmp_path / "scripts")
    shutil.copytree(ROOT / "labkit", tmp_path / "labkit")
    shutil.copy(ROOT / "w1-foundations/src/kit.py", tmp_path / "w1-foundations/work")
    script = tmp_path / "w1-foundations/work/day1_lab.py"
    script.write_text("import kit\nimport numpy\nprint(numpy.__file__)\n")
    return script


def test_a_lab_goes_on_in_the_kits_own_python(bare, lab):
    need((ROOT / ".venv").exists(), "the kit's own .venv: make day1")
    own = lab.parents[2] / ".venv" / "bin" / "python"
    own.parent.mkdir(parents=True)
    shutil.copytree(ROOT / "robo47", lab.parents[2] / "robo47")
    path = f"PYTHONPATH={lab.parents[2]} {ROOT}/.venv/bin/python"
    own.write_text(f'#!/bin/sh\n{path} "$@"\n')
    own.chmod(0o755)
    done = bare(lab)
    assert (done.returncode, done.stderr) == (0, "")
    assert ".venv" in done.stdout


def test_the_python_of_another_clone_is_not_used(clone):
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
    command = [sys.executable, clone / "scripts" / "start_day.py", "1"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert "the kit is not set up. Run `make setup`" in done.stderr


def test_a_lab_outside_a_clone_needs_no_help(lab, run):
    (lab.parents[2] / "scripts/kit.py").unlink()
    done = run(lab)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="MUJOCO_GL is Linux's")
@pytest.mark.parametrize("script", ["check_day.py", "view_panda.py"])
def test_a_mujoco_gl_that_mujoco_refuses_is_one_line_with_its_cure(run, clone, script):
    lab = clone / "w1-foundations/src/day1_transforms.py"
    options = ["1", "--file", lab] if script == "check_day.py" else ["--web"]
    done = run(f"scripts/{script}", *options, MUJOCO_GL="nonsense")
    assert done.returncode == 2
    assert done.stderr == (
        "error: MuJoCo cannot use MUJOCO_GL=nonsense here. Unset it: unset MUJOCO_GL\n"
    )


@pytest.mark.parametrize("broken", [False, True])
def test_without_an_environment_or_with_a_broken_one_it_says_what_to_run(
    bare, lab, broken
):
    clone = lab.parents[2]
    shutil.copy(ROOT / "scripts/check_day.py", clone / "scripts")
    if broken:  # it must not go in circles
        command = [sys.executable, "-m", "venv", "--without-pip", clone / ".venv"]
        subprocess.run(command, check=True)
    for command in ((clone / "scripts/check_day.py", "1"), (lab,)):
        done = bare(*command)
        assert done.returncode == 2
        found = "not set up completely" if broken else "not set up"
        assert done.stderr.startswith(f"error: the kit is {found}. Run `make setup`")
        assert done.stderr.count("\n") == 1


def test_ctrl_c_while_mujoco_is_imported_is_one_word(run, tmp_path):
    script = tmp_path / "lab.py"
    script.write_text(
        f"import sys; sys.path.insert(0, {str(ROOT / 'scripts')!r}); import kit\n"
        "raise ImportError('initialization failed') from KeyboardInterrupt()\n"
    )
    done = run(script)
    assert (done.returncode, done.stderr) == (130, "\nstopped\n")


@pytest.mark.parametrize("late", [False, True])
@pytest.mark.parametrize("where", ["labkit/commands/check.py", "labkit/base/cli.py"])
def test_a_crash_of_the_kit_is_neither_passed_nor_not_yet(run_in, clone, where, late):
    module = clone / where
    text = module.read_text("utf-8")
    if late:  # in a function, else while it is imported
        first = "    day = chosen_day(" if "check" in where else "    with _code_of_not"
        assert first in text
        module.write_text(text.replace(first, f"    1 / 0\n{first}", 1), "utf-8")
    else:
        module.write_text(f"{text}\n1 / 0\n", "utf-8")
    done = run_in("scripts/check_day.py", "1")
    assert done.returncode == 70
    assert "ZeroDivisionError" in done.stderr
    assert done.stderr.splitlines()[-1].startswith("This is a fault of the kit. Please")


def test_a_students_own_script_that_fails_is_no_fault_of_the_kit(run, tmp_path):
    script = tmp_path / "practice.py"
    script.write_text(
        f"import sys; sys.path.insert(0, {str(ROOT / 'scripts')!r}); import kit; 1 / 0"
    )
    done = run(script)
    assert done.returncode == 1
    assert "fault of the kit" not in done.stderr


def test_make_asks_for_a_code_of_not_yet_that_no_crash_has(run_in):
    assert run_in("scripts/start_day.py", "1").returncode == 0
    asked = {"ROBO47_NOT_YET": "75"}
    assert run_in("scripts/check_day.py", "1", **asked).returncode == 75
    assert run_in("scripts/check_day.py", "1").returncode == 1
    assert run_in("scripts/run_day.py", "1", "--no-log", **asked).returncode == 75
    assert run_in("scripts/check_day.py", "99", **asked).returncode == 2


@pytest.mark.parametrize(("code", "ends"), [(75, 0), (0, 0), (70, 2), (1, 2), (2, 2)])
def test_make_takes_not_yet_alone_for_no_error(tmp_path, code, ends):
    need(shutil.which("make") is not None, "make")
    lines = (ROOT / "Makefile").read_text("utf-8").splitlines()
    own = [
        line for line in lines if line.startswith(("export ROBO47_NOT", "NOT_YET ="))
    ]
    assert len(own) == 2
    recipe = ["it:", f"\t@sh -c 'exit {code}' $(NOT_YET)"]
    (tmp_path / "Makefile").write_text("\n".join([*own, *recipe, ""]))
    done = subprocess.run(["make", "it"], cwd=tmp_path, capture_output=True)
    assert done.returncode == ends
