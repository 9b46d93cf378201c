"""A progress bar over the lines of a file, for what takes more than a second."""

import os
from collections.abc import Iterator
from pathlib import Path

from tqdm import tqdm

from labkit.log.scan import Line


def watched(lines: Iterator[Line], path: Path) -> Iterator[Line]:
    """Yield what `scan` yields, and show how far through the file it is."""
    size = os.path.getsize(path) if path.exists() else 0
    with tqdm(
        total=size,
        unit="B",
        unit_scale=True,
        desc="reading",
        delay=0.5,
        leave=False,
        disable=None,
    ) as bar:
        for line in lines:
            bar.update(line.size)
            yield line
