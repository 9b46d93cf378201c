"""The picture of Day 18, made with the lab's own functions; drawn by `make figures`.

data   successes of three kinds of data over the seeds; power over the number of starts
"""

from functools import cache
from unittest.mock import patch

import day18_evaluation as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from PIL import Image

from labkit.figures import chart
from labkit.figures.chart import BLUE, GREY, INK, ORANGE, RED
from robo47.policy import success_rate

SEEDS = range(1, 3)
STARTS = 100  # of each test
KINDS = {  # by name: actions that the policy drives, colour and mark
    "fresh demonstrations": (0, BLUE, "o"),
    "policy drives 20 actions": (20, ORANGE, "D"),
    "DAgger": (60, RED, "X"),
}
RATES = (0.885, 0.695)  # of both policies, in the picture of the power
CORRELATIONS = (0.0, 0.25, 0.5)
LEVEL = 0.05
Z = 1.959964  # of the two-sided test with this level


class Silent:
    """A lab that only counts the steps of a training."""

    @staticmethod
    def training(title: str, steps: int) -> range:
        """Return the numbers of the steps."""
        return range(1, steps + 1)


@cache
def policy(seed: int, actions: int) -> lab.Policy:
    """Return a trained policy; half a second of processor time."""
    with patch.object(lab, "SEED", seed):
        return lab.learned(Silent(), actions)


def home(seed: int, actions: int) -> np.ndarray:
    """Return the successes of a policy on the starts of the test."""
    return lab.outcomes(policy(seed, actions), STARTS)


@chart.picture(height=5.2)
def data(figure: Figure) -> None:
    """Draw the successes for each seed, and the power of the tests."""
    seeds, power = figure.subplots(1, 2, width_ratios=(1.0, 1.0))
    _seeds(seeds)
    _power(power)


def _seeds(axes: Axes) -> None:
    """Draw the success rates of each seed with their confidence intervals."""
    for j, (name, (actions, colour, mark)) in enumerate(KINDS.items()):
        rates = np.array([success_rate(home(seed, actions)) for seed in SEEDS])
        rate, low, high = 100 * rates.T
        at = np.array(SEEDS) + 0.14 * (j - 1)
        bars = np.array([rate - low, high - rate])
        axes.errorbar(at, rate, bars, fmt=mark, color=colour, label=name, capsize=2)
    axes.set(
        title="30 episodes",
        xlabel="seed",
        xticks=SEEDS,
        ylabel="pucks home, %",
        ylim=(0, 104),
    )
    axes.legend(loc="lower left", fontsize="small")
    axes.grid(axis="y")


def unpaired(n: int) -> float:
    """Return the power of the unpaired z-test, each policy on n starts of its own."""
    k = np.arange(n + 1)
    a, b = k[:, None] / n, k / n
    both = (a + b) / 2
    spread = np.sqrt(np.maximum(2 * both * (1 - both) / n, 1e-12))
    chance = np.outer(*(lab.binomial_pmf(n, p) for p in RATES))
    return float(np.sum(chance[np.abs(a - b) >= Z * spread]))


def paired(n: int, correlation: float) -> float:
    """Return the power of the sign test, for a correlation of the successes."""
    one, two = RATES
    width = np.sqrt(one * (1 - one) * two * (1 - two))
    common = one * two + correlation * width  # both succeed
    return lab.paired_power(one - common, max(two - common, 0.0), n, LEVEL)


def _power(axes: Axes) -> None:
    """Draw the power over the number of starts."""
    some = np.arange(5, 101, 5)
    styles = zip(CORRELATIONS, (BLUE, ORANGE, RED), strict=True)
    for correlation, colour in styles:
        power = [100 * paired(int(n), correlation) for n in some]
        name = f"r = {correlation:g}"
        axes.plot(some, power, color=colour, label=name)
    power = [100 * unpaired(int(n)) for n in some]
    axes.plot(some, power, "--", color=INK, label="unpaired")
    axes.axhline(100 * LEVEL, color=GREY, linewidth=1)
    axes.set(title="Power of a test", xlabel="starts", ylim=(0, 104))
    axes.set(ylabel="power, %", xlim=(0, 102))
    axes.legend(loc="lower right", fontsize="small")
    axes.grid()


def small() -> Image.Image:
    """Return a row of pucks for each kind of data: at home or not."""
    figure = Figure(figsize=(6.72, 5.04), dpi=100, facecolor="#1b1f24")
    axes = figure.add_axes((0, 0, 1, 1))
    for j, count in enumerate((7, 10, 9)):
        for i in range(10):
            colour = "#40cc66" if i < count else "#5a6470"
            axes.add_patch(Circle((i, j), 0.38, color=colour))
    axes.set(xlim=(-0.9, 9.9), ylim=(-2.9, 5.2), aspect="equal")
    axes.set_axis_off()
    return chart.image_of(figure)


FIGURES = {"data": data}
SMALL = (small, "140 of 200")  # of a table of days, and its number
