"""Timing that is fair on a busy machine: everything in one run, taking turns."""

import importlib
import statistics
import subprocess
import time
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from robo47.panda import files
from robo47.paths import ROOT


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


def programs(
    commands: Mapping[str, list[str]], *, check: bool = True
) -> dict[str, Callable[[], Any]]:
    """Return candidates that are whole programs; `check` stops where one fails."""
    run = partial(subprocess.run, cwd=ROOT, check=check, capture_output=True)
    return {name: partial(run, command) for name, command in commands.items()}


def microseconds(timed: Mapping[str, float], n: int) -> dict[str, float]:
    """Return a candidate's times as {"us", "low", "high"}, for each of n."""
    names = {"us": "median", "low": "low", "high": "high"}
    return {name: timed[key] / n * 1e6 for name, key in names.items()}


def installed(
    makers: Mapping[str, Callable[[], Any]],
) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the rivals that are installed, and why each of the others is not."""
    rivals, left_out = {}, {}
    for name, make in makers.items():
        try:
            rivals[name] = make()
        except ImportError as missing:
            left_out[name] = str(missing)
    return rivals, left_out


def pinocchio() -> tuple[Any, Any, Any, int]:
    """Return Pinocchio, its model of the Panda, data for that, and the end's frame."""
    pin = importlib.import_module("pinocchio")
    folder = files.panda_folder()
    if folder is None:
        raise ImportError("the real Panda is not here")
    model = pin.buildModelFromMJCF(str(folder / "panda_nohand.xml"))
    return pin, model, model.createData(), model.getFrameId("attachment_site")
