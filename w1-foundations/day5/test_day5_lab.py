"""Day 5's lab as a person runs it."""

import pytest

from conftest import ROOT, kits_worksheet, load_script
from labkit.lesson.day import find_day
from labkit.lesson.lab import predictions
from labkit.log import read_rows

pytestmark = pytest.mark.kit

SCRIPT = "w1-foundations/src/day5_control.py"
lab = load_script(ROOT / SCRIPT)


def test_the_lab_fits_80_columns_and_logs_its_three_rows(run, tmp_path):
    log = tmp_path / "metrics.csv"
    done = run(SCRIPT, ROBO47_METRICS=log)
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert lines[-1] == "All checks PASSED."
    assert max(len(line) for line in lines if not line.startswith("logged")) <= 80
    assert done.stdout.count("PASS  ") == 17
    assert done.stdout.count("predicted") >= 8
    rows = {row["check"]: row for row in read_rows(log)}
    assert rows["sag_predicted"]["value"] < 1e-11
    assert 0.01 < rows["error_dynamics"]["value"] < 0.02
    assert 0.2 < rows["tracking"]["value"] < 0.3
    assert {row["day"] for row in rows.values()} == {5}


def test_each_prediction_of_the_worksheet_is_printed_beside_its_measurement(
    monkeypatch, capsys
):
    rows = predictions(kits_worksheet(find_day(5)).replace("*(your prediction)*", "9"))
    monkeypatch.setattr("labkit.lesson.lab.predictions", lambda text: rows)
    monkeypatch.setattr("sys.argv", ["day5", "--no-log"])
    assert lab.main() == 0
    said = " ".join(capsys.readouterr().out.split())
    for number, measured in zip(rows, ("190.4", "0.1953", "225.1")):
        assert f"you predicted 9, measured {measured}: {number}" in said


def test_without_the_side_quest_the_rows_are_logged_all_the_same(
    monkeypatch, tmp_path, capsys
):
    def gap(h):
        raise NotImplementedError("task 5.9")

    short = load_script(ROOT / SCRIPT)
    monkeypatch.setattr(short, "max_stable_omega", gap)
    monkeypatch.setattr("sys.argv", ["day5", "--no-log"])
    assert short.main() == 0
    assert "to do: task 5.9" in capsys.readouterr().out
