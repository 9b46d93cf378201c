"""What every test file shares: the robot, a clean environment, and honest skips."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import mujoco
import pytest

from robo47 import menagerie, panda

ROOT = Path(__file__).resolve().parent.parent


def need(available: bool, what: str) -> None:
    """Skip a test for want of something, or fail where CI was to install it."""
    if not available:
        if os.environ.get("ROBO47_CI"):
            pytest.fail(f"CI must provide {what}")
        pytest.skip(f"needs {what}")


@pytest.fixture
def real_panda() -> Path:
    """Return the real Panda's folder."""
    folder = menagerie.panda_folder()
    need(folder is not None, "the real Panda: python scripts/fetch_menagerie.py")
    assert folder is not None
    return folder


@pytest.fixture
def twin(monkeypatch: pytest.MonkeyPatch) -> None:
    """Hide the Menagerie, so that `panda.load` falls back to the twin."""
    monkeypatch.setattr(menagerie, "panda_folder", lambda: None)


@pytest.fixture(params=["real", "twin"])
def either_panda(request: pytest.FixtureRequest) -> mujoco.MjModel:
    """Return panda_nohand, once from the Menagerie and once from the twin."""
    request.getfixturevalue("real_panda" if request.param == "real" else "twin")
    return panda.load("panda_nohand")


@pytest.fixture
def clone(tmp_path):
    """Return a copy of the kit that a test may work in, without the lab's history."""
    copy = tmp_path / "clone"
    copy.mkdir()
    for name in ("robo47", "scripts", "w1-foundations", "metrics"):
        skipped = shutil.ignore_patterns("__pycache__", "work")
        shutil.copytree(ROOT / name, copy / name, ignore=skipped)
    return copy


@pytest.fixture
def run_in(clone):
    """Run a script of that copy as a student would, in a process of its own."""

    def run_script(script, *arguments, **environment):
        robots = os.environ.get("MENAGERIE_ROOT") or str(ROOT / "mujoco_menagerie")
        own = {"PYTHONPATH": str(clone), "COLUMNS": "80"}
        if Path(robots).is_dir():
            own["MENAGERIE_ROOT"] = robots
        return subprocess.run(
            [sys.executable, str(clone / script), *map(str, arguments)],
            cwd=clone,
            env={**os.environ, **own, **environment},
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=120,
            check=False,
        )

    return run_script


@pytest.fixture
def run():
    """Run a script of the kit as a person would, in a process of its own."""

    def run_script(
        script, *arguments, cwd=ROOT, stdin=None, timeout=120, **environment
    ):
        return subprocess.run(
            [sys.executable, str(ROOT / script), *map(str, arguments)],
            cwd=cwd,
            input=stdin,
            env={**os.environ, **{k: str(v) for k, v in environment.items()}},
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=timeout,
            check=False,
        )

    return run_script
