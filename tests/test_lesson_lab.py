"""What the lab's end does with the rows of its run."""

import hashlib
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from labkit.lesson.day import find_day
from labkit.lesson.lab import Lab
from labkit.lesson.metric import Metric
from labkit.log import read_rows
from labkit.log.rows import HEADER as LINE
from robo47.errors import Robo47Error

SCRIPT = find_day(1).source


@pytest.fixture
def log(monkeypatch, tmp_path) -> Path:
    path = tmp_path / "m.csv"
    monkeypatch.setattr("labkit.lesson.lab.METRICS_CSV", path)
    monkeypatch.setattr("labkit.log.METRICS_CSV", path)
    monkeypatch.setattr(sys, "argv", ["lab"])
    return path


def lab_with(*values) -> Lab:
    lab = Lab(str(SCRIPT), "A lab.")
    for value in values:
        lab.record("fk_by_hand", value)
    return lab


def test_the_rows_of_a_run_are_logged_together(log, capsys):
    assert lab_with(1e-9).finish() == 0
    assert "logged 1 row to" in capsys.readouterr().out
    assert lab_with(1e-9, float("nan")).finish() == 1
    assert [row["n_failures"] for row in read_rows(log)] == [0, 0, 1]
    assert "logged 2 rows to" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("error", "says", "value", "trials"),
    [
        (2e-8, "FAIL  fk by hand: 2.0e-08 (limit 1e-08)", 2e-8, 1),
        ([-0.5, 1e-9], "FAIL  fk by hand: 0.5", 0.5, 2),  # its absolute value
        (1e-8, "FAIL  fk by hand: 1.0e-08", 1e-8, 1),  # as the week and the check say
    ],
)
def test_checking_and_recording_is_one_call_with_the_manifests_limit(
    log, capsys, error, says, value, trials
):
    lab = lab_with(error)
    lab.check("e", error)
    assert lab.finish() == 1
    out = capsys.readouterr().out
    assert says in out
    assert says.replace("fk by hand", "e") in out
    (row,) = read_rows(log)
    found = (row["value"], row["n_trials"], row["n_failures"])
    assert found == (value, trials, 1)


@pytest.mark.parametrize(
    ("trials", "value", "code"), [(1.5, 1.5, 0), (0.5, 0.5, 1), ([1.2, 2.5], 2.5, 1)]
)
def test_a_number_with_a_min_and_a_max_is_judged_by_both(
    log, capsys, trials, value, code
):
    lab = Lab(str(SCRIPT), "A lab.")
    both = Metric("gain", "N", max=2.0, min=1.0)
    lab.day = replace(lab.day, metrics=(both,))
    lab.record("gain", trials)
    assert lab.finish() == code
    assert "(over 1 and under 2)" in capsys.readouterr().out
    (found,) = read_rows(log)
    assert (found["value"], found["n_failures"]) == (value, code)
    assert both.judge(found) == ("fail" if code else "pass")


def test_a_row_says_which_file_wrote_it(log):
    lab_with(1e-9).finish()
    (row,) = read_rows(log)
    digest = hashlib.sha256(SCRIPT.read_bytes()).hexdigest()
    assert row["notes"] == f"limit 1e-08; file {digest[:8]}"


def test_a_zero_prints_without_a_sign(log, capsys):
    """Which sign a rounding error has is the machine's: arm64 has another one."""
    lab = lab_with()
    lab.predicted = {"the sag, mm": "0"}
    lab.show("M", [[-1e-17, -0.0, -2e-6]])
    lab.predict("the sag", -1e-17, -4e-4, "mm")
    lab.measured("the sag, mm", -0.0)
    out = capsys.readouterr().out
    assert "    0.000000   0.000000  -0.000002" in out
    assert "predicted 0.000, measured 0.000 mm" in out
    assert "measured 0: the sag, mm" in out


def test_an_unknown_number_and_a_script_that_is_no_lab_are_refused(
    log,
):
    with pytest.raises(
        Robo47Error, match=r"no \[\[metrics\]\] called fk; it has fk_id"
    ):
        lab_with().record("fk", 0.0)
    with pytest.raises(Robo47Error, match=r"helpers\.py is no lab"):
        Lab("helpers.py", "")


def test_a_log_that_refuses_costs_no_row_and_no_word_of_how_it_went(log, capsys):
    log.write_text(LINE.replace("value", "val") + "\n")
    with pytest.raises(Robo47Error) as caught:
        lab_with(1e-9, 2.0, 3e-9).finish()
    kept = Path(f"{log}.unsaved").read_text().splitlines()
    assert len(kept) == 3
    assert all(f"  row: {text}\n" in str(caught.value) for text in kept)
    assert "FAILED: fk by hand is 2" in capsys.readouterr().out


@pytest.fixture
def own(monkeypatch, tmp_path) -> Path:
    """Return a worksheet beside a day whose script is the student's own copy."""
    day = replace(find_day(1), folder=tmp_path, worksheet="day1.md")
    monkeypatch.setattr("labkit.lesson.lab.day_of", lambda script: day)
    return tmp_path / "day1.md"


ROW = "| height of `ee`, m | {} | *(your number)* | |\n"


def test_a_prediction_stands_beside_what_is_measured(log, own, capsys):
    own.write_text(ROW.format("0.6, **half** a guess"))
    lab = Lab(str(own.parent / "work" / SCRIPT.name), "A lab.")
    lab.measured("height of ee, m", 0.59027)
    lab.measured("nobody asked", 1.0)
    out = capsys.readouterr().out
    assert out == (
        "  you predicted 0.6, **half** a guess, measured 0.5903: height of ee, m\n"
    )


@pytest.mark.parametrize("cell", ["*(your prediction)*", " ", "...", "-", "the kit's"])
def test_without_a_prediction_it_is_asked_for_and_no_number_said(
    log, own, capsys, cell
):
    own.write_text(ROW.format(cell))
    script = own.parent / "work" / SCRIPT.name
    script = SCRIPT if cell == "the kit's" else script  # which knows nobody's
    lab = Lab(str(script), "A lab.")
    lab.measured("height of ee, m", 1)
    asked = "Predict first: 1 prediction of yours is missing in day1.md."
    out = capsys.readouterr().out
    assert out.startswith(asked) if cell != "the kit's" else out == ""
    assert lab.finish() == 0
    hidden = "height of ee, m: hidden until you write your prediction in day1.md"
    assert (hidden in capsys.readouterr().out) == (cell != "the kit's")
    assert own.read_text() == ROW.format(cell)


def test_a_run_that_is_logged_writes_what_it_measured(log, own, monkeypatch):
    text = f"\ufeff# Day 1\n{ROW.format('0.6')}".replace("\n", "\r\n")
    own.write_bytes(text.encode())
    for options in (["lab", "--no-log"], ["lab", "--try"], ["lab"]):
        before = own.read_bytes()
        assert b"run of" not in before
        monkeypatch.setattr(sys, "argv", options)
        lab = Lab(str(own.parent / "work" / SCRIPT.name), "A lab.")
        lab.measured("height of ee, m", 0.59027)
        assert lab.finish() == 0
        assert (own.read_bytes() == before) == (len(options) == 2)
    assert b"| 0.6 | 0.5903 (run of " in own.read_bytes()
    assert own.read_bytes().endswith(b"\r\n")
    monkeypatch.setenv("ROBO47_METRICS", "elsewhere.csv")  # a look at the week
    lab.came_out = {"height of ee, m": 0.7}
    before = own.read_bytes()
    lab.finish()
    assert own.read_bytes() == before


def test_what_is_tried_is_measured_and_neither_judged_nor_logged(
    log, capsys, monkeypatch
):
    monkeypatch.setattr(sys, "argv", ["lab", "--try"])
    lab = lab_with(1.0)
    lab.check("e", float("nan"))
    lab.measured("no row of the worksheet", 1.0)
    assert lab.finish() == 0
    out = capsys.readouterr().out
    assert "  ----  fk by hand: 1" in out
    assert "  ----  e: nan" in out
    assert "not judged, nothing logged" in out
    assert not log.exists()
    for verdict in ("PASS", "FAIL"):
        assert verdict not in out


def test_what_is_tried_is_compared_with_no_prediction_for_the_unchanged_lab(
    log, own, capsys, monkeypatch
):
    own.write_text(ROW.format("0.6") + ROW.replace("height", "width").format(" "))
    monkeypatch.setattr(sys, "argv", ["lab", "--try"])
    lab = Lab(str(own.parent / "work" / SCRIPT.name), "A lab.")
    lab.measured("height of ee, m", 0.3)
    lab.measured("width of ee, m", 0.4)
    lab.predict("height of ee", 0.31, 0.3, "m")
    out = capsys.readouterr().out
    assert "you predicted" not in out
    assert "Predict first" not in out
    assert "  measured 0.3: height of ee, m\n  measured 0.4: width of ee, m\n" in out
    assert out.count("measured 0.3:") == 1  # the lab's own prediction has its line


def test_a_number_that_is_tried_keeps_its_sign(log, capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["lab", "--try"])
    lab_with(-294.0, [-2.0, 1.0])
    out = capsys.readouterr().out
    assert out == "  ----  fk by hand: -294\n  ----  fk by hand: 2\n"


def test_what_is_not_tried_is_judged(log, capsys):
    assert lab_with(1.0).finish() == 1
    assert "FAIL  fk by hand: 1" in capsys.readouterr().out
