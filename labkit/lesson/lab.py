"""The common actions of all lab scripts: print, check, record, conclude.

    lab = Lab(__file__, __doc__)
    lab.step("2. The same by hand")
    lab.check("largest |by hand - MuJoCo|", error)
    lab.record("fk_by_hand", errors, seed=47)
    return lab.finish()

What a number must reach stands in the day's day.toml and nowhere else. A zero prints
without a sign (the z of a format): which sign a rounding error has is the machine's.
"""

import argparse
import contextlib
import os
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labkit import log
from labkit.base import cli, store
from labkit.base.text import count, number_of
from labkit.lesson import day_mujoco  # noqa: F401 (a lab's next import needs it)
from labkit.lesson.day import day_of
from labkit.lesson.hidden_numbers import Output
from labkit.lesson.metric import Metric
from labkit.lesson.predictions import predictions, rows_asked, with_measured
from labkit.lesson.training import training
from labkit.lesson.writers import file_mark
from robo47.paths import METRICS_CSV, shown


class Lab:
    """One run of a day's lab, from its first line to its exit code."""

    def __init__(self, file: str, about: str | None) -> None:
        """Read the command line and the day's manifest.

        Args:
            file: the script's own, `__file__`; its name says which day it is.
            about: the script's docstring, shown by --help.

        Raises:
            Robo47Error: the name is no lab's, or its day is not there.
        """
        parser = cli.parser(about)
        parser.add_argument(
            "--no-log", action="store_true", help="leave metrics/metrics.csv alone"
        )
        parser.add_argument(
            "--try",
            action="store_true",
            dest="trial",
            help="measure with constants of your own: nothing is judged or logged",
        )
        parser.add_argument(
            "--reveal",
            "--numbers",
            action="store_true",
            help="show the numbers also before you have written your predictions",
        )
        parser.add_argument(
            "--predict-first",
            action="store_true",
            help="hide the numbers that the worksheet still asks you to predict",
        )
        options = parser.parse_args()
        self.trial = options.trial
        self.log = not (options.no_log or options.trial)
        self.script = Path(file)
        self.day = day_of(self.script)
        self.failed: list[str] = []
        self.rows: list[dict[str, Any]] = []
        # A prediction is of the lab as it is: a trial's constants make it no answer.
        sheet = "" if self.trial else self._worksheet()
        self.predicted = predictions(sheet)
        self.came_out: dict[str, float] = {}  # measured, by what it is
        self.output = self._held(options)

    def _held(self, options: argparse.Namespace) -> Output:
        """Hold the output back, where numbers of it are still to be predicted."""
        mine = self._is_students()
        asks = (mine or options.predict_first) and not (options.reveal or self.trial)
        rows = rows_asked(self._read_worksheet()) if asks else {}
        blank = [name for name, text in rows.items() if not text]
        if blank:
            print(cli.wrapped(self._predict_first(len(blank), mine)), flush=True)
        held = Output(blank)
        cli.at_end(held.release)
        return held

    def _predict_first(self, missing: int, mine: bool) -> str:
        """Return what a lab prints first while predictions are missing."""
        run = f"make {'run DAY=' if mine else 'day'}{self.day.number} ARGS=--reveal"
        says = f"Predict first: {count(missing, 'prediction')} of yours "
        says += f"{'is' if missing == 1 else 'are'} missing in {self.day.worksheet}. "
        says += "The lab hides the measured numbers and prints its output at the end. "
        return f"{says}All numbers: {run}"

    def _is_students(self) -> bool:
        return self.script.resolve() == self.day.work.resolve()

    def _worksheet(self) -> str:
        """Return the text of the day's worksheet; "" where the kit's own lab runs."""
        return self._read_worksheet() if self._is_students() else ""

    def _read_worksheet(self) -> str:
        try:
            data = (self.day.folder / self.day.worksheet).read_bytes()
            return data.decode("utf-8")  # the line ends stay as they are
        except (OSError, UnicodeDecodeError):  # `make check` says so
            return ""

    def measured(self, number: str, value: float) -> None:
        """Print a number next to the student's prediction; hide it if there is none.

        A number that the worksheet does not ask for is not printed. A run that is
        logged writes the number into the worksheet as well. With --try the number is
        printed alone, because the prediction was made for the unchanged lab.

        Args:
            number: the first cell of its row in the worksheet's table of predictions.
            value: in the row's unit.
        """
        if self.trial:
            print(cli.wrapped(f"  measured {value:z.4g}: {number}", "    "))
        elif number in self.output.asked:
            says = f"  {number}: hidden until you write your prediction in "
            says = cli.wrapped(says + self.day.worksheet, "    ")
            self.output.hide(number, value, says)
        elif number in self.predicted:
            self.came_out[number] = value
            yours = f"  you predicted {self.predicted[number]}, measured {value:z.4g}: "
            print(cli.wrapped(yours + number, "    "))

    def step(self, title: str) -> None:
        """Print the heading of a step."""
        print(f"\n{title}")

    @contextlib.contextmanager
    def side_quest(self) -> Iterator[None]:
        """Go on where what is optional is still to do: its rows are not asked for."""
        try:
            yield
        except NotImplementedError as gap:
            print(cli.wrapped(f"to do: {gap}", "  "))

    def training(self, title: str, steps: int) -> Iterator[int]:
        """Yield the numbers of a training's steps, from 1, and show a bar meanwhile."""
        return training(title, steps)

    def show(self, title: str, matrix: ArrayLike, decimals: int = 6) -> None:
        """Print a matrix (m, n) or a vector (n,) with aligned columns."""
        print(f"  {title}")
        for row in np.atleast_2d(np.asarray(matrix, dtype=float)):
            print("    " + " ".join(f"{x:z{decimals + 4}.{decimals}f}" for x in row))

    def predict(self, what: str, wanted: float, found: float, unit: str) -> None:
        """Print a prediction of the lab's, what came out, and how far apart they are.

        "what, unit" may be a row of the worksheet.
        """
        print(f"  {what}: predicted {wanted:z.3f}, measured {found:z.3f} {unit}")
        print(f"    difference {abs(wanted - found):.1e} {unit}")
        if not self.trial:  # the line above has the number already
            self.measured(f"{what}, {unit}", found)

    def check(self, name: str, error: ArrayLike, limit: float | None = None) -> None:
        """Print whether an error is small enough, and remember if it is not.

        Args:
            name: what was compared.
            error: a number, or an array whose largest |entry| counts; NaN fails.
            limit: it must be under this; by default the day's own limit.
        """
        limit = self.day.limit if limit is None else limit
        largest = np.max(np.abs(np.asarray(error, dtype=np.float64)))
        self._judge(name, Metric("", name, max=limit), float(largest))

    def record(
        self,
        check: str,
        error: ArrayLike,
        *,
        metric: str = "",
        label: str = "",
        **fields: Any,
    ) -> None:
        """Check a number against its limit in day.toml, and keep its metrics row.

        Args:
            check: what was checked, as day.toml names it.
            error: a number, or one per trial: the largest |entry| counts; where the
                manifest says `min`, the smallest; where it says both, the worst.
            metric: which of the check's numbers, where day.toml has several.
            label: what to print; by default the name of the check.
            fields: other columns of the row, see metrics/README.md.

        Raises:
            Robo47Error: day.toml has no such row.
        """
        wanted = self.day.metric(check, metric)
        signed = np.atleast_1d(np.asarray(error, dtype=np.float64)).ravel()
        trials = np.abs(signed) if wanted.min is None else signed
        value = _worst(trials, wanted)
        if self.trial and signed.size == 1:
            value = float(signed[0])  # nothing is judged: the number as it is
        self._judge(label or check.replace("_", " "), wanted, value)
        mark = file_mark(self.script.read_bytes())
        row = {
            "run_id": self.script.stem,
            "day": self.day.number,
            "check": check,
            "seed": 0,
            "method": "manual",
            "n_trials": trials.size,
            "n_failures": int(sum(not wanted.passes(x) for x in trials)),
            "metric": wanted.metric,
            "value": value,
            "notes": f"limit {_bounds(wanted)}; {mark}",
        }
        self.rows.append({**row, **fields})

    def finish(self) -> int:
        """Write the rows, say how it went and return the exit code."""
        self.output.release(finished=True)
        if self.trial:
            print("\nTried: measured, not judged, nothing logged.")
            return cli.EXIT_OK
        try:
            if self.log:
                # A failed check is recorded too: NaN is its value.
                log.append_rows(self.rows, sync=True, allow_nonfinite=True)
                rows = count(len(self.rows), "row")
                print(f"\nlogged {rows} to {shown(METRICS_CSV)}")
                self._write_measured()
            else:
                print("\nnothing logged (--no-log)")
        finally:  # worth saying also where the log takes nothing
            for failure in self.failed:
                print(cli.wrapped(f"FAILED: {failure}", "  "))
        if self.failed:
            return cli.EXIT_FAILED
        print(cli.paint("All checks PASSED.", "good"))
        return cli.EXIT_OK

    def _write_measured(self) -> None:
        """Write what was measured beside what was predicted; a week's look does not."""
        if os.environ.get("ROBO47_METRICS"):  # another log than the student's
            return
        before = self._worksheet()
        after = with_measured(before, self.came_out, time.strftime("%H:%M"))
        if after == before:
            return
        path = self.day.folder / self.day.worksheet
        with contextlib.suppress(OSError):  # one that nobody may write stays
            store.replace(path, after.encode())
            print(f"measured numbers: in {self.day.worksheet}")

    def _judge(self, name: str, wanted: Metric, value: float) -> None:
        if self.trial:
            print(f"  ----  {name}: {number_of(value)}")
            return
        good = wanted.passes(value)
        verdict = cli.paint("PASS", "good") if good else cli.paint("FAIL", "bad")
        number = number_of(value)
        asked = wanted.limit if wanted.min is not None else f"limit {_bounds(wanted)}"
        print(f"  {verdict}  {name}: {number} ({asked})")
        if not good:
            self.failed.append(f"{name} is {number}; it must be {wanted.limit}")


def _bounds(wanted: Metric) -> str:
    bounds = (wanted.min, wanted.max)
    return " to ".join(f"{bound:g}" for bound in bounds if bound is not None)


def _worst(trials: np.ndarray, wanted: Metric) -> float:
    """Return the trial that a row is judged by; NaN where one is NaN."""
    low, high = float(np.min(trials)), float(np.max(trials))
    if wanted.min is None or (wanted.max is not None and wanted.passes(low)):
        return high
    return low
