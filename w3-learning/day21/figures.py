"""The picture of Day 21, made with the lab's own functions; drawn by `make figures`.

push   paths around the puck on both sides; pucks at home over the delay of the plans
"""

from functools import cache

import day21_deploy as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from PIL import Image

from labkit.figures import chart
from labkit.figures.chart import BLUE, GREY, INK, ORANGE, RED
from labkit.figures.pushing import MM
from robo47 import push, pushing

SHOWN = 30  # paths
COLOURS = {"first": RED, "indexed": ORANGE, "ahead": BLUE}


@cache
def driven(ticks: int, how: str) -> push.Episodes:
    """Return what the kit's policy does from the starts of the test, with late plans.

    The first call trains the policy: three seconds of processor time.
    """
    start = push.dock(lab.TESTED, np.random.default_rng(lab.STARTS_SEED))
    policy = pushing.policy(pushing.library())
    drive = lab.Late(policy, len(start), ticks, how)
    return push.run(*push.scene(), start, drive, push.STEPS + ticks)


def near(run: push.Episodes) -> np.ndarray:
    """Return which pucks end near home, (n,)."""
    return np.linalg.norm(run.observation[:, -1, 2:], axis=1) < lab.NEAR


@chart.picture(height=4.6)
def pushed(figure: Figure) -> None:
    """Draw paths around the puck, and pucks at home over the delay."""
    paths, late = figure.subplots(1, 2, width_ratios=(1.0, 1.5))
    _paths(paths, 1.2)
    paths.set_title(f"{SHOWN} paths of the pusher")
    paths.set_axis_off()
    delays = np.arange(lab.LATE + 1)
    for how, colour in COLOURS.items():
        counts = [np.sum(near(driven(t, how if t else "first"))) for t in delays]
        late.plot(delays, counts, "o-", color=colour, label=lab.WAYS[how])
    late.set(title="Pucks that end within 10 mm", xlabel="delay of the plans, ticks")
    late.set(ylabel=f"of {lab.TESTED}", ylim=(0, 1.05 * lab.TESTED))
    late.set_xticks(delays)
    late.legend(loc="lower left")
    late.grid()


def _paths(axes: Axes, width: float, blue: str = BLUE, red: str = RED) -> None:
    """Draw paths of the pusher, each rotated so that its puck starts above home."""
    run = driven(1, "ahead")
    left = push.on_the_left(run)
    for seen, side in list(zip(run.observation, left, strict=True))[:SHOWN]:
        x, y = seen[0, 2:] / np.linalg.norm(seen[0, 2:])
        path = seen[:, :2] @ np.array([[y, x], [-x, y]])
        axes.plot(*MM * path.T, color=blue if side else red, linewidth=width)
    axes.add_patch(Circle((0, 180), MM * push.PUCK, fill=False, color=GREY))
    axes.plot(0, 0, "+", color=INK, ms=10)
    axes.set(aspect="equal", xlim=(-150, 150), ylim=(-40, 330))


def small() -> Image.Image:
    """Return paths of the pusher on both sides of a puck."""
    figure = Figure(figsize=(6.72, 5.04), dpi=100, facecolor="#1b1f24")
    axes = figure.add_axes((0, 0, 1, 1))
    _paths(axes, 5, "#59bff2", "#f24236")
    axes.add_patch(Circle((0, 180), MM * push.PUCK, color="#ff991a"))
    axes.set(xlim=(-260, 260), ylim=(-50, 340))
    axes.set_axis_off()
    return chart.image_of(figure)


FIGURES = {"push": pushed}
SMALL = (small, "5 of 10")  # of a table of days, and its number
