"""The clip of Day 16: one action per chunk and four, after a pause, from above.

make figures DAY=16 ARGS=--clips    figures/day16_pause.webp
"""

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from labkit.figures import chart
from labkit.figures.chart import BLUE, GREY, INK, RED
from labkit.figures.clip import Frame
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import chunking

import day15_mujoco

LAB = lab_of(find_day(16))
EVERY = 2  # steps between two frames
SECONDS = 0.12  # that a frame is seen
MM = 1000.0
EXECUTED = (1, 4)  # actions per chunk


def frames() -> Iterator[Frame]:
    """Yield the clip's frames and how long each is seen."""
    some = find_day(16).module("figures").paused()
    plan = some.plan("absolute")
    runs = [
        LAB.episodes_of(chunking.chunked_policy(plan, h), LAB.WAIT) for h in EXECUTED
    ]
    far = np.linalg.norm(runs[0].observation[:, -1, 2:], axis=1)
    start = int(np.argmax(far * runs[1].home()))
    steps = runs[0].action.shape[1]
    for k in range(0, steps + 1, EVERY):
        last = k + EVERY > steps
        yield Frame(_moment(runs, some, start, k)(), 1.2 if last else SECONDS)


def _moment(runs, some, start: int, k: int):
    """Return what draws both runs at a step, side by side, with their plans."""
    plan = some.plan("absolute")

    @chart.picture(height=3.4, width=6.4)
    def both(figure: Figure) -> None:
        for axes, run, h, colour in zip(
            figure.subplots(1, 2), runs, EXECUTED, (RED, BLUE), strict=True
        ):
            seen = run.observation[start]
            path = seen[k, :2] + np.cumsum(plan(seen[k : k + 1])[0], axis=0) * 0.1
            axes.add_patch(Circle((0, 0), MM * day15_mujoco.HOME, color="0.85"))
            axes.plot(*MM * seen[: k + 1, :2].T, color=GREY, linewidth=1)
            axes.plot(*MM * path.T, "o", color=colour, ms=2)
            axes.add_patch(
                Circle(MM * seen[k, 2:], MM * day15_mujoco.PUCK, color=colour)
            )
            axes.add_patch(
                Circle(MM * seen[k, :2], MM * day15_mujoco.PUSHER, color=INK)
            )
            axes.set(xlim=(-340, 340), ylim=(-320, 320), aspect="equal")
            word = "action" if h == 1 else "actions"
            axes.set(title=f"{h} {word} per chunk, {k * day15_mujoco.TICK:.1f} s")
            axes.set(xticks=(), yticks=())
            axes.spines[:].set_color(GREY)

    return both


CLIPS = {"pause": frames}
