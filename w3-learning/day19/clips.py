"""The clip of Day 19: both networks from the same start, with what the camera sees.

make figures DAY=19 ARGS=--clips    figures/day19_places.webp
"""

from collections.abc import Iterator

from matplotlib.axes import Axes

from labkit.figures import pushing
from labkit.figures.chart import BLUE, RED
from labkit.figures.clip import Frame
from labkit.figures.pushing import MM
from labkit.lesson.day import find_day

STARTS = (3, 8)  # of the test, one after the other


def frames() -> Iterator[Frame]:
    """Yield the clip's frames and how long each is seen."""
    figures = find_day(19).module("figures")
    runs = figures.trained().runs

    def draw(axes: Axes, i: int, start: int, k: int) -> None:
        seen = [*runs.values()][i].observation[start]
        figures.show(axes, figures.lab.camera(seen[k : k + 1])[0])
        axes.plot(*MM * seen[: k + 1, 2:].T, color=(RED, BLUE)[i], linewidth=1.5)
        pushing.bodies(axes, seen[k])

    yield from pushing.film(STARTS, [*runs], draw, home="0.6")


CLIPS = {"places": frames}
