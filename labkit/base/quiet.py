"""Discards the output of libraries: LAPACK prints a line for every NaN."""

import contextlib
import os
import sys
import threading
from collections.abc import Iterator

_ONE = threading.RLock()  # two at once would each restore what the other had set


@contextlib.contextmanager
def nothing_printed() -> Iterator[None]:
    """Send descriptor 1 nowhere for a while, also for what is no Python."""
    with _ONE:
        sys.stdout.flush()
        try:
            kept = os.dup(1)
        except OSError:  # a program without a terminal has none
            yield
            return
        nowhere = os.open(os.devnull, os.O_WRONLY)
        try:
            os.dup2(nowhere, 1)
            yield
        finally:
            os.dup2(kept, 1)
            os.close(kept)
            os.close(nowhere)
