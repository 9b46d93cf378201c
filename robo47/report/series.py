"""The log's rows as one series per day, check and metric."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from robo47.metrics.rows import Row
from robo47.metrics.scan import Line
from robo47.report.thresholds import Threshold

Key = tuple[int | None, str, str]  # day, check, metric


class Series:
    """The runs of one check's metric, oldest first, and what they must reach."""

    def __init__(self, key: Key, threshold: Threshold | None) -> None:
        """Start with no runs."""
        self.day, self.check, self.metric = key
        self.threshold = threshold
        self.rows: list[Row] = []

    @property
    def values(self) -> list[float]:
        """The finite values, oldest first."""
        found = (value_of(row) for row in self.rows)
        return [value for value in found if value is not None and math.isfinite(value)]

    @property
    def status(self) -> str:
        """How the latest run did: "pass", "fail", "open" (no threshold), "none"."""
        if not self.rows:
            return "none"
        if self.threshold is None:
            return "open"
        return "pass" if self.threshold.passes(value_of(self.rows[-1])) else "fail"

    @property
    def best(self) -> float | None:
        """The largest value where a minimum is asked for, else the smallest."""
        values = self.values
        if not values:
            return None
        wants_high = self.threshold is not None and self.threshold.max is None
        return max(values) if wants_high else min(values)

    @property
    def is_log(self) -> bool:
        """Whether the axis is logarithmic: errors, and whatever spans decades."""
        values = self.values
        positive = [value for value in values if value > 0]
        if not positive or min(values) < 0:
            return False
        return "err" in self.metric or max(positive) > 100 * min(positive)


@dataclass
class Report:
    """Everything that the page shows."""

    series: list[Series]
    repaired: list[Line] = field(default_factory=list)
    unread: list[Line] = field(default_factory=list)
    rows: int = 0

    def count(self, status: str) -> int:
        """Return how many series have that status."""
        return sum(one.status == status for one in self.series)


def value_of(row: Row) -> float | None:
    """Return a row's number."""
    value = row["value"]
    return value if isinstance(value, int | float) else None


def collect(
    lines: Iterable[Line],
    thresholds: Mapping[tuple[str, str], Threshold],
    since: str = "",
    day: int | None = None,
    check: str = "",
) -> Report:
    """Return the report on the lines that the filters let through.

    Args:
        lines: what `scan` yields.
        thresholds: by (check, metric).
        since: the first date, YYYY-MM-DD; "" is all.
        day: the course's day; None is all.
        check: a check's name; "" is all.
    """
    found: dict[Key, Series] = {}
    for (name, metric), threshold in thresholds.items():
        if day in (None, threshold.day) and check in ("", name):
            key = (threshold.day, name, metric)
            found[key] = Series(key, threshold)
    report = Report([])
    for line in lines:
        row = line.row
        if row is None:
            report.unread.append(line)
            continue
        if not _wanted(row, since, day, check):
            continue
        report.rows += 1
        if line.problem:
            report.repaired.append(line)
        _add(found, thresholds, row)
    report.series = sorted(found.values(), key=_place)
    for series in report.series:  # a merge may leave the dates out of order
        series.rows.sort(key=lambda row: str(row["date"]))
    return report


def _wanted(row: Row, since: str, day: int | None, check: str) -> bool:
    return (
        str(row["date"]) >= since
        and day in (None, row["day"])
        and check in ("", row["check"])
    )


def _add(
    found: dict[Key, Series],
    thresholds: Mapping[tuple[str, str], Threshold],
    row: Row,
) -> None:
    day, name, metric = row["day"], str(row["check"]), str(row["metric"])
    threshold = thresholds.get((name, metric))
    if day is None and threshold:
        day = threshold.day
    key = (day if isinstance(day, int) else None, name, metric)
    if key not in found:
        found[key] = Series(key, threshold)
    found[key].rows.append(row)


def _place(series: Series) -> tuple[float, str, str]:
    day = math.inf if series.day is None else series.day
    return (day, series.check, series.metric)
