"""The kit as an installed package, with no clone around it."""

import os
import shutil
import subprocess
import sys
import tomllib

import pytest

from robo47.paths import ROOT

ROW = "dict(run_id='x', day=1, check='c', metric='m', value=1.0)"


@pytest.mark.kit
def test_a_row_goes_into_a_folder_of_the_users(tmp_path):
    site, home = tmp_path / "site-packages", tmp_path / "home"
    home.mkdir()
    for name in ("robo47", "labkit"):
        skipped = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / name, site / name, ignore=skipped)
    places = {"PYTHONPATH": str(site), "HOME": str(home), "USERPROFILE": str(home)}
    kept = {k: v for k, v in os.environ.items() if not k.startswith("ROBO47_")}
    code = f"from labkit import log; log.append_row(**{ROW})"
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**kept, **places},
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert ",c," in (home / "robo47" / "metrics" / "metrics.csv").read_text("utf-8")
    assert {path.name for path in site.iterdir()} == {"robo47", "labkit"}


def test_types_and_licences_go_with_it():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert all((ROOT / name).is_file() for name in project["license-files"])
    assert all((ROOT / name / "py.typed").is_file() for name in ("robo47", "labkit"))
