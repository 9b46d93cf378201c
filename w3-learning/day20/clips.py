"""The clip of Day 20: a clone and what its reward made of it, from the same starts.

make figures DAY=20 ARGS=--clips    figures/day20_improved.webp
"""

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from labkit.figures import chart
from labkit.figures.chart import BLUE, GREY, RED
from labkit.figures.clip import Frame
from labkit.lesson.day import find_day

import day15_mujoco

EVERY = 2  # steps between two frames
SECONDS = 0.12  # that a frame is seen
MM = 1000.0


def frames() -> Iterator[Frame]:
    """Yield the clip's frames and how long each is seen."""
    figures = find_day(20).module("figures")
    runs = figures.trained()[1]
    before, after = runs.values()
    for start in np.flatnonzero(after.home() & ~before.home())[[0, 3]]:
        for k in range(0, day15_mujoco.STEPS + 1, EVERY):
            last = k + EVERY > day15_mujoco.STEPS
            yield Frame(_moment(figures, runs, start, k)(), 1.2 if last else SECONDS)


def _moment(figures, runs, start: int, k: int):
    """Return what draws both runs at a step, side by side."""

    @chart.picture(height=3.4, width=6.4)
    def both(figure: Figure) -> None:
        for axes, (name, run), colour in zip(
            figure.subplots(1, 2), runs.items(), (RED, BLUE), strict=True
        ):
            seen = run.observation[start]
            axes.add_patch(Circle((0, 0), MM * day15_mujoco.HOME, color="0.6"))
            axes.plot(*MM * seen[: k + 1, 2:].T, color=colour, linewidth=1.5)
            figures.bodies(axes, seen[k])
            axes.set(xlim=(-400, 400), ylim=(-380, 380), aspect="equal")
            axes.set(title=f"{name}, {k * day15_mujoco.TICK:.1f} s")
            axes.set(xticks=(), yticks=())
            axes.spines[:].set_color(GREY)

    return both


CLIPS = {"improved": frames}
