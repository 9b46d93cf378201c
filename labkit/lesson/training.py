"""The steps of a training, counted and shown as a bar on the terminal.

    for k in lab.training("the clone", 1000):
        ...

The bar goes to standard error and only to a terminal, so that no output of a lab
depends on it, and it is removed at the end.
"""

import sys
import time
from collections.abc import Iterator
from typing import TextIO

WIDTH = 30  # characters of the bar
OFTEN = 0.1  # seconds between two bars


def training(title: str, steps: int, stream: TextIO | None = None) -> Iterator[int]:
    """Yield the numbers of the steps, from 1, and show on a terminal how far it is.

    Args:
        title: what is trained, "the clone".
        steps: how many steps there are.
        stream: where the bar is shown; standard error by default.
    """
    stream = sys.stderr if stream is None else stream
    if stream is None or not stream.isatty():  # a program without a console has none
        yield from range(1, steps + 1)
        return
    shown = -1.0
    try:
        for k in range(1, steps + 1):
            if time.monotonic() - shown > OFTEN:
                shown = time.monotonic()
                _write(stream, _bar(title, (k - 1) / steps))
            yield k
    finally:
        _write(stream, "\x1b[2K\r")


def _bar(title: str, part: float) -> str:
    """Return a line such as "\r  training the clone [######      ]  50 %"."""
    full = round(WIDTH * part)
    bar = "#" * full + " " * (WIDTH - full)
    return f"\r  training {title} [{bar}] {100 * part:3.0f} %"


def _write(stream: TextIO, text: str) -> None:
    stream.write(text)
    stream.flush()
