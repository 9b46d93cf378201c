"""What the lab's end does with the rows of its run."""

import subprocess
import sys
from pathlib import Path

import pytest

from robo47.errors import Robo47Error
from robo47.lesson.lab import Lab
from robo47.metrics import read_rows
from robo47.metrics.header import LINE
from robo47.paths import ROOT


@pytest.fixture
def log(monkeypatch, tmp_path) -> Path:
    path = tmp_path / "m.csv"
    monkeypatch.setattr("robo47.lesson.lab.METRICS_CSV", path)
    monkeypatch.setattr("robo47.metrics.METRICS_CSV", path)
    monkeypatch.setattr(sys, "argv", ["lab"])
    return path


def lab_with(*values: float) -> Lab:
    lab = Lab(1, "test_lab", "")
    for value in values:
        lab.record("fk", "err", value, 1e-8)
    return lab


def test_the_rows_of_a_run_are_logged_together(log, capsys):
    assert lab_with(1e-9, float("nan")).finish() == 0
    assert [row["n_failures"] for row in read_rows(log)] == [0, 1]
    assert "logged 2 rows to" in capsys.readouterr().out
    lab_with(1e-9).finish()
    assert "logged 1 row to" in capsys.readouterr().out


def test_a_log_that_refuses_costs_no_row_of_the_run(log):
    log.write_text(LINE.replace("value", "val") + "\n")
    with pytest.raises(Robo47Error) as caught:
        lab_with(1e-9, 2e-9, 3e-9).finish()
    kept = Path(f"{log}.unsaved").read_text().splitlines()
    assert len(kept) == 3
    assert all(f"  row: {text}\n" in str(caught.value) for text in kept)


def test_the_day_itself_keeps_both_its_rows_when_the_log_refuses(tmp_path):
    log = tmp_path / "m.csv"
    log.write_text(LINE.replace("value", "val") + "\n")
    script = (
        "import os, runpy, sys; os.environ['ROBO47_METRICS'] = sys.argv.pop(1)\n"
        "runpy.run_path('w1-foundations/src/day1_transforms.py', run_name='__main__')"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, str(log)],
        cwd=ROOT,
        capture_output=True,
        encoding="utf-8",
    )
    assert done.returncode == 2
    assert done.stderr.count("  row: day1_transforms,") == 2
    assert Path(f"{log}.unsaved").read_text().count("\n") == 2
