"""The picture of Day 13, made with the lab's own functions; drawn by `make figures`.

best    measured over predicted cost against the distance of the start; the circle
"""

import day13_optimal as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart
from labkit.figures.chart import BLUE, GREEN, GREY, INK, ORANGE, RED
from robo47 import panda
from robo47.jacobian import dls_step

import day13_mujoco

SIZES = np.array([0.01, 0.03, 0.1, 0.2, 0.3])  # rad


@chart.picture(height=9.0)
def best(figure: Figure) -> None:
    """Draw measured over predicted cost, and the circle's error over a lap."""
    model = day13_mujoco.arm()
    above, below = figure.subplots(2, 1)
    _promise(above, model)
    _circle(below, model)


def _promise(axes: Axes, model) -> None:
    """Draw the ratio for two opposite starts, their mean, and two other gains."""
    h = model.opt.timestep
    slope, A, B = lab.at_rest(model, lab.READY_Q, h)
    P, K = lab.promise(A, B, h)
    M = panda.arm(model).at(lab.READY_Q).M
    none = lab.promise(*lab.linearise(M, 0 * slope, model.dof_damping, h), h)
    both = np.array([lab.kept(model, P, K, size) for size in SIZES])
    others = {
        "K without gravity stiffness": (none, RED, "s--"),
        "K / 2": ((P, K / 2), ORANGE, "^--"),
    }
    mrad = 1000 * SIZES
    axes.axhline(1.0, color=INK, linewidth=1.2)
    axes.semilogx(mrad, both[:, 0], "v-", color=GREY, label="K, stretched")
    axes.semilogx(mrad, both[:, 1], "^-", color=GREY, label="K, folded")
    axes.semilogx(mrad, both.mean(axis=1), "o-", color=BLUE, label="K, mean of both")
    for name, (gain, colour, mark) in others.items():
        mean = [lab.kept(model, *gain, size).mean() for size in SIZES]
        axes.semilogx(mrad, mean, mark, color=colour, label=name)
    axes.set(xlabel="distance of the start from ready, mrad", ylim=(0.85, 1.55))
    axes.set_ylabel("measured / predicted cost")
    axes.set_xticks([10, 30, 100, 300], ["10", "30", "100", "300"])
    axes.minorticks_off()
    axes.set_title("All gains hold the arm; one predicts its cost")
    axes.legend(loc="upper left", ncols=2)
    axes.grid()


def _circle(axes: Axes, model) -> None:
    """Draw the hand's error on the circle, with clamped steps and with `qp_ik`."""

    def clipped(J, e, lo, hi):
        return np.clip(dls_step(J, e, lab.DAMPING), lo, hi)

    ways = {
        "Day 3's step, clamped": (clipped, RED, "--"),
        "qp_ik": (lab.best_step(), BLUE, "-"),
        "qp_ik, orientation weight 0.01": (lab.best_step(0.01), GREEN, "-."),
    }
    for name, (step, colour, line) in ways.items():
        off, _, _ = lab.draw_circle(model, step)
        axes.plot(lab.DT * np.arange(len(off)), off, line, color=colour, label=name)
    axes.set(xlabel="time along the circle, s", xlim=(0.5, 3.0))
    axes.set_ylabel("position error, mm")
    axes.set_title(f"A circle of {lab.RADIUS} m, all joints within their limits")
    axes.legend(loc="upper right")
    axes.grid()


def small() -> Image.Image:
    """Return how far the hand is off the circle, clipped and best, without words."""
    model = day13_mujoco.arm()

    def clipped(J, e, lo, hi):
        return np.clip(dls_step(J, e, lab.DAMPING), lo, hi)

    def draw(axes: Axes) -> None:
        for step, colour in ((clipped, "#ff6b5e"), (lab.best_step(), chart.SKY)):
            off, _, _ = lab.draw_circle(model, step)
            axes.plot(lab.DT * np.arange(len(off)), off, color=colour)
        axes.set(xlim=(0.8, 2.8))

    return cards.curves(draw)


FIGURES = {"best": best}
SMALL = (small, "")  # of a table of days, and its number
