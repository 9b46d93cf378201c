"""The clip of Day 21: late plans, run as they are and drawn for the predicted state.

make figures DAY=21 ARGS=--clips    figures/day21_late.webp
"""

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes

from labkit.figures import pushing
from labkit.figures.chart import BLUE, GREY, RED
from labkit.figures.clip import Frame
from labkit.figures.pushing import MM
from labkit.lesson.day import find_day

TITLES = ("0.3 s late", "for the predicted state")


def frames() -> Iterator[Frame]:
    """Yield the clip's frames and how long each is seen."""
    figures = find_day(21).module("figures")
    runs = [figures.driven(figures.lab.LATE, how) for how in ("first", "ahead")]
    far = np.linalg.norm(runs[0].observation[:, -1, 2:], axis=1)
    missed = np.argsort(-far * figures.near(runs[1]))[:2]

    def draw(axes: Axes, i: int, start: int, k: int) -> None:
        seen, colour = runs[i].observation[start], (RED, BLUE)[i]
        axes.plot(*MM * seen[: k + 1, :2].T, color=GREY, linewidth=1)
        axes.plot(*MM * seen[: k + 1, 2:].T, color=colour, linewidth=1.5)
        pushing.bodies(axes, seen[k], colour)

    yield from pushing.film(missed, TITLES, draw, half=(340, 320), home="0.6")


CLIPS = {"late": frames}
