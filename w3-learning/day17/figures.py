"""The picture of Day 17, made with the lab's own functions; drawn by `make figures`.

samples  a histogram of the linear schedule's samples, and their paths from the noise
"""

import contextlib
import io
from functools import cache

import day17_diffusion as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from PIL import Image

from labkit.figures import chart
from labkit.figures.chart import BLUE, INK, ORANGE
from robo47 import diffusion, push

PATHS = 60  # in the picture
MM = 1000.0
START = 8  # of the test, in the picture and in the film


class Silent:
    """A lab that only counts the steps of a training."""

    @staticmethod
    def training(title: str, steps: int) -> range:
        """Return the numbers of the steps."""
        return range(1, steps + 1)


@cache
def planner() -> lab.Planner:
    """Train the network that draws plans; two seconds of processor time."""
    with contextlib.redirect_stdout(io.StringIO()):
        return lab.train(Silent(), *lab.demonstrations())[0]


def linear_samples() -> np.ndarray:
    """Return samples by the linear schedule, whose noisy end is not only noise."""
    abars = diffusion.linear_schedule(lab.LEVELS)[::-1]
    return lab.ddim(lab.quantiles(lab.SAMPLES), abars, lab.noise_of)


@chart.picture(height=4.2)
def samples(figure: Figure) -> None:
    """Draw a histogram beside the density of the data, and paths of samples."""
    left, right = figure.subplots(1, 2)
    _histogram(left)
    _paths(right)


def _histogram(axes: Axes) -> None:
    """Draw the samples of the linear schedule and the density of the data."""
    found = linear_samples()
    edges = np.linspace(-1.5, 1.5, 61)
    axes.hist(found[:, 0], edges, density=True, color=BLUE, label="samples")
    x = np.linspace(-1.5, 1.5, 600)
    bells = np.exp(-0.5 * ((x - lab.MEANS) / lab.SIGMA) ** 2)
    density = lab.WEIGHTS @ bells / (lab.SIGMA * np.sqrt(2 * np.pi))
    axes.plot(x, density, color=INK, label="data")
    for side, right in ((-0.55, np.mean(found < 0)), (0.45, np.mean(found > 0))):
        axes.text(side, 2.0, f"{100 * right:.0f} %", color=BLUE, ha="center")
    axes.set(title="Linear schedule, 100 levels", xlabel="x", ylabel="density")
    axes.legend(loc="upper left")


def _paths(axes: Axes) -> None:
    """Draw how samples move from noise to the modes, by the end that they reach."""
    abars = diffusion.linear_schedule(lab.LEVELS)[::-1]
    moved = [lab.quantiles(PATHS)]
    for abar, prev in zip(abars, [*abars[1:], 1.0], strict=True):
        eps = lab.noise_of(moved[-1], abar)
        moved.append(lab.ddim_step(moved[-1], eps, abar, prev))
    moved = np.array(moved)[:, :, 0]
    for side, colour in ((moved[-1] > 0, ORANGE), (moved[-1] < 0, BLUE)):
        axes.plot(moved[:, side], color=colour, linewidth=0.8)
    axes.set(title="From noise to samples", xlabel="steps", ylabel="x")
    axes.grid()


def paths(plans: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Return the positions of the pusher by each plan, mm, (n, 9, 2)."""
    moved = push.TICK * np.cumsum(plans, axis=1)
    first = np.zeros((len(plans), 1, 2))
    return MM * (start[:2] + np.concatenate([first, moved], axis=1))


def small() -> Image.Image:
    """Return pusher and puck, and plans to both sides."""
    figure = Figure(figsize=(6.72, 5.04), dpi=100, facecolor="#1b1f24")
    axes = figure.add_axes((0, 0, 1, 1))
    start = push.dock(lab.TESTED, np.random.default_rng(lab.STARTS_SEED))[START]
    noise = np.random.default_rng(3).normal(size=(24, 2 * lab.ACTIONS))
    plans = planner().draw(np.tile(start, (24, 1)), noise)
    for path in paths(plans, start):
        axes.plot(*path.T, color="#59bff2", linewidth=5, alpha=0.6)
    axes.add_patch(Circle(MM * start[2:], MM * push.PUCK, color="#ff991a"))
    axes.add_patch(Circle(MM * start[:2], MM * push.PUSHER, color="#f24236"))
    middle = MM * (start[:2] + start[2:]) / 2
    axes.set(xlim=middle[0] + np.array([-200, 200]), aspect="equal")
    axes.set(ylim=middle[1] + np.array([-150, 150]))
    axes.set_axis_off()
    return chart.image_of(figure)


FIGURES = {"samples": samples}
SMALL = (small, "60 %")  # of a table of days, and its number
