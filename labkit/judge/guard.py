"""What goes wrong while the checker searches for a mistake costs its name, no more.

A search, or a hook of a row, may meet answers of which its author did not think. A
student is then told what is certain, and that the kit failed; the other tasks are
checked as usual. Where `LOUD` is set in the environment, as the kit's tests and `make
author` set it, the error is raised, so that an author sees it.
"""

import contextlib
import functools
import os
import sys
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from pathlib import Path
from typing import Any

import numpy as np

from labkit.base.exchange import LoadError
from labkit.base.quiet import nothing_printed
from robo47.errors import FaultError, Robo47Error
from robo47.paths import ROOT

LOUD = "ROBO47_LOUD"  # the variable; any text but "" raises
# They are no faults of a search: the file does not load, or the machine failed.
PASSED_ON = (FaultError, LoadError, OSError)
REPORT = "This is a fault of the kit. Please report it, and include your function."
_stopped: ContextVar[list[str] | None] = ContextVar("stopped", default=None)


def attempt(search: Callable[..., Any], *args: Any, otherwise: Any = None) -> Any:
    """Return what a search returns, or something else where it stops.

    Args:
        search: may stop with any exception.
        args: its arguments.
        otherwise: what is returned where it stops.
    """
    try:
        return search(*args)
    except PASSED_ON:
        raise
    except Exception as error:
        if os.environ.get(LOUD):
            raise
        if (stopped := _stopped.get()) is not None:
            stopped.append(_in_words(error))
        return otherwise


def guarded(hook: Callable[..., Any], otherwise: Any = None) -> Callable[..., Any]:
    """Return a hook that returns something else where it stops."""

    @functools.wraps(hook)
    def asked(*args: Any) -> Any:
        return attempt(hook, *args, otherwise=otherwise)

    return asked


@contextlib.contextmanager
def noting() -> Iterator[list[str]]:
    """Give a list of what stopped, in words, which is filled within the block."""
    found: list[str] = []
    before = _stopped.set(found)
    try:
        yield found
    finally:
        _stopped.reset(before)


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Let code that is tried on a student's numbers print and warn of nothing."""
    with (
        nothing_printed(),
        warnings.catch_warnings(action="ignore"),
        np.errstate(all="ignore"),
    ):
        yield


def told(stopped: list[str]) -> str:
    """Return two sentences on what stopped, for a student, or ""."""
    if not stopped:
        return ""
    return (
        f"The checker failed while it searched for the cause ({stopped[0]}). {REPORT}"
    )


def _in_words(error: Exception) -> str:
    """Return the error's name and the last line of the kit that led to it."""
    if isinstance(error, Robo47Error):  # it says where
        return str(error).rstrip(".")
    frames = traceback.extract_tb(error.__traceback__)
    outside = Path(sys.prefix)
    places = [
        (Path(frame.filename).relative_to(ROOT).as_posix(), frame.lineno)
        for frame in frames
        if Path(frame.filename).is_relative_to(ROOT)
        and not Path(frame.filename).is_relative_to(outside)
    ]
    where = "".join(f" in {file}, line {line}" for file, line in places[-1:])
    return f"{type(error).__name__}{where}"
