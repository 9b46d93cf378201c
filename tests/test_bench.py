"""The bench: its results are the README's, its rivals are checked before timed."""

import json
import subprocess
import sys

import numpy as np
import pytest

from bench import (
    bench_dynamics,
    bench_first_minute,
    bench_fk,
    bench_growth,
    bench_ik,
    bench_metrics,
    command,
    table,
    timing,
)
from conftest import ROOT
from labkit.commands import test_matrix as matrix
from robo47 import kinematics, panda

pytestmark = pytest.mark.kit

RESULTS = json.loads((ROOT / "bench" / "results.json").read_text("utf-8"))
MISSING = "No module named 'it'"


def missing():
    raise ImportError(MISSING)


def test_candidates_take_turns_and_the_warm_up_is_not_counted():
    order = []
    timed = timing.take_turns({n: lambda n=n: order.append(n) for n in "ab"}, 3)
    assert "".join(order) == "abababab"
    assert set(timed) == {"a", "b"}
    assert timed["a"]["low"] <= timed["a"]["median"] <= timed["a"]["high"]


def test_the_general_path_is_timed_on_a_robot_that_has_nothing_to_fold(twin):
    chain = kinematics.chain_to(bench_fk.tilted_panda(), bench_fk.FRAME)
    kinds = [type(step).__name__ for _, step in chain.plan.steps]
    assert kinds.count("Rotate") == 7 + 1  # and once at the frame that is asked for


def test_a_rival_that_is_timed_gives_mujocos_poses_and_one_that_is_missing_is_named(
    monkeypatch, twin
):
    ours = ("robo47 fk", "robo47 fk_space, screws", "robo47 fk, any axes",
            "plain 4x4 products, NumPy")  # fmt: skip
    rivals = {name: bench_fk.RIVALS[name] for name in ours}
    monkeypatch.setattr(bench_fk, "RIVALS", {**rivals, "gone": missing})
    results = bench_fk.run(rounds=1, n=300)
    assert results["left_out"] == {"gone": MISSING}
    assert results["rows"].keys() == rivals.keys()
    assert max(row["error"] for row in results["rows"].values()) < 1e-13


def test_answers_of_inverse_kinematics_are_judged_not_believed(monkeypatch, twin):
    def liar():  # answers at once, and says that all is well
        return bench_ik.Rival(lambda T: (np.full((len(T), 7), 9.0), 0), 5)

    rivals = {"robo47 solve_ik": bench_ik.ours, "liar": liar, "gone": missing}
    monkeypatch.setattr(bench_ik, "RIVALS", rivals)
    results = bench_ik.run(rounds=1, n=20)
    ours, lies = results["rows"]["robo47 solve_ik"], results["rows"]["liar"]
    assert (ours["targets"], ours["solved"], ours["within"]) == (20, 20, 20)
    assert 1 < ours["steps"] < 500
    assert (lies["targets"], lies["solved"], lies["within"]) == (5, 0, 0)
    text = table.render({"about": RESULTS["about"], "ik": results})
    assert "left out: gone" in text
    assert max(map(len, text.splitlines())) <= 80


def test_the_dynamics_table_has_a_row_for_every_rival_and_names_the_missing(
    monkeypatch, twin
):
    monkeypatch.setitem(bench_dynamics.RIVALS, "Pinocchio, loop", missing)
    monkeypatch.setattr(bench_dynamics, "ONE", 10)
    results = bench_dynamics.run(rounds=1, n=300)
    lines = table.render({"about": RESULTS["about"], "dynamics": results})
    assert lines.count("robo47 batch") == lines.count("MuJoCo, loop") == 3
    assert f"left out: Pinocchio, loop ({MISSING})" in lines
    assert max(row["error"] for rows in results["questions"].values()
               for row in rows.values()) < 1e-11  # fmt: skip


def test_memory_beyond_input_and_output_does_not_grow_with_the_batch(twin):
    chain = kinematics.chain_to(panda.load("panda_nohand"), "attachment_site")
    small, large = (
        bench_growth._extra_memory(chain, np.zeros((n, 7))) for n in (10_000, 300_000)
    )
    assert large < 1.5 * small < 10e6


def test_a_row_of_the_log_is_timed_at_both_sizes_against_the_naive_way():
    result = bench_metrics.run(rows=500, calls=20)
    medians = result["median_us"]
    assert result["rows"] == [0, 500]
    assert {"naive csv append", "robo47", "robo47, sync", "sqlite, WAL"} <= set(medians)
    for name, us in medians.items():
        assert min(us) > 0
        assert result["times_naive"][name][0] == us[0] / medians["naive csv append"][0]


def test_the_results_hold_every_part_and_the_targets_they_claim():
    rows = RESULTS["fk"]["rows"]
    ours = rows["robo47 fk"]
    assert ours["error"] < 1e-14
    for part in ("about", "lab", "growth", "metrics"):
        assert part in RESULTS
    # The numbers that were recorded, not a time taken now.
    assert ours["us"] < 0.25 * rows["MuJoCo mj_kinematics, loop"]["us"]
    assert ours["us"] < 0.5 * rows["Pinocchio with the frame, loop"]["us"]
    assert rows["robo47 fk, any axes"]["us"] < 3 * ours["us"]


def test_the_table_fits_80_columns_and_is_printed_without_running_anything(run):
    text = table.render(RESULTS)
    assert max(map(len, text.splitlines())) <= 80
    assert text in (ROOT / "bench" / "README.md").read_text("utf-8")
    done = run("scripts/bench.py", "--table")
    assert (done.returncode, done.stdout, done.stderr) == (0, text + "\n", "")


def test_an_unknown_part_is_refused_with_the_ones_there_are(run):
    done = run("scripts/bench.py", "kf")
    assert done.returncode == 2
    assert "no part kf; there are fk, ik, dynamics, lab" in done.stderr


class Part:
    """Stands in for a part's module."""

    def __init__(self, run):
        self.run = run


def test_a_part_that_fails_is_named_the_others_stand_and_its_old_numbers_say_so(
    monkeypatch, tmp_path, capsys
):
    def broken():
        raise ValueError("the rival\nbroke")

    parts = {
        "bench.bench_checker": Part(lambda: {"the whole day": {"median": 9.25}}),
        "bench.bench_tests": Part(broken),
        "bench.bench_growth": Part(broken),
    }
    results = tmp_path / "results.json"
    kept = {"tests": RESULTS["tests"]}
    results.write_text(json.dumps(kept), "utf-8")
    monkeypatch.setattr(command, "RESULTS", results)
    monkeypatch.setattr(command.importlib, "import_module", parts.__getitem__)
    monkeypatch.setattr(sys, "argv", ["bench.py", "tests", "growth", "checker"])
    assert command.main() == 1
    written = json.loads(results.read_text("utf-8"))
    assert written["checker"] == {"the whole day": {"median": 9.25}}
    assert written["tests"] == kept["tests"]
    assert "growth" not in written
    said = capsys.readouterr()
    assert (
        "bench: tests failed, and has its last result: ValueError: the rival broke"
        in said.err
    )
    assert (
        "bench: growth failed, and has no result: ValueError: the rival broke"
        in said.err
    )
    checker, _, tests = said.out.partition("make test:")
    assert "OLD: this part failed now" in tests
    assert "OLD" not in checker


def test_a_first_minute_that_failed_is_not_printed_as_passed():
    first = {**RESULTS["first-minute"], "passed": False}
    text = table.render({"about": RESULTS["about"], "first-minute": first})
    assert "until it FAILED" in text
    assert "PASSED" not in text


def test_a_lab_that_ends_with_advice_has_passed_its_first_minute():
    lab = [sys.executable, "w1-foundations/src/day1_transforms.py", "--no-log"]
    done = subprocess.run(lab, cwd=ROOT, capture_output=True, text=True, check=False)
    assert bench_first_minute.passed(done)
    done.returncode = 1
    assert not bench_first_minute.passed(done)


def test_the_handouts_script_mended_runs(real_panda):
    command = [sys.executable, "bench/handout_day1.py", real_panda / "panda_nohand.xml"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert "inverse error" in done.stdout


def test_the_matrix_covers_the_floor_and_the_pin_of_the_lists():
    oldest, newest = matrix.MUJOCOS
    assert (
        f'"mujoco>={oldest.removesuffix(".0")},'
        in (ROOT / "pyproject.toml").read_text()
    )
    assert f"mujoco=={newest} " in (ROOT / "constraints.txt").read_text("utf-8")
    assert matrix.find_python("2.0") is None


def test_the_matrix_finds_what_pyenv_has_and_has_not_chosen(monkeypatch, tmp_path):
    own = tmp_path / "versions" / "2.0.1" / "bin" / "python"
    own.parent.mkdir(parents=True)
    own.write_text("#!/bin/sh\nexec true\n")
    own.chmod(0o755)
    monkeypatch.setenv("PYENV_ROOT", str(tmp_path))
    assert matrix.find_python("2.0") == str(own)
    assert matrix.find_python("2.1") is None


@pytest.mark.parametrize("in_ci", ["", "1"])
def test_a_python_that_is_missing_is_named_and_fails_in_ci(monkeypatch, capsys, in_ci):
    monkeypatch.setenv("ROBO47_CI", in_ci)
    monkeypatch.setattr(sys, "argv", ["test_matrix.py", "--python", "2.0"])
    assert matrix.main() == (1 if in_ci else 0)
    assert (
        "left out  Python 2.0, MuJoCo 3.3.0: no such Python" in capsys.readouterr().out
    )
