"""The picture of Day 11, made with the lab's own functions; drawn by `make figures`.

looks   the distance of pen and wire during one motion: samples that step over the dip,
        and the queries of the bound, each with the cone that contains the distance
strobe  the samples of a motion, and the contact between two of them
"""

import day11_distance as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart, sheet
from labkit.figures.chart import BLUE, GREY, INK, RED
from labkit.figures.scene import Camera
from robo47 import panda, shapes

import day11_mujoco

POINTS = 20  # inner samples of the check
FINE = 1200  # samples of the curve


@chart.picture(height=8.0)
def looks(figure: Figure) -> None:
    """Draw the distance during a motion, 20 samples, and the queries of the bound."""
    above, below = figure.subplots(2, 1, sharex=True)
    edge = missed_edge()
    s = np.linspace(0.0, 1.0, FINE)
    d = 1000 * lab.pen_from(edge, s)
    dots = np.linspace(0.0, 1.0, POINTS + 2)
    seen = 1000 * lab.pen_from(edge, dots)
    arm = shapes.Shape(panda.load("panda_nohand"), day11_mujoco.CAPSULES)
    reach = lab.distal_radii(*arm.lengths)
    free, looked = lab.walk(edge, reach)
    at = np.array(looked)
    far = 1000 * lab.pen_from(edge, at)
    speed = 1000 * float(np.abs(edge.dq) @ reach)
    for axes in (above, _close_up(above, s, d)):
        axes.plot(dots, seen, "o", color=RED, clip_on=True,
                  label=f"{POINTS} samples: all collision-free")  # fmt: skip
        _curve(axes, s, d)
    for axes in (below, _close_up(below, s, d)):
        for x, y in zip(at, far, strict=True):
            end = min(x + max(y, 0.0) / speed, 1.0)
            cone = [y, y - speed * (end - x)]
            axes.fill_between([x, end], cone, color=BLUE, alpha=0.2, linewidth=0)
        told = "collision-free" if free else "contact"
        axes.plot(at, far, "v", color=BLUE, label=f"bound: {len(at)} queries, {told}")
        _curve(axes, s, d)
    for axes in (above, below):
        axes.set(ylabel="distance, mm", ylim=(-40, 1.05 * d.max()), xlim=(-0.01, 1.01))
        axes.legend(loc="upper right")
    above.set(title="Pen and wire: samples, and conservative advancement")
    below.set(xlabel="s, fraction of the motion")


def _close_up(axes: Axes, s: np.ndarray, d: np.ndarray) -> Axes:
    """Return axes with an enlarged view of the contact."""
    inset = axes.inset_axes((0.4, 0.47, 0.28, 0.38))
    middle = s[np.argmin(d)]
    inset.set(xlim=(middle - 0.06, middle + 0.06), ylim=(-15, 60))
    inset.set_facecolor("white")
    return inset


def missed_edge() -> day11_mujoco.Edge:
    """Return a motion in which the samples miss the wire, in its middle part.

    The library finds the motion; the student's functions draw the picture.
    """
    dots = np.linspace(0.0, 1.0, POINTS + 2)
    for edge in day11_mujoco.whips(lab.WHIPS, lab.THIN, lab.SEED):
        far = day11_mujoco.far(edge, dots)
        if far.min() > 0.01 and 0.5 < dots[np.argmin(far)] < 0.75:
            return edge
    raise AssertionError("the lab's seed has no such way")


def _curve(axes: Axes, s: np.ndarray, d: np.ndarray) -> None:
    """Draw the distance itself and the line of contact."""
    axes.plot(s, d, "-", color=INK, linewidth=1.5, zorder=1)
    axes.axhline(0.0, color=GREY, linewidth=1.2)
    axes.grid()


def small() -> Image.Image:
    """Return the arm in contact with the wire that the samples miss."""
    edge = missed_edge()
    s = np.linspace(0.0, 1.0, FINE)
    q = edge.q + s[np.argmin(day11_mujoco.far(edge, s))] * edge.dq
    start, end, _ = edge.wire
    pen = cards.rod(*day11_mujoco.pen(q), cards.SKY, 0.012)
    wire = cards.rod(start, end, cards.RED, 0.012)
    camera = Camera((0.1, 0.3, 0.3), 2.0, np.radians(200.0), np.radians(-20.0))
    return cards.arm(q, camera, [pen, wire])


def strobe() -> Image.Image:
    """Return all samples of a motion that misses a wire, and its contact with it."""
    edge = missed_edge()
    s = np.linspace(0.0, 1.0, FINE)
    far = day11_mujoco.far(edge, s)
    touch = edge.q + s[np.argmin(far)] * edge.dq
    dots = np.linspace(0.0, 1.0, POINTS + 2)
    samples = edge.q + dots[:, None] * edge.dq
    nearest = samples[np.argmin(day11_mujoco.far(edge, dots))]
    start, end, _ = edge.wire
    wire = cards.rod(start, end, cards.RED, 0.004)
    pens = [cards.rod(*day11_mujoco.pen(q), cards.SKY, 0.005) for q in samples]
    at_contact = cards.rod(*day11_mujoco.pen(touch), cards.ORANGE, 0.006)
    whole = Camera((0.1, 0.2, 0.3), 2.9, np.radians(200.0), np.radians(-42.0))
    near = Camera(tuple(day11_mujoco.pen(touch)[1]), 0.75, np.radians(200.0), -0.5)
    least = 1000 * day11_mujoco.far(edge, dots).min()
    return sheet.side_by_side(
        (cards.bare(nearest, whole, [wire, *pens]), f"{POINTS} samples and both ends",
         f"the nearest one is {least:.0f} mm from the wire"),
        (cards.bare(touch, near, [wire, *pens, at_contact]), "Between two samples",
         f"the pen overlaps the wire by {-1000 * far.min():.0f} mm"),
    )  # fmt: skip


FIGURES = {"looks": looks, "strobe": strobe}
SMALL = (small, "39 of 60")  # the picture and the number in a table of days
