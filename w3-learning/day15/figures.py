"""The picture of Day 15, made with the lab's own functions; drawn by `make figures`.

cloned   one start with the paths of clone and copycat; successes over the loss
"""

import contextlib
import io
from functools import cache
from typing import NamedTuple

import day15_cloning as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from PIL import Image

from labkit.figures import chart
from labkit.figures.chart import BLUE, GREY, INK, ORANGE, RED

import day15_mujoco

SHOWN = 3  # of the starts of the test: the copycat fails there
MM = 1000.0


class Silent:
    """A lab that only counts the steps of a training."""

    @staticmethod
    def training(title: str, steps: int) -> range:
        """Return the numbers of the steps."""
        return range(1, steps + 1)

    @staticmethod
    def check(*_: object) -> None:
        """Check nothing."""


class Learned(NamedTuple):
    """Both policies, what they did in the test, and their losses on held-out rows."""

    clone: lab.Clone
    copycat: lab.Clone
    runs: dict[str, day15_mujoco.Episodes]  # by name
    losses: dict[str, float]


@cache
def learned() -> Learned:
    """Train both networks and test them; a second of processor time."""
    with contextlib.redirect_stdout(io.StringIO()):
        (x, action, episode), (seen, done, of) = lab.data_of(Silent())
    both, both_held = (
        np.hstack([a, lab.with_last(e, b)])
        for a, b, e in ((x, action, episode), (seen, done, of))
    )
    clone = lab.train(Silent(), "the clone", x, action)
    copycat = lab.train(Silent(), "the copycat", both, action)
    repeats = lab.persistence_loss(lab.normalise(done, clone.actions), of)
    runs = {
        "clone": lab.tested(clone.act),
        "copycat": lab.tested(lab.repeating(copycat)),
        "copycat, told the truth": lab.tested(lab.repeating(copycat, truth=True)),
    }
    loss = copycat.loss(both_held, done)
    losses = {
        "clone": clone.loss(seen, done),
        "copycat": loss,
        "copycat, told the truth": loss,
        "repeat the last action": repeats,
    }
    return Learned(clone, copycat, runs, losses)


@chart.picture(height=5.2)
def cloned(figure: Figure) -> None:
    """Draw one start with both paths, and pucks at home over the loss."""
    paths, rates = figure.subplots(1, 2, width_ratios=(1.1, 1.0))
    some = learned()
    _paths(paths, some)
    _rates(rates, some)


def _paths(axes: Axes, some: Learned) -> None:
    """Draw the paths of pusher and puck from one start, seen from above."""
    axes.add_patch(Circle((0, 0), MM * day15_mujoco.HOME, color="0.8", label="home"))
    for name, colour, style in (("clone", BLUE, "-"), ("copycat", RED, "--")):
        seen = MM * some.runs[name].observation[SHOWN]
        axes.plot(*seen[:, 2:].T, style, color=colour, label=name)
        axes.plot(*seen[:, :2].T, style, color=colour, linewidth=1.2)
        end = seen[-1, 2:]
        axes.add_patch(Circle(end, MM * day15_mujoco.PUCK, fill=False, color=colour))
    start = MM * some.runs["clone"].observation[SHOWN, 0]
    for centre, radius in ((start[:2], day15_mujoco.PUSHER),
                           (start[2:], day15_mujoco.PUCK)):  # fmt: skip
        axes.add_patch(Circle(centre, MM * radius, fill=False, color=INK))
    axes.set(title="One start, from above", xlabel="x, mm", aspect="equal")
    axes.set(xlim=(-330, 110), ylim=(-340, 110))
    axes.legend(loc="center left")


def _rates(axes: Axes, some: Learned) -> None:
    """Draw how many pucks each policy brings home, over its loss on held-out rows."""
    marks = {"clone": ("o", BLUE), "copycat": ("X", RED),
             "copycat, told the truth": ("D", ORANGE),
             "repeat the last action": ("s", GREY)}  # fmt: skip
    for name, (mark, colour) in marks.items():
        run = some.runs.get(name)
        home = int(np.sum(run.home())) if run else 0
        axes.plot(some.losses[name], home, mark, color=colour, ms=11, label=name)
    axes.set(title="The loss and the robot", xlabel="loss on held-out rows")
    axes.set(ylabel=f"pucks home, of {lab.TESTED}", ylim=(-10, 1.1 * lab.TESTED))
    axes.set_xlim(0, 1.25 * max(some.losses.values()))
    axes.legend(loc="center", bbox_to_anchor=(0.45, 0.5))
    axes.grid()


def small() -> Image.Image:
    """Return pusher, puck and home, with the path of the clone."""
    figure = Figure(figsize=(6.72, 5.04), dpi=100, facecolor="#1b1f24")
    axes = figure.add_axes((0, 0, 1, 1))
    seen = MM * learned().runs["clone"].observation[SHOWN]
    axes.plot(*seen[:, 2:].T, color="#59bff2", linewidth=9)
    axes.add_patch(Circle((0, 0), 22, color="#40cc66"))
    axes.add_patch(Circle(seen[0, 2:], 50, color="#ff991a"))
    axes.add_patch(Circle(seen[0, :2], 18, color="#f24236"))
    middle = (seen[0, 2:] + seen[-1, 2:]) / 2
    axes.set(xlim=middle[0] + np.array([-220, 220]), aspect="equal")
    axes.set(ylim=middle[1] + np.array([-165, 165]))
    axes.set_axis_off()
    return chart.image_of(figure)


FIGURES = {"cloned": cloned}
SMALL = (small, "20 of 200")  # of a table of days, and its number
