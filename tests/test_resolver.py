"""Every Python from 3.11 to 3.15 gets what it asks for, from wheels alone."""

import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from setup_env import WITHOUT_WHEELS

from conftest import need
from robo47.paths import ROOT

PYTHONS = ["3.11.9", "3.12", "3.13", "3.14", "3.15"]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
EXTRAS = sorted(PROJECT["optional-dependencies"])


def resolves(python: str, *extras: str) -> subprocess.CompletedProcess:
    """Ask a resolver for the pinned versions; markers are those of that Python."""
    here = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    uv = shutil.which("uv", path=here)
    need(uv is not None, "uv, a resolver: pip install uv")
    chosen = [word for extra in extras for word in ("--extra", extra)]
    command = [uv, "pip", "compile", "-q", "--no-header", "--no-annotate"]
    command += ["pyproject.toml", "-c", "constraints.txt", "--only-binary", ":all:"]
    command += ["--python-version", python, "--python-platform", "linux", *chosen]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True)


@pytest.mark.kit
@pytest.mark.network
@pytest.mark.parametrize("python", PYTHONS)
def test_all_that_is_said_to_work_resolves(python):
    version = tuple(map(int, python.split(".")[:2]))
    extras = [e for e in EXTRAS if e not in WITHOUT_WHEELS.get(version, ())]
    done = resolves(python, *extras)
    assert done.returncode == 0, done.stderr
    assert "mujoco==" in done.stdout


@pytest.mark.soak  # a wheel that appears is good news, and no fault of a commit
@pytest.mark.network
@pytest.mark.parametrize(
    ("version", "extra"), [(v, e) for v, some in WITHOUT_WHEELS.items() for e in some]
)
def test_what_is_said_to_have_no_wheels_has_none(version, extra):
    """When this fails the newest Python has caught up: take it off the list."""
    assert resolves(".".join(map(str, version)), extra).returncode != 0
