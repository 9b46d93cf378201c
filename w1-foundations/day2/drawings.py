"""Drawings of Day 2's ideas: a screw with its pitch, and where DH frames sit."""

import numpy as np
from day2_screws import exp_screw
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from labkit.figures import chart
from labkit.figures.chart import BLUE, GREEN, GREY, INK, RED
from robo47.checks import Array

PITCH = 0.25  # metres per radian, of the drawn screw
AXIS = np.array([0.0, 0.5, np.sqrt(0.75)])  # of length 1
POINT = np.array([0.0, 1.9, 0.0])  # on the axis
SEEN = np.array([[-0.62, 1.0, 0.0], [-0.5, 0.0, 1.0]])  # x comes out of the paper
LEAN = np.array([0.42, 0.91])  # of the second joint axis: into the paper, by alpha
CRAIG = r"$\alpha_{i-1},\ a_{i-1},\ d_i,\ \theta_i$"
STANDARD = r"$\theta_i,\ d_i,\ a_i,\ \alpha_i$"


@chart.picture(height=6.0)
def pitch(figure: Figure) -> None:
    """Draw a point on its way along a screw, and what the screw's two halves are."""
    axes = figure.subplots()
    v = -np.cross(AXIS, POINT) + PITCH * AXIS
    S = np.append(AXIS, v)
    start = np.append(POINT - 0.9 * AXIS, 1.0)
    start[0] += 0.6  # beside the axis

    def at(turns: float) -> Array:
        return (exp_screw(S, 2 * np.pi * turns) @ start)[:3]

    _line(axes, [POINT - AXIS, POINT + 3.3 * AXIS], GREY, "--", 1.5)
    _line(axes, np.array([at(x) for x in np.linspace(0.0, 2.2, 300)]), BLUE)
    low, high = (SEEN @ at(turns) for turns in (1.0, 2.0))
    axes.plot(*np.array([low, high]).T, "o", color=BLUE)
    chart.arrow(axes, low, high, INK, 1.5)
    axes.text(*((low + high) / 2 + [-0.15, 0.2]), "one turn:\n$2\\pi h$", ha="right")
    _arrow(axes, POINT, POINT + AXIS, RED, r"$\omega$", [0.3, 0.4])
    _arrow(axes, np.zeros(3), POINT, INK, r"$p$", [-0.1, 0.12])
    says = r"$v = -\omega \times p + h\,\omega$"
    _arrow(axes, np.zeros(3), v, GREEN, says, [0.1, -0.45])
    axes.plot(0, 0, "o", color=INK)
    axes.text(-0.15, 0.1, "origin", ha="right")
    axes.set(xlim=(-1.4, 4.4), ylim=(-1.2, 3.1))
    chart.blank(axes)


@chart.picture(height=8.0)
def dh_conventions(figure: Figure) -> None:
    """Draw one link with its two joint axes, and its frame where two books put it."""
    panels = zip(
        figure.subplots(2, 1),
        ("Craig, Franka: frame i on the axis that moves link i",
         "standard: frame i at the far end of link i"),
        (CRAIG, STANDARD), (0.0, 3.2), (np.array([0.0, 1.0]), LEAN),
        strict=True,
    )  # fmt: skip
    for axes, title, numbers, at, up in panels:
        ends = (
            (0.0, np.array([0.0, 1.0]), "axis i"),
            (3.2, LEAN, "axis i + 1 leans\nback by $\\alpha_i$"),
        )
        for x, along, name in ends:
            _flat(axes, [[x, 0] - 0.9 * along, [x, 0] + 1.9 * along], GREY, "--", 1.5)
            axes.text(*([x + 0.15, 0] + 1.6 * along), name, color=GREY, va="top")
        _flat(axes, [[0, 0], [3.2, 0]], INK, "-", 7)
        axes.text(1.6, -0.42, "link i", ha="center")
        chart.arrow(axes, (at, 0), [at, 0] + 1.2 * up, BLUE, 3.5)
        chart.arrow(axes, (at, 0), (at + 1.2, 0), RED, 3.5)
        axes.text(*([at - 0.15, 0] + 1.1 * up), "$z_i$", color=BLUE, ha="right")
        axes.text(at + 1.2, 0.15, "$x_i$", color=RED, ha="center")
        axes.plot(at, 0, "o", color=INK, ms=11)
        axes.text(-0.9, 2.35, title)
        axes.text(-0.9, -1.15, f"in this order: {numbers}", fontsize=chart.SMALL)
        axes.set(xlim=(-1.0, 6.2), ylim=(-1.35, 2.8))
        chart.blank(axes)


def _line(axes: Axes, points: Array, colour: str, style: str = "-", width: float = 2.5):
    _flat(axes, np.asarray(points) @ SEEN.T, colour, style, width)


def _flat(axes: Axes, points: Array, colour: str, style: str, width: float) -> None:
    axes.plot(*np.transpose(points), style, color=colour, lw=width)


def _arrow(
    axes: Axes, start: Array, tip: Array, colour: str, name: str, off: list
) -> None:
    """Draw an arrow in space, and its name beside its middle."""
    chart.arrow(axes, SEEN @ start, SEEN @ tip, colour)
    axes.text(*(SEEN @ (start + tip) / 2 + off), name, color=colour)
