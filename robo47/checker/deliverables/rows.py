"""The day's numbers in the metrics log: there, and within their limits."""

import math
import warnings
from pathlib import Path

from robo47 import metrics
from robo47.checker.deliverables.item import Item
from robo47.errors import Robo47Error
from robo47.lesson.day import Day, Metric


def check_rows(day: Day, root: Path, tasks_pass: bool = True) -> Item:
    """Check that the latest row of each of the day's metrics is within its limit.

    Args:
        day: from the kit's manifest.
        root: the student's clone.
        tasks_pass: whether the day's tasks do. The kit's own run and the student's
            write the same row, but an unfinished lab cannot have written any.
    """
    path = root / "metrics" / "metrics.csv"
    log = f"make run DAY={day.number}"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # damaged rows are log_metric's business
            rows = metrics.read_rows(path) if path.exists() else []
    except Robo47Error as error:
        return Item("metrics", "wrong", str(error))
    latest = {
        (row["check"], row["metric"]): float(row["value"])
        for row in rows
        if row["day"] == day.number and row["value"] is not None
    }
    missing = [m for m in day.metrics if (m.check, m.metric) not in latest]
    if missing:
        names = ", ".join(f"{m.check} ({m.metric})" for m in missing)
        return Item("metrics", "todo", f"No row yet for {names}.\nRun your lab: {log}")
    for wanted in day.metrics:
        if why := _implausible(latest[wanted.check, wanted.metric], wanted):
            says = f"{wanted.check}: {wanted.metric} {why}.\nMend it, then: {log}"
            return Item("metrics", "wrong", says)
    if not tasks_pass:
        says = f"The rows in the log are the kit's. When your tasks pass: {log}"
        return Item("metrics", "todo", says)
    return Item("metrics")


def _implausible(value: float, wanted: Metric) -> str | None:
    """Return what is wrong with a value, or None."""
    if not math.isfinite(value):
        return f"is {value}, not a number"
    if value < 0:
        return f"is {value:.3g}, and an error is never negative"
    if value > wanted.max:
        return f"is {value:.3g}; it must be at most {wanted.max:.0e}"
    return None
