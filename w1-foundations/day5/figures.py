"""The picture of Day 5, made with the lab's own functions; drawn by `make figures`.

error_curves   an error of 0.1 rad decays under five controllers; dashed: predicted
"""

import day5_control as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart
from labkit.figures.chart import BLUE, GREEN, GREY, ORANGE, PURPLE
from robo47 import panda, references, simulate
from robo47.checks import Array

SECONDS, RATE = 1.0, 500.0  # at 500 Hz the curve is predicted to 1.2 % of e0
LIT = ("#adb5bd", PURPLE, ORANGE, "#2fd39a", chart.SKY)  # on a dark ground
LOOKS = ((GREY, "-"), (PURPLE, "-"), (ORANGE, "-"), (GREEN, "-."), (BLUE, "-"))


def curves() -> dict[str, Array]:
    """Return the largest |e| / e0 of any joint at every instant, per controller."""
    ready = lab.READY_Q
    model = lab.day5_mujoco.motors()
    start = ready - lab.E0
    goal = references.hold(ready)
    arm = panda.arm(model)
    servos = panda.load("panda_nohand")
    logs = {
        "servos": simulate.run(
            servos,
            simulate.start(servos, start),
            lambda t, q, qd: ready,
            SECONDS,
            rate=RATE,
        )
    }
    for name, law in {
        "PD": lab.springs,
        "PD and\ngravity": lab.springs_and_gravity,
        "gains\noutside M": lab.gains_outside,
        "computed\ntorque": lab.equal_springs(),
    }.items():
        logs[name] = lab.run(model, arm, law, goal, SECONDS, start, RATE)
    return {
        name: np.abs((ready - log.q) / lab.E0).max(axis=1) for name, log in logs.items()
    }


@chart.picture(height=7.2)
def error_curves(figure: Figure) -> None:
    """Draw the five errors on one log axis, and the predicted curve dashed."""
    t = np.arange(round(SECONDS * RATE) + 1) / RATE
    axes = figure.subplots()
    for (name, e), (colour, style) in zip(curves().items(), LOOKS, strict=True):
        axes.plot(t, e, style, color=colour)
        axes.text(1.01 * SECONDS, e[-1], name, color=colour, va="center",
                  fontsize=chart.SMALL)  # fmt: skip
    axes.plot(t, lab.error_response(t, lab.OMEGA, 1.0), "k--", lw=1.5)
    axes.text(0.04, 2e-4, "predicted, dashed:\n" r"$(1 + \omega t)\ e^{-\omega t}$")
    axes.set(yscale="log", xlim=(0.0, SECONDS), ylim=(1e-7, 4.0))
    axes.set(xlabel="time, s", ylabel="largest |e| / e0 of the seven joints")
    axes.grid()


def small() -> Image.Image:
    """Return the five errors over time, without words."""

    def draw(axes: Axes) -> None:
        for e, colour in zip(curves().values(), LIT, strict=True):
            axes.semilogy(e[::5], color=colour)
        axes.set(ylim=(1e-5, 2.0))

    return cards.curves(draw)


FIGURES = {"error_curves": error_curves}
SMALL = (small, "")  # of a table of days, and its number
