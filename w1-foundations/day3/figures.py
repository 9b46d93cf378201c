"""The pictures of Day 3, made with the lab's own functions; drawn by `make figures`.

singularity   step 5: singular values, joint speeds and misses along the circle
ellipses      step 3: how fast the hand of a planar arm can be, how hard it can push
"""

import numpy as np
from day3_jacobian_ik import (
    DAMPING,
    DT,
    RADIUS,
    SPEED,
    draw_circle,
    site_jacobian,
    space_jacobian,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart
from labkit.figures.chart import BLUE, GREY, INK, ORANGE, RED, RULE
from labkit.figures.scene import Camera
from robo47 import panda, screws, verify
from robo47.checks import Array

import day3_mujoco

LINK = 1.0  # metres, of both
DRAWN = 0.42  # metres of the picture for 1 m/s, or for 1 N
BENT = np.radians([50.0, -100.0])  # joint angles of the two pictures
STRETCHED = np.radians([16.0, -32.0])


@chart.picture(height=9.0)
def singularity(figure: Figure) -> None:
    """Draw singular values, joint speeds in parts of their limits, and misses."""
    model = panda.load("panda_nohand")
    arm = (panda.screws(model), panda.home_pose(model))
    limits = model.jnt_range
    circle, q = day3_mujoco.circle(
        arm, limits, RADIUS, np.arange(0.0, day3_mujoco.LAP, DT)
    )
    _, plain, _ = draw_circle(arm, circle, q, 0.0)
    off, damped, path = draw_circle(arm, circle, q, DAMPING)
    least = day3_mujoco.least_miss(arm, limits, circle[:-1], q)
    sigma = np.linalg.svd(verify.each(lambda x: _J_site(arm, x), path))[1]
    time = DT * np.arange(len(damped))
    above, below, last = figure.subplots(3, 1, sharex=True)
    for panel in (above, below, last):
        panel.axvspan(*time[least > 1e-3][[0, -1]], color=RULE)
    above.semilogy(time, sigma[:, :-1], color=GREY, lw=1.2, ls="-")
    above.semilogy(time, sigma[:, -1], color=RED, label="the smallest")
    above.set_ylabel("singular values")
    above.legend(loc="lower center")
    above.set_title(f"A circle of {RADIUS} m; grey: out of reach", loc="left")
    words = f"damping {DAMPING:g}"
    below.semilogy(time, (plain / SPEED).max(axis=1), color=ORANGE, ls=":",
                   label="plain pseudo-inverse")  # fmt: skip
    below.semilogy(time, (damped / SPEED).max(axis=1), color=BLUE, label=words)
    below.axhline(1.0, color=INK, lw=1.0, ls="--")
    below.set_ylabel("joint speed / limit")
    below.legend(loc="upper right")
    last.plot(time, off, color=BLUE, label=words)
    last.plot(time, least, color=INK, ls="--", label="smallest possible")
    last.set(ylabel="position error, mm", xlabel="time along the circle, s")
    last.legend(loc="upper center")


@chart.picture(height=7.6)
def ellipses(figure: Figure) -> None:
    """Draw the velocities of joint speeds of length 1, the forces of torques of 1."""
    poses = {"bent": BENT, "nearly stretched": STRETCHED}
    for axes, (name, q) in zip(figure.subplots(2, 1), poses.items(), strict=True):
        J = planar(q)
        elbow = LINK * np.array([np.cos(q[0]), np.sin(q[0])])
        hand = elbow + LINK * np.array([np.cos(q.sum()), np.sin(q.sum())])
        axes.plot(*np.array([[0, 0], elbow, hand]).T, "o-", color=INK, lw=5, ms=10)
        _ellipse(axes, hand, DRAWN * J, BLUE, "-")
        _ellipse(axes, hand, DRAWN * np.linalg.inv(J.T), RED, "--")
        fast, slow = np.linalg.svd(J)[1]
        axes.text(-0.2, 1.15, name)
        says = f"velocity for 1 rad/s:\n{slow:.2f} to {fast:.2f} m/s"
        axes.text(2.7, 0.85, says, color=BLUE, fontsize=chart.SMALL, va="center")
        says = f"force for 1 N m:\n{1 / fast:.2f} to {1 / slow:.2f} N"
        axes.text(2.7, -0.75, says, color=RED, fontsize=chart.SMALL, va="center")
        axes.set(xlim=(-0.3, 4.4), ylim=(-1.1, 1.45))
        chart.blank(axes)


def planar(q: Array) -> Array:
    """Return J of two links in the plane, (2, 2): rows v_x and v_y of their end."""
    S = np.array([[0, 0, 1, 0, 0, 0], [0, 0, 1, 0, -LINK, 0]], dtype=float)
    M = np.eye(4)
    M[0, 3] = 2 * LINK
    return _J_site((S, M), q)[3:5]


def _J_site(arm: tuple, q: Array) -> Array:
    p = screws.fk_space(*arm, q)[:3, 3]
    return site_jacobian(space_jacobian(arm[0], q), p)


def _ellipse(axes: Axes, at: Array, A: Array, colour: str, style: str) -> None:
    """Draw what A makes of the vectors of length 1, around a point."""
    phi = np.linspace(0.0, 2 * np.pi, 200)
    x, y = at[:, None] + A @ np.array([np.cos(phi), np.sin(phi)])
    axes.plot(x, y, style, color=colour)


def small() -> Image.Image:
    """Return the arm on the circle, red where even the best joint angles miss it."""
    model = panda.load("panda_nohand")
    arm = (panda.screws(model), panda.home_pose(model))
    times = np.arange(0.0, day3_mujoco.LAP, DT)
    circle, q = day3_mujoco.circle(arm, model.jnt_range, RADIUS, times)
    least = day3_mujoco.least_miss(arm, model.jnt_range, circle, q)
    _, _, path = draw_circle(arm, circle, q, DAMPING)
    rods = [
        cards.rod(circle[i, :3, 3], circle[i + 5, :3, 3], colour, 0.014)
        for i in range(0, len(circle) - 5, 5)
        for colour in [cards.RED if least[i] > 1e-3 else cards.SKY]
    ]
    rods.append(cards.rod(circle[-5, :3, 3], circle[0, :3, 3], cards.SKY, 0.014))
    at = path[np.argmax(least) - 40]
    return cards.arm(at, Camera((0.2, 0, 0.52), 2.5, np.radians(150.0)), rods)


FIGURES = {"singularity": singularity, "ellipses": ellipses}
SMALL = (small, "")  # of a table of days, and its number
