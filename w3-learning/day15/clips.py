"""The clip of Day 15: the clone and the copycat from the same start, from above.

make figures DAY=15 ARGS=--clips    figures/day15_copycat.webp
"""

from collections.abc import Iterator

from matplotlib.axes import Axes

from labkit.figures import pushing
from labkit.figures.chart import BLUE, RED
from labkit.figures.clip import Frame
from labkit.figures.pushing import MM
from labkit.lesson.day import find_day

STARTS = (3, 11)  # of the test, one after the other
COLOURS = {"clone": BLUE, "copycat": RED}


def frames() -> Iterator[Frame]:
    """Yield the clip's frames and how long each is seen."""
    runs = find_day(15).module("figures").learned().runs

    def draw(axes: Axes, i: int, start: int, k: int) -> None:
        name, colour = [*COLOURS.items()][i]
        seen = runs[name].observation[start]
        axes.plot(*MM * seen[: k + 1, 2:].T, color=colour, linewidth=1.5)
        pushing.bodies(axes, seen[k], colour)

    yield from pushing.film(STARTS, [*COLOURS], draw)


CLIPS = {"copycat": frames}
