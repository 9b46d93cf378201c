"""The day's numbers in the metrics log: the student's own, and within their limits."""

import io

from labkit.base.text import visible
from labkit.handin.handin import Handin, Item
from labkit.lesson.borrowed import borrowed_tasks
from labkit.lesson.day import Day
from labkit.lesson.metric import Metric
from labkit.lesson.writers import mark_of, marks_of
from labkit.log.rows import Row
from labkit.log.scan import scan_file
from robo47.errors import Robo47Error


def check_rows(day: Day, handin: Handin, *, tasks_pass: bool = True) -> Item:
    """Check the latest row of each of the day's metrics.

    Only rows count that the student's own file wrote after its last change.

    Args:
        day: from the kit's manifest.
        handin: what the student's folder holds.
        tasks_pass: whether the day's tasks do; until then the file will change again.
    """
    run = f"make run DAY={day.number}"
    try:
        rows = rows_of(day, handin)
    except Robo47Error as error:
        return Item("metrics", "wrong", visible(error))
    own = marks_of(handin.files.get(day.files["script"]))
    latest = latest_of(rows, own)
    missing = [m for m in day.metrics if (m.check, m.metric) not in latest]
    if missing:
        why = _why_missing(day, rows, own, missing)
        return Item("metrics", "todo", f"{why}\nRun your lab: {run}")
    for metric in day.metrics:
        if fault := metric.fault(latest[metric.check, metric.metric]):
            says = f"{metric.check}: {metric.metric} {fault}.\nFix it, then: {run}"
            return Item("metrics", "wrong", says)
    script = handin.files.get(day.files["script"], b"").decode("utf-8", "replace")
    if tasks := borrowed_tasks(day, script):
        ids = ", ".join(task.id for task in tasks)
        says = f"Borrowed from the kit: {ids}. The rows count once these are your own; "
        return Item("metrics", "todo", f"{says}then: {run}")
    if not tasks_pass:
        says = f"The rows count once your tasks pass. Then run again: {run}"
        return Item("metrics", "todo", says)
    return Item("metrics")


def own_rows(day: Day, handin: Handin) -> dict[tuple[str, str], Row]:
    """Return the latest rows of the student's file as it is, by check and metric.

    Raises:
        Robo47Error: the log cannot be read.
    """
    script = handin.files.get(day.files["script"])
    return latest_of(rows_of(day, handin), marks_of(script))


def latest_of(rows: list[Row], marks: set[str]) -> dict[tuple[str, str], Row]:
    """Return the latest rows that one of these files wrote, by check and metric."""
    own = (row for row in rows if mark_of(row) in marks)
    return {(str(row["check"]), str(row["metric"])): row for row in own}


def rows_of(day: Day, handin: Handin) -> list[Row]:
    """Return the log's rows of the day's metrics, oldest first."""
    name = day.files["log"]
    lines = scan_file(io.BytesIO(handin.files.get(name, b"")), name)
    rows = [line.row for line in lines if line.row is not None]
    wanted = {(day.number, m.check, m.metric) for m in day.metrics}
    return [r for r in rows if (r["day"], r["check"], r["metric"]) in wanted]


def _why_missing(
    day: Day, rows: list[Row], own: set[str], missing: list[Metric]
) -> str:
    """Return why no row of the student's own file is there."""
    there = {(row["check"], row["metric"]): row for row in rows}
    seen = [there[key] for m in missing if (key := (m.check, m.metric)) in there]
    if not own or len(seen) < len(missing):
        names = ", ".join(f"{m.check} ({m.metric})" for m in missing)
        return f"No row yet for {names}."
    source = day.source.read_bytes() if day.source.is_file() else None
    marks = {mark_of(row) for row in seen}
    if marks <= marks_of(source):
        return "The rows in the log come from the kit's own run, not from your file."
    if "" in marks:
        return "The rows in the log do not show that your file wrote them."
    return "Your file has changed since it logged its rows."
