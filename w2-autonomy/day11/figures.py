"""The picture of Day 11, made with the lab's own functions; drawn by `make figures`.

looks   the distance of pen and wire on one way: points that stride over the dip, and
        the looks of the bound, each with the cone that the distance cannot leave
"""

import day11_distance as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart
from labkit.figures.chart import BLUE, GREY, INK, RED
from labkit.figures.scene import Camera
from robo47 import panda, shapes

import day11_mujoco

POINTS = 20  # that the check of dots looks at
FINE = 1200  # places that the curve is drawn from


@chart.picture(height=8.0)
def looks(figure: Figure) -> None:
    """Draw the distance over a way, what 20 points see, and where the bound looks."""
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
                  label=f"{POINTS} points: all free")  # fmt: skip
        _curve(axes, s, d)
    for axes in (below, _close_up(below, s, d)):
        for x, y in zip(at, far, strict=True):
            end = min(x + max(y, 0.0) / speed, 1.0)
            cone = [y, y - speed * (end - x)]
            axes.fill_between([x, end], cone, color=BLUE, alpha=0.2, linewidth=0)
        told = "free" if free else "it touches"
        axes.plot(at, far, "v", color=BLUE, label=f"the bound: {len(at)} looks, {told}")
        _curve(axes, s, d)
    for axes in (above, below):
        axes.set(ylabel="distance, mm", ylim=(-40, 1.05 * d.max()), xlim=(-0.01, 1.01))
        axes.legend(loc="upper right")
    above.set(title="Pen and wire: looked at by points, and by promises")
    below.set(xlabel="s, share of the way")


def _close_up(axes: Axes, s: np.ndarray, d: np.ndarray) -> Axes:
    """Return axes that show where it touches, larger."""
    inset = axes.inset_axes((0.4, 0.47, 0.28, 0.38))
    middle = s[np.argmin(d)]
    inset.set(xlim=(middle - 0.06, middle + 0.06), ylim=(-15, 60))
    inset.set_facecolor("white")
    return inset


def missed_edge() -> day11_mujoco.Edge:
    """Return a way of the lab's on which the points miss the wire, in its middle part.

    Which are missed is a matter of places, found by the library; the picture is the
    student's.
    """
    dots = np.linspace(0.0, 1.0, POINTS + 2)
    for edge in day11_mujoco.whips(lab.WHIPS, lab.THIN, lab.SEED):
        far = day11_mujoco.far(edge, dots)
        if far.min() > 0.01 and 0.5 < dots[np.argmin(far)] < 0.75:
            return edge
    raise AssertionError("the lab's seed has no such way")


def _curve(axes: Axes, s: np.ndarray, d: np.ndarray) -> None:
    """Draw the distance itself, and where it touches."""
    axes.plot(s, d, "-", color=INK, linewidth=1.5, zorder=1)
    axes.axhline(0.0, color=GREY, linewidth=1.2)
    axes.grid()


def small() -> Image.Image:
    """Return the arm on a way on which the points miss the wire, as it touches it."""
    edge = missed_edge()
    s = np.linspace(0.0, 1.0, FINE)
    q = edge.q + s[np.argmin(day11_mujoco.far(edge, s))] * edge.dq
    start, end, _ = edge.wire
    pen = cards.rod(*day11_mujoco.pen(q), cards.SKY, 0.012)
    wire = cards.rod(start, end, cards.RED, 0.012)
    camera = Camera((0.1, 0.3, 0.3), 2.0, np.radians(200.0), np.radians(-20.0))
    return cards.arm(q, camera, [pen, wire])


FIGURES = {"looks": looks}
SMALL = (small, "39 of 60")  # of a table of days, and its number
