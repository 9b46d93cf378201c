"""The library that a day's file may import holds no answer to that day's tasks."""

import importlib
import inspect
import sys

import inprocess
import numpy as np
import pytest
from cpu_limit import ended_late

from conftest import days
from labkit.judge.row import rows_of
from labkit.sandbox.messages import library_of

pytestmark = [
    pytest.mark.kit,
    pytest.mark.skipif(sys.platform == "win32", reason="no SIGVTALRM there"),
]

# What a day asks again, in other words, of what a day before has taught.
ALLOWED: set[tuple[str, str]] = set()
PROBES = 4  # questions that show most functions to be another one
SECONDS = 0.5  # of a call; on other input, a loop over a tree may never end


def ended(function, args):
    """Return a function's answer.

    Raises:
        TimeoutError: it takes longer than any right answer to a probe does.
    """
    with ended_late(SECONDS):
        return function(*args)


def importable(day):
    """Return every function that a file of this day may import, by where it is."""
    found = {}
    for name in library_of(day):
        if not name.startswith("robo47."):
            continue
        for key, value in vars(importlib.import_module(name)).items():
            if inspect.isfunction(value) and value.__module__.startswith("robo47"):
                found.setdefault(value, f"{name}.{key}")
    return {where: function for function, where in found.items()}


def answers_alike(function, row):
    """Return whether a function answers a row's first questions as its truth does."""
    for args in row.ask.main[:PROBES]:
        try:
            mine = np.asarray(ended(function, args), dtype=float)
            right = np.asarray(row.truth(*args), dtype=float)
        except Exception:
            return False
        if mine.shape != right.shape or not np.allclose(mine, right, atol=1e-6):
            return False
    return True


def passing(day):
    """Return (task's function, library's function) wherever a check says passed."""
    found = set()
    tasks = {name: task.id for task in day.tasks for name in task.functions}
    for name, row in rows_of(day).items():
        for where, function in importable(day).items():
            if not answers_alike(function, row):
                continue
            told = inprocess.verdicts(
                day, day.source, tasks[name], instead={name: function}
            )
            if told[tasks[name]].status == "passed":
                found.add((f"day{day.number}.{name}", where))
    return found


@pytest.mark.parametrize("day", days(), ids=lambda day: f"day{day.number}")
def test_no_function_of_the_days_before_passes_a_task(day):
    assert passing(day) <= ALLOWED


def test_the_search_finds_a_days_own_library():
    day = next(day for day in days() if day.number == 4)
    rows = rows_of(day)
    own = importlib.import_module("robo47.dynamics")
    assert all(answers_alike(getattr(own, name), row) for name, row in rows.items())


def test_a_call_without_an_end_is_ended():
    def endless():
        found = []
        while True:
            found.append(len(found))

    with pytest.raises(TimeoutError):
        ended(endless, ())
