"""Thresholds of the numbers, from the days' manifests."""

from pathlib import Path

from labkit.lesson.day import Metric, all_days
from robo47.paths import ROOT

Key = tuple[int | None, str, str]  # day, check, metric


def load(root: Path = ROOT) -> dict[Key, Metric]:
    """Return what is asked for, by day, check and metric.

    Args:
        root: the clone.

    Raises:
        Robo47Error: a manifest is not right; names the entry.
    """
    return {
        (day.number, metric.check, metric.metric): metric
        for day in all_days(root)
        for metric in day.metrics
    }
