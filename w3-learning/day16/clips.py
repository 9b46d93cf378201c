"""The clip of Day 16: one action per chunk and four, after a pause, from above.

make figures DAY=16 ARGS=--clips    figures/day16_pause.webp
"""

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes

from labkit.figures import pushing
from labkit.figures.chart import BLUE, GREY, RED
from labkit.figures.clip import Frame
from labkit.figures.pushing import MM
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import chunking, push

LAB = lab_of(find_day(16))
EXECUTED = (1, 4)  # actions per chunk
TITLES = ("1 action per chunk", "4 actions per chunk")


def frames() -> Iterator[Frame]:
    """Yield the clip's frames and how long each is seen."""
    plan = find_day(16).module("figures").paused().plan("absolute")
    runs = [
        LAB.episodes_of(chunking.chunked_policy(plan, h), LAB.WAIT) for h in EXECUTED
    ]
    far = np.linalg.norm(runs[0].observation[:, -1, 2:], axis=1)
    start = int(np.argmax(far * runs[1].home()))

    def draw(axes: Axes, i: int, start: int, k: int) -> None:
        seen, colour = runs[i].observation[start], (RED, BLUE)[i]
        steps = plan(seen[k : k + 1])[0] * push.TICK
        path = seen[k, :2] + np.cumsum(steps, axis=0)
        axes.plot(*MM * seen[: k + 1, :2].T, color=GREY, linewidth=1)
        axes.plot(*MM * path.T, "o", color=colour, ms=2)
        pushing.bodies(axes, seen[k], colour)

    steps = runs[0].action.shape[1]
    yield from pushing.film([start], TITLES, draw, steps, half=(340, 320))


CLIPS = {"pause": frames}
