"""What one row costs: ours beside the ways people would pick instead.

Every way is timed in the same run, one call each in turn, so that a busy moment of
the machine falls on all of them; the first calls warm up and are not counted.
"""

import contextlib
import csv
import importlib.util
import sqlite3
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from labkit.log import COLUMNS, append_row

ROWS = 1_000_000
CALLS, WARM_UP = 400, 40
PANDAS_CALLS = 5  # each rewrites the whole file
ROW = {
    "run_id": "day1_transforms",
    "date": "2026-09-01",
    "day": 1,
    "check": "fk_identity_check",
    "git_sha": "abc1234",
    "seed": 0,
    "config": "panda_home",
    "method": "manual",
    "n_trials": 1,
    "n_failures": 0,
    "metric": "inv_err",
    "value": 2.220446049250313e-16,
    "notes": "T_world_hand @ inverse(T_world_hand)",
}
LINE = ",".join(str(value) for value in ROW.values())
HEADER = ",".join(COLUMNS)
Way = Callable[[], object]


def run(rows: int = ROWS, calls: int = CALLS) -> dict:
    """Time every way on an empty and on a long log.

    Args:
        rows: lines that the long log starts with.
        calls: timed calls of each way (pandas: PANDAS_CALLS).

    Returns:
        {"rows": [0, rows], "median_us": {way: [empty, long]},
        "times_naive": {way: [empty, long]}}; microseconds per row.
    """
    medians: dict[str, list[float]] = {}
    for size in (0, rows):
        with (
            tempfile.TemporaryDirectory() as folder,
            contextlib.closing(sqlite3.connect(Path(folder) / "log.db")) as base,
        ):
            ways = _ways(Path(folder), base, size)
            for name, us in _timed(ways, calls).items():
                medians.setdefault(name, []).append(us)
    naive = medians["naive csv append"]
    ratios = {
        name: [us / base for us, base in zip(each, naive, strict=True)]
        for name, each in medians.items()
    }
    return {"rows": [0, rows], "median_us": medians, "times_naive": ratios}


def _timed(ways: dict[str, Way], calls: int) -> dict[str, float]:
    took: dict[str, list[float]] = {name: [] for name in ways}
    for i in range(calls + WARM_UP):
        for name, way in ways.items():
            if name.startswith("pandas") and i >= PANDAS_CALLS + 1:
                continue
            start = time.perf_counter()
            way()
            took[name].append((time.perf_counter() - start) * 1e6)
    return {
        name: statistics.median(each[1 if name.startswith("pandas") else WARM_UP :])
        for name, each in took.items()
    }


def _ways(folder: Path, base: sqlite3.Connection, rows: int) -> dict[str, Way]:
    def log(name: str) -> Path:
        path = folder / name
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            file.write(HEADER + "\n")
            for start in range(0, rows, 10_000):
                file.write((LINE + "\n") * min(10_000, rows - start))
        return path

    ours = log("ours.csv")
    synced = log("synced.csv")
    naive = log("naive.csv")
    ways: dict[str, Way] = {
        "naive csv append": lambda: _naive(naive),
        "robo47": lambda: append_row(ours, **ROW),
        "robo47, sync": lambda: append_row(synced, sync=True, **ROW),
        "sqlite, WAL": _sqlite(base, rows),
    }
    if importlib.util.find_spec("pandas"):
        ways["pandas rewrite"] = _pandas(log("pandas.csv"))
    return ways


def _naive(path: Path) -> None:
    with open(path, "a", newline="", encoding="utf-8") as file:
        csv.writer(file).writerow(ROW.values())


def _sqlite(base: sqlite3.Connection, rows: int) -> Way:
    base.execute("PRAGMA journal_mode=WAL")
    base.execute("PRAGMA synchronous=NORMAL")
    base.execute("CREATE TABLE log (" + ", ".join(f'"{c}"' for c in COLUMNS) + ")")
    insert = f"INSERT INTO log VALUES ({', '.join('?' * len(COLUMNS))})"
    values = tuple(ROW.values())
    base.executemany(insert, (values for _ in range(rows)))
    base.commit()

    def add() -> None:
        base.execute(insert, values)
        base.commit()

    return add


def _pandas(path: Path) -> Way:
    import pandas

    def add() -> None:
        frame = pandas.concat([pandas.read_csv(path), pandas.DataFrame([ROW])])
        frame.to_csv(path, index=False)

    return add
