"""Every Python from 3.11 to 3.15 gets what it asks for, from wheels alone."""

import contextlib
import os
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from setup_env import WITHOUT_WHEELS

from conftest import need
from robo47.paths import ROOT

PYTHONS = ["3.11.9", "3.12", "3.13", "3.14", "3.15"]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
EXTRAS = sorted(PROJECT["optional-dependencies"])


def asked(python: str, *extras: str) -> subprocess.Popen:
    """Ask a resolver for the pinned versions; markers are those of that Python."""
    here = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    uv = shutil.which("uv", path=here)
    need(uv is not None, "uv, a resolver: pip install uv")
    chosen = [word for extra in extras for word in ("--extra", extra)]
    command = [uv, "pip", "compile", "-q", "--no-header", "--no-annotate"]
    command += ["pyproject.toml", "-c", "constraints.txt", "--only-binary", ":all:"]
    command += ["--python-version", python, "--python-platform", "linux", *chosen]
    pipe = subprocess.PIPE
    return subprocess.Popen(command, cwd=ROOT, stdout=pipe, stderr=pipe, text=True)


@pytest.fixture(scope="module")
def answers() -> Iterator[dict[str, subprocess.Popen]]:
    """Ask for all Pythons at once: most of the time goes by waiting for an index."""
    with contextlib.ExitStack() as ends:
        found = {}
        for python in PYTHONS:
            version = tuple(map(int, python.split(".")[:2]))
            extras = [e for e in EXTRAS if e not in WITHOUT_WHEELS.get(version, ())]
            found[python] = ends.enter_context(asked(python, *extras))
        yield found


@pytest.mark.kit
@pytest.mark.network
@pytest.mark.parametrize("python", PYTHONS)
def test_all_that_is_said_to_work_resolves(python, answers):
    said, complained = answers[python].communicate()
    assert answers[python].returncode == 0, complained
    assert "mujoco==" in said


@pytest.mark.soak  # a wheel that appears is good news, and no fault of a commit
@pytest.mark.network
@pytest.mark.parametrize(
    ("version", "extra"), [(v, e) for v, some in WITHOUT_WHEELS.items() for e in some]
)
def test_what_is_said_to_have_no_wheels_has_none(version, extra):
    """When this fails the newest Python has caught up: take it off the list."""
    with asked(".".join(map(str, version)), extra) as process:
        process.communicate()
    assert process.returncode != 0
