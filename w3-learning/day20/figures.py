"""The picture of Day 20, made with the lab's own functions; drawn by `make figures`.

reward   200 estimates of one gradient by four estimators; successes over iterations
"""

from functools import cache
from types import SimpleNamespace

import day20_reward as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import chart
from labkit.figures.chart import BLUE, GREY, INK, ORANGE, RED

import day15_mujoco

SILENT = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))
SHOWN = (  # estimators of both clouds, their colours, and the range of the axes
    ((("whole return", GREY), ("return to go", ORANGE)), 75),
    ((("half the value, lambda 0.5", RED), ("exact value, lambda 1", BLUE)), 15),
)


@cache
def trained():
    """Return counts at home over iterations, and runs before and after (2 s)."""
    start = day15_mujoco.starts(lab.TESTED, np.random.default_rng(lab.STARTS_SEED))
    policy = lab.clone(SILENT)
    counts, runs = [], []

    def test(policy, rows=None) -> None:
        run, last = lab.tested(policy.act, start)
        counts.append((run.home().sum(), lab.at_home(last).sum()))
        runs[1:] = [run]

    test(policy)
    runs.append(runs[0])
    done = [0]

    def after(policy, rows) -> None:
        done[0] += 1
        if done[0] % 5 == 0:
            test(policy)

    lab.ppo(SILENT, policy, after)
    return np.array(counts), {"the clone": runs[0], "improved": runs[1]}


@chart.picture(height=7.2)
def reward(figure: Figure) -> None:
    """Draw the estimates of one gradient, and what a reward improves."""
    above, below = figure.subfigures(2, 1, height_ratios=(1.25, 1.0))
    cart = lab.Cart(np.random.default_rng(lab.SEED), lab.BATCHES * lab.EACH)
    weights = lab.weights_of(cart)
    for axes, (some, most) in zip(above.subplots(1, 2), SHOWN, strict=True):
        for name, colour in some:
            x, y = cart.estimates(weights[name]).T
            axes.plot(x, y, ".", ms=4, color=colour, label=name)
        _exact(axes)
        axes.set(xlim=(-most, most), ylim=(-most, most), aspect="equal")
        axes.set(xlabel="first entry", ylabel="second entry")
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0))
        axes.grid()
    gain = below.subplots()
    counts = trained()[0]
    x = 5 * np.arange(len(counts))
    gain.plot(x, counts[:, 0], "o-", color=BLUE, label="in MuJoCo")
    gain.plot(x, counts[:, 1], "s--", color=ORANGE, label="by the equation")
    gain.set(xlabel="iterations of PPO", ylabel=f"pucks at home, of {lab.TESTED}")
    gain.set(ylim=(0.4 * lab.TESTED, 0.8 * lab.TESTED))
    gain.legend(loc="upper left")
    gain.grid()


def _exact(axes: Axes) -> None:
    """Draw the exact gradient of the return."""
    rest = lab.STD, lab.A, lab.B, lab.Q, lab.R, lab.START, lab.HORIZON
    truth = -lab.policy_cost_gradient(lab.GAIN, *rest)[0]
    axes.plot(*truth, "+", color=INK, ms=14, mew=2, label="exact gradient")


def small() -> Image.Image:
    """Return a wide cloud of estimates around a narrow one."""
    figure = Figure(figsize=(6.72, 5.04), dpi=100, facecolor="#1b1f24")
    axes = figure.add_axes((0, 0, 1, 1))
    cart = lab.Cart(np.random.default_rng(lab.SEED), lab.BATCHES * lab.EACH)
    weights = lab.weights_of(cart)
    for name, colour in (
        ("return to go", "#e69f00"),
        ("exact value, lambda 1", "#59bff2"),
    ):
        axes.plot(*cart.estimates(weights[name]).T, ".", ms=16, color=colour)
    axes.set(xlim=(-40, 55), ylim=(-36, 34))
    axes.set_axis_off()
    return chart.image_of(figure)


FIGURES = {"reward": reward}
SMALL = (small, "20.9 or 1.52")  # of a table of days, and its number
