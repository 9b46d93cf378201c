"""What every day's lab script does the same way: say, check, record, conclude."""

import argparse
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robo47 import cli, metrics
from robo47.checks import Array
from robo47.metrics.words import count
from robo47.paths import METRICS_CSV, shown


class Lab:
    """One run of a day's lab, from its first line to its exit code."""

    def __init__(self, day: int, run_id: str, about: str) -> None:
        """Read the command line.

        Args:
            day: number of the day.
            run_id: name of the script, first field of its metrics rows.
            about: the script's docstring, shown by --help.
        """
        parser = argparse.ArgumentParser(
            description=about, formatter_class=argparse.RawDescriptionHelpFormatter
        )
        parser.add_argument(
            "--no-log", action="store_true", help="leave metrics/metrics.csv alone"
        )
        self.day, self.run_id = day, run_id
        self.log = not parser.parse_args().no_log
        self.failed: list[str] = []
        self.rows: list[dict[str, Any]] = []

    def step(self, title: str) -> None:
        """Print the heading of a step."""
        print(f"\n{title}")

    def show(self, title: str, matrix: Array) -> None:
        """Print a matrix or a vector with aligned columns.

        Args:
            title: what it is.
            matrix: (m, n) or (n,).
        """
        print(f"  {title}")
        for row in np.atleast_2d(np.round(matrix, 6) + 0.0):  # + 0.0: no "-0.0"
            print("    " + " ".join(f"{entry:10.6f}" for entry in row))

    def check(self, name: str, error: ArrayLike, limit: float) -> None:
        """Print whether an error is small enough, and remember if it is not.

        Args:
            name: what was compared.
            error: a number, or an array whose largest entry counts; NaN fails.
            limit: it must be below this.
        """
        worst = float(np.max(error))
        verdict = "PASS" if worst < limit else "FAIL"
        print(f"  {verdict}  {name}: {worst:.1e} (limit {limit:.0e})")
        if verdict == "FAIL":
            self.failed.append(f"{name} is {worst:.1e}; it must be under {limit:.0e}")

    def record(
        self, check: str, metric: str, error: ArrayLike, limit: float, **fields: Any
    ) -> None:
        """Keep a metrics row for the end of the run.

        Args:
            check: what was checked, as in the handout's row.
            metric: name of the number.
            error: a number, or an array whose largest entry counts.
            limit: the row counts as a failure unless the error is below this.
            fields: other columns, see metrics/README.md.
        """
        worst = float(np.max(error))
        defaults = {
            "run_id": self.run_id,
            "day": self.day,
            "seed": 0,
            "method": "manual",
            "n_trials": 1,
            "n_failures": int(not worst < limit),
            "notes": f"limit {limit:.0e}",
        }
        row = {"check": check, "metric": metric, "value": worst}
        self.rows.append({**defaults, **row, **fields})

    def finish(self) -> int:
        """Write the rows, say how it went and return the exit code."""
        if self.log:
            # A failed check is recorded too: NaN is its value.
            metrics.append_rows(self.rows, sync=True, allow_nonfinite=True)
            print(f"\nlogged {count(len(self.rows), 'row')} to {shown(METRICS_CSV)}")
        else:
            print("\nnothing logged (--no-log)")
        for failure in self.failed:
            print(f"FAILED: {failure}")
        if self.failed:
            return cli.EXIT_FAILED
        print("All checks PASSED.")
        return cli.EXIT_OK
