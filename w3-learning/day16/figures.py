"""The picture of Day 16, made with the lab's own functions; drawn by `make figures`.

decision   speeds of a chunk's entries after a pause; plans for nine values of z
"""

from functools import cache
from types import SimpleNamespace
from typing import NamedTuple
from unittest.mock import patch

import day16_chunking as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from PIL import Image

from labkit.figures import chart
from labkit.figures.chart import BLUE, INK, RED
from robo47 import cloning

import day15_mujoco

MM = 1000.0
START = np.array([[0.0, 0.0, 0.0, -0.18]])  # pusher at home, puck below it
SILENT = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))
DEAD = 0.3  # a beta with which z has no effect
ZS = np.linspace(-2, 2, 9)


class Paused(NamedTuple):
    """Demonstrations with a pause, and a network for each loss."""

    episodes: day15_mujoco.Episodes
    data: lab.Data
    nets: dict[str, list]

    def plan(self, name: str):
        """Return the plan of a network."""
        return lambda seen: self.data.plan(
            cloning.normalise(seen, self.data.inputs), self.nets[name]
        )


@cache
def paused() -> Paused:
    """Train both networks that learn the pause; two seconds of processor time."""
    episodes = day15_mujoco.dock_demonstrations(
        lab.DEMOS, lab.SEED, coin=False, wait=lab.WAIT
    )
    data = lab.Data(episodes, lab.PAUSE_K)
    losses = {"squared": lab.masked_l2, "absolute": lab.masked_l1}
    nets = {
        name: lab.train_chunks(SILENT, "", data, loss) for name, loss in losses.items()
    }
    return Paused(episodes, data, nets)


@cache
def latent(beta: float = lab.BETA) -> lab.Latent:
    """Train encoder and decoder; two seconds of processor time."""
    episodes = day15_mujoco.dock_demonstrations(lab.DEMOS, lab.SEED)
    with patch.object(lab, "BETA", beta):
        return lab.Latent(SILENT, lab.Data(episodes, lab.K))


@chart.picture(height=4.6)
def decision(figure: Figure) -> None:
    """Draw the speeds after the pause, and the plans for nine values of z."""
    speeds, *plans = figure.subplots(1, 3, width_ratios=(2.2, 1.0, 1.0))
    _speeds(speeds)
    for axes, beta in zip(plans, (lab.BETA, DEAD), strict=True):
        _plans(axes, beta)


def _speeds(axes: Axes) -> None:
    """Draw predicted and measured speeds of the entries, as a fraction."""
    some = paused()
    share = lab.started_share(lab.WAIT, lab.PAUSE_K)
    paper = {"squared": share, "absolute": 1.0 * (share > 0.5)}
    entries = np.arange(1, lab.PAUSE_K + 1)
    for name, colour in (("squared", BLUE), ("absolute", RED)):
        found = lab.speeds(some.data, some.nets[name], some.episodes)
        axes.plot(entries, paper[name], "--", color=colour, label=f"{name}, predicted")
        axes.plot(entries, found, "o-", color=colour, label=f"{name}, measured")
    axes.set(title=f"After a pause of {lab.WAIT} steps", xlabel="entry of the chunk")
    axes.set(ylabel="speed / full speed", ylim=(-0.05, 1.05))
    axes.set_xticks(range(1, lab.PAUSE_K + 1, 2))
    axes.legend(loc="lower right", fontsize=9)
    axes.grid()


def _plans(axes: Axes, beta: float) -> None:
    """Draw the plans for nine values of z from one start, seen from above."""
    model = latent(beta)
    seen = np.repeat(START, len(ZS), axis=0)
    steps = model.plan(seen, ZS[:, None]) * day15_mujoco.TICK
    for z, path in zip(ZS, np.cumsum(steps, axis=1), strict=True):
        colour = RED if z < 0 else BLUE if z > 0 else INK
        points = MM * np.vstack([START[:, :2], path])
        axes.plot(*points.T, "o-", color=colour, ms=3, linewidth=1)
    for centre, radius in ((START[0, :2], day15_mujoco.PUSHER),
                           (START[0, 2:], day15_mujoco.PUCK)):  # fmt: skip
        axes.add_patch(Circle(MM * centre, MM * radius, fill=False, color=INK))
    mu, logvar = model.encode()
    kl = lab.kl_to_prior(mu, logvar)[model.data.first].mean()
    axes.set(title=f"beta {beta:g}", xlabel=f"{kl:.2f} nats", aspect="equal")
    axes.set(xlim=(-90, 90), ylim=(-245, 35), xticks=(), yticks=())


def small() -> Image.Image:
    """Return the plans for nine values of z."""
    figure = Figure(figsize=(6.72, 5.04), dpi=100, facecolor="#1b1f24")
    axes = figure.add_axes((0, 0, 1, 1))
    seen = np.repeat(START, len(ZS), axis=0)
    steps = latent().plan(seen, ZS[:, None]) * day15_mujoco.TICK
    for z, path in zip(ZS, np.cumsum(steps, axis=1), strict=True):
        colour = "#f24236" if z < 0 else "#59bff2"
        axes.plot(*(MM * np.vstack([START[:, :2], path])).T, color=colour, linewidth=6)
    axes.add_patch(Circle(MM * START[0, 2:], 50, color="#ff991a"))
    axes.add_patch(Circle(MM * START[0, :2], 18, color="#40cc66"))
    axes.set(xlim=(-200, 200), ylim=(-240, 60), aspect="equal")
    axes.set_axis_off()
    return chart.image_of(figure)


FIGURES = {"decision": decision}
SMALL = (small, "45 of 100")  # of a table of days, and its number
