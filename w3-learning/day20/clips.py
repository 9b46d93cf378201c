"""The clip of Day 20: a clone and what its reward made of it, from the same starts.

make figures DAY=20 ARGS=--clips    figures/day20_improved.webp
"""

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes

from labkit.figures import pushing
from labkit.figures.chart import BLUE, RED
from labkit.figures.clip import Frame
from labkit.figures.pushing import MM
from labkit.lesson.day import find_day


def frames() -> Iterator[Frame]:
    """Yield the clip's frames and how long each is seen."""
    runs = find_day(20).module("figures").trained()[1]
    before, after = runs.values()
    starts = np.flatnonzero(after.home() & ~before.home())[[0, 3]]

    def draw(axes: Axes, i: int, start: int, k: int) -> None:
        seen = [*runs.values()][i].observation[start]
        axes.plot(*MM * seen[: k + 1, 2:].T, color=(RED, BLUE)[i], linewidth=1.5)
        pushing.bodies(axes, seen[k])

    yield from pushing.film(starts, [*runs], draw, home="0.6")


CLIPS = {"improved": frames}
