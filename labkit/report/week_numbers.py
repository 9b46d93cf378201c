"""The student's own numbers of a day beside the kit's, out of the log's rows.

A row's notes end with the hash of the file that wrote it, so the kit's own runs and
the student's can be told apart.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from labkit.lesson.day import Day, Metric
from labkit.lesson.marks import mark_of, marks_of
from labkit.log.rows import Row
from labkit.report.series import Key, Series, value_of


@dataclass(frozen=True)
class Number:
    """One number of a day; None where there is no row.

    Attributes:
        metric: what it must reach.
        latest: the student's last run.
        status: how that run stands, as `Metric.judge` says.
        worst: the farthest from the limit's good side that the student logged.
        kit: the kit's own last run on this machine.
        runs: how often the student logged it.
    """

    metric: Metric
    latest: float | None
    status: str
    worst: float | None
    kit: float | None
    runs: int

    @property
    def passed(self) -> bool:
        """Whether the student's last run is within the limit."""
        return self.status == "pass"


def numbers_of(day: Day, series: Mapping[Key, Series]) -> list[Number]:
    """Return a day's numbers, in the manifest's order.

    Args:
        day: from its manifest.
        series: the log's rows, by day, check and metric.
    """
    kits = marks_of(day.source.read_bytes() if day.source.is_file() else None)
    return [_number(metric, _rows(day, metric, series), kits) for metric in day.metrics]


def _rows(day: Day, metric: Metric, series: Mapping[Key, Series]) -> Sequence[Row]:
    found = series.get((day.number, metric.check, metric.metric))
    return found.rows if found else []


def _number(metric: Metric, rows: Sequence[Row], kits: set[str]) -> Number:
    mine = [r for r in rows if mark_of(r) and mark_of(r) not in kits]
    own = [_value(r) for r in mine]
    kit = [_value(r) for r in rows if mark_of(r) in kits]
    return Number(
        metric,
        own[-1] if own else None,
        metric.judge(mine[-1] if mine else None),
        max(own, key=lambda value: _badness(metric, value), default=None),
        kit[-1] if kit else None,
        len(own),
    )


def _value(row: Row) -> float:
    value = value_of(row)
    return float("nan") if value is None else float(value)


def _badness(metric: Metric, value: float) -> float:
    """Return what grows as a value gets worse; a value that is no number is worst."""
    if value != value:
        return float("inf")
    return -value if metric.max is None else value
