"""Timing that is fair on a busy machine: everything in one run, taking turns."""

import statistics
import time
from collections.abc import Callable, Mapping
from typing import Any


def take_turns(
    candidates: Mapping[str, Callable[[], Any]], rounds: int
) -> dict[str, dict[str, float]]:
    """Time each candidate once per round, after one uncounted round to warm up.

    Args:
        candidates: {name: what to time}.
        rounds: timed calls of each.

    Returns:
        {name: {"median": seconds, "low": fastest, "high": slowest}}.
    """
    took: dict[str, list[float]] = {name: [] for name in candidates}
    for counted in [False] + [True] * rounds:
        for name, run in candidates.items():
            start = time.perf_counter()
            run()
            if counted:
                took[name].append(time.perf_counter() - start)
    return {
        name: {"median": statistics.median(t), "low": min(t), "high": max(t)}
        for name, t in took.items()
    }
