"""The log's rows as one series per day, check and metric."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from html import escape

from labkit.base.text import number_of
from labkit.hunt.tally import ending
from labkit.lesson.day import Day
from labkit.lesson.metric import Metric
from labkit.lesson.writers import Writers, mark_of
from labkit.log.rows import Row
from labkit.log.scan import Line

Key = tuple[int | None, str, str]  # day, check, metric
SOMEBODY = Writers()  # the writers of rows whose files nobody knows


@dataclass
class Series:
    """The runs of one number, oldest first, and what they must reach."""

    day: int | None
    wanted: Metric  # the metric; it has no limit if no manifest lists the number
    writers: Writers = SOMEBODY
    rows: list[Row] = field(default_factory=list)  # all but
    kits: list[Row] = field(default_factory=list)  # the kit's own

    def add(self, row: Row) -> None:
        """Add a run, under the name of who made it."""
        by_kit = mark_of(row) in self.writers.kits
        (self.kits if by_kit else self.rows).append(row)

    def signed(self) -> "Series":
        """Return the series of the runs that say which file made them."""
        return replace(self, rows=[row for row in self.rows if mark_of(row)])

    @property
    def key(self) -> Key:
        """Its day, check and metric."""
        return (self.day, self.wanted.check, self.wanted.metric)

    @property
    def values(self) -> list[float]:
        """The finite values, oldest first."""
        return [value for value in map(float_of, self.rows) if math.isfinite(value)]

    @property
    def latest(self) -> float | None:
        """The last run's value; None where there is none."""
        return value_of(self.rows[-1]) if self.rows else None

    @property
    def kit(self) -> float | None:
        """The value of the kit's own last run; None where there is none."""
        return value_of(self.kits[-1]) if self.kits else None

    @property
    def status(self) -> str:
        """The status of the latest run by `Writers.judge`.

        "kit" where nobody but the kit ran it, "open" where nothing is asked of it.
        """
        if not self.rows:
            return "kit" if self.kits else "none"
        if not self.wanted.limit:
            return "open"
        return self.writers.judge(self.wanted, self.rows[-1])

    @property
    def bounds(self) -> list[tuple[str, float]]:
        """The limits, each with the sign of what passes: [("<", 1e-08)]."""
        both = ((">", self.wanted.min), ("<", self.wanted.max))
        return [(sign, bound) for sign, bound in both if bound is not None]

    @property
    def best(self) -> float | None:
        """The largest value where a minimum is asked for, else the smallest.

        Of runs that pass, where a limit is asked for and one does.
        """
        judge = self.wanted.judge
        good = [r for r in self.rows if self.wanted.limit and judge(r) == "pass"]
        values = [float_of(row) for row in good] or self.values
        return (max if self._wants_high else min)(values) if values else None

    @property
    def worst(self) -> float | None:
        """The value farthest on the other side; NaN where a run gave no number."""
        values = [float_of(row) for row in self.rows]
        if any(map(math.isnan, values)):
            return math.nan
        return (min if self._wants_high else max)(values) if values else None

    @property
    def _wants_high(self) -> bool:
        return self.wanted.max is None and self.wanted.min is not None

    @property
    def is_log(self) -> bool:
        """The axis is logarithmic: errors, and numbers that span decades."""
        values = self.values
        positive = [value for value in values if value > 0]
        if not positive or min(values) < 0:
            return False
        return "err" in self.wanted.metric or max(positive) > 100 * min(positive)


@dataclass
class Report:
    """Everything that the page shows."""

    series: list[Series]
    look: list[Line] = field(default_factory=list)  # lines that need one
    rows: int = 0
    hunts: list[Row] = field(default_factory=list)  # bug hunts that ended

    def count(self, status: str) -> int:
        """Return how many series have that status."""
        return sum(one.status == status for one in self.series)


def series_of(
    day: Day, rows: Iterable[Row], writers: Writers = SOMEBODY
) -> list[Series]:
    """Return the runs of all numbers that a day asks for, in the manifest's order.

    Args:
        day: from its manifest.
        rows: of its log, oldest first; those of other numbers are left out.
        writers: who may have written them.
    """
    found = {(m.check, m.metric): Series(day.number, m, writers) for m in day.metrics}
    for row in rows:
        if one := found.get((str(row["check"]), str(row["metric"]))):
            one.add(row)
    return list(found.values())


def cell_of(day: Day, wanted: Metric) -> str:
    """Return a table's cell on what a number is: in words, then by its names."""
    name = escape(day.name_of(wanted))
    if not wanted.says:
        return name
    return f"{escape(wanted.says)}<br><small class=muted>{name}</small>"


def with_unit(value: float | None, wanted: Metric) -> str:
    """Return a value as pages print it, "2.4e-15 m"; "–" without one."""
    if value is None:
        return "–"
    return escape(f"{number_of(value)} {wanted.unit}".strip())


def limit_of(wanted: Metric) -> str:
    """Return what a number must be, as pages print it: "under 20 mm"."""
    return escape(f"{wanted.limit} {wanted.unit}".strip())


def value_of(row: Row) -> float | None:
    """Return a row's number."""
    value = row["value"]
    return value if isinstance(value, int | float) else None


def float_of(row: Row) -> float:
    """Return a row's number, NaN where it has none."""
    value = value_of(row)
    return math.nan if value is None else float(value)


def failures_of(row: Row) -> str:
    """Return in how many trials a run failed, in words; "" where it did in none."""
    if not row["n_failures"]:
        return ""
    return f"failed in {row['n_failures']} of {row['n_trials'] or '?'} trials"


def collect(
    lines: Iterable[Line],
    asked: Sequence[Series],
    since: str = "",
    day: int | None = None,
    check: str = "",
) -> Report:
    """Return the report on the lines that the filters let through.

    Args:
        lines: what `scan` yields.
        asked: the numbers that the chosen days ask for, without runs.
        since: the first date, YYYY-MM-DD; "" is all.
        day: the course's day; None is all.
        check: a check's name; "" is all.
    """
    found = {one.key: one for one in asked if check in ("", one.wanted.check)}
    report = Report([])
    for line in lines:
        if row := line.row:
            if str(row["date"]) < since or day not in (None, row["day"]):
                continue
            if check not in ("", row["check"]):
                continue
            report.rows += 1
            if ending(row):
                report.hunts.append(row)
                continue
            key = _key(row, asked)
            if key not in found:
                found[key] = Series(key[0], Metric(*key[1:]))
            found[key].add(row)
        if line.problem:
            report.look.append(line)
    report.series = sorted(found.values(), key=_place)
    for series in report.series:  # a merge may leave the dates out of order
        for rows in (series.rows, series.kits):
            rows.sort(key=lambda row: str(row["date"]))
    return report


def _key(row: Row, asked: Sequence[Series]) -> Key:
    name, metric = str(row["check"]), str(row["metric"])
    if isinstance(row["day"], int):
        return row["day"], name, metric
    # A row without its day belongs to the only day that asks for it.
    days = [one.day for one in asked if one.key[1:] == (name, metric)]
    return days[0] if len(days) == 1 else None, name, metric


def _place(series: Series) -> tuple[float, bool, str, str]:
    """Return what orders the series: by day, and what fails first."""
    day, check, metric = series.key
    return math.inf if day is None else day, series.status != "fail", check, metric
