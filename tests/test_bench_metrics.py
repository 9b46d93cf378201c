"""The bench of the log gives the numbers that `make bench` shows."""

import runpy
from pathlib import Path

import pytest

pytestmark = pytest.mark.kit

BENCH = Path(__file__).parent.parent / "bench" / "bench_metrics.py"


def test_every_way_is_measured_at_both_sizes_against_the_naive_one():
    result = runpy.run_path(str(BENCH))["run"](rows=500, calls=20)
    assert result["rows"] == [0, 500]
    assert {"naive csv append", "robo47", "robo47, sync", "sqlite, WAL"} <= set(
        result["median_us"]
    )
    for name, medians in result["median_us"].items():
        assert all(us > 0 for us in medians)
        first = medians[0] / result["median_us"]["naive csv append"][0]
        assert result["times_naive"][name][0] == first
