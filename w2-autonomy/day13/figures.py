"""The picture of Day 13, made with the lab's own functions; drawn by `make figures`.

best    measured over predicted cost against the distance of the start; the circle
circles  the circle in space, drawn with three methods
"""

import day13_optimal as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart, sheet
from labkit.figures.chart import BLUE, GREEN, GREY, INK, ORANGE, RED
from labkit.figures.scene import Camera
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

    ways = {
        "Day 3's step, clamped": (clamped, RED, "--"),
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


def clamped(J, e, lo, hi):
    """Return Day 3's damped least-squares step, clamped to its limits."""
    return np.clip(dls_step(J, e, lab.DAMPING), lo, hi)


def drawn(model, step) -> tuple[np.ndarray, np.ndarray, float]:
    """Return a circle's angles, the points of the hand and its largest error, mm."""
    steps = [day13_mujoco.circle(model, lab.RADIUS, np.zeros(1))[1]]

    def kept(*given):
        steps.append(step(*given))
        return steps[-1]

    off, _, _ = lab.draw_circle(model, kept)
    q = np.cumsum(steps, axis=0)
    arm = panda.arm(model)
    return q, np.array([arm.at(one).T_world_ee[:3, 3] for one in q]), off.max()


def circles() -> Image.Image:
    """Return the upper part of the circle that each of three methods draws."""
    model = day13_mujoco.arm()
    times = np.arange(0.0, day13_mujoco.LAP, lab.DT)
    wanted = day13_mujoco.circle(model, lab.RADIUS, times)[0][:, :3, 3]
    camera = Camera((0.35, 0.06, 0.78), 1.25, np.radians(195.0), np.radians(-14.0))
    panels = []
    for name, step, colour in (
        ("Day 3's step, clamped", clamped, cards.RED),
        ("qp_ik", lab.best_step(), cards.SKY),
        ("qp_ik, orientation weight 0.01", lab.best_step(0.01), cards.GREEN),
    ):
        q, points, worst = drawn(model, step)
        far = np.linalg.norm(points[: len(wanted)] - wanted, axis=1).argmax()
        grey = (0.6, 0.63, 0.66, 1.0)
        boxes = cards.line(wanted[::3], grey, 0.004)
        boxes += cards.line(points[: len(wanted) : 2], colour, 0.007)
        boxes.append(cards.rod(wanted[far], points[far], cards.ORANGE, 0.009))
        told = f"largest error {worst:.0f} mm"
        panels.append((cards.bare(q[0], camera, boxes), name, told))
    return sheet.side_by_side(*panels)


def small() -> Image.Image:
    """Return how far the hand is off the circle, clipped and best, without words."""
    model = day13_mujoco.arm()

    def draw(axes: Axes) -> None:
        for step, colour in ((clamped, "#ff6b5e"), (lab.best_step(), chart.SKY)):
            off, _, _ = lab.draw_circle(model, step)
            axes.plot(lab.DT * np.arange(len(off)), off, color=colour)
        axes.set(xlim=(0.8, 2.8))

    return cards.curves(draw)


FIGURES = {"best": best, "circles": circles}
SMALL = (small, "")  # of a table of days, and its number
