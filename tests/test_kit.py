"""Any Python will do: scripts go on in the kit's own one."""

import os
import shutil
import subprocess
import sys

import pytest

from conftest import ROOT, need


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


@pytest.mark.parametrize(
    "path", sorted((ROOT / "scripts").glob("*.py")), ids=lambda path: path.name
)
def test_every_script_helps_from_a_bare_python(bare, path):
    need((ROOT / ".venv").exists(), "the kit's own .venv: make day1")
    if path.name == "kit.py":
        return
    done = bare(path, "--help")
    assert done.returncode == 0, done.stderr
    assert "usage: " in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 88


def test_without_an_environment_it_says_what_to_run(bare, tmp_path):
    shutil.copytree(ROOT / "scripts", tmp_path / "scripts")
    done = bare(tmp_path / "scripts" / "check_day.py", "1")
    assert done.returncode == 1
    assert done.stderr.startswith("error: the kit is not set up. Run `make setup`")
    assert done.stderr.count("\n") == 1


def test_a_broken_environment_does_not_go_in_circles(bare, tmp_path):
    shutil.copytree(ROOT / "scripts", tmp_path / "scripts")
    subprocess.run(
        [sys.executable, "-m", "venv", "--without-pip", str(tmp_path / ".venv")],
        check=True,
    )
    done = bare(tmp_path / "scripts" / "check_day.py", "1")
    assert done.returncode == 1
    assert "not set up completely. Run `make setup`" in done.stderr
