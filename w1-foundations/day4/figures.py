"""The pictures of Day 4, made with the lab's own functions; drawn by `make figures`.

momentum  linear and angular momentum of a body: the blocks m [c] of its inertia
torques   torques of each motor at three poses: gravity, Coriolis, inertia
float     distance of the hand: let go, on 99 % of gravity, on all of it, and pushed
"""

import numpy as np
from day4_dynamics import (
    PUSH,
    READY_Q,
    bias_torque,
    gravity_torque,
    let_go,
    link_inertias,
    mass_matrix,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart
from labkit.figures.chart import BLUE, GREEN, INK, ORANGE, RED, RULE
from labkit.figures.scene import Camera
from robo47 import panda, simulate
from robo47.checks import Array

GLIDES = 0.7  # s after the push, of the small picture
SPEED, ACCELERATION = 1.5, 5.0  # rad/s and rad/s^2, of every joint at once
POSES = {
    "ready": READY_Q,
    "stretched out to the front": np.array([0, 1.4, 0, -0.4, 0, 1.7, 0.785]),
    "folded up": np.array([0, -0.6, 0, -2.9, 0, 2.4, 0.785]),
}


@chart.picture(height=3.9)
def momentum(figure: Figure) -> None:
    """Draw a body with its centre, its momentum there, and both about the origin."""
    axes = figure.subplots()
    c = np.array([3.2, 1.3])
    p = np.array([-0.55, 1.9])
    phi = np.linspace(0.0, 2 * np.pi, 100)
    body = c[:, None] + [[1.15, -0.25], [0.35, 0.6]] @ np.array(
        [np.cos(phi), np.sin(phi)]
    )
    axes.fill(*body, facecolor=RULE, edgecolor=INK, lw=2)
    chart.arrow(axes, (0, 0), c, INK)
    chart.arrow(axes, c, c + p, BLUE, 3.5)
    turn = np.linspace(-0.6, 3.4, 60)
    x, y = 0.5 * np.cos(turn), 0.5 * np.sin(turn)
    axes.plot(x, y, color=ORANGE, lw=3)
    chart.arrow(axes, (x[-6], y[-6]), (x[-1], y[-1]), ORANGE, 3.0)
    axes.plot(*np.array([(0, 0), c, c + p]).T, "o", color=INK, markevery=[0, 1])
    axes.text(0.75, -0.35, "origin")
    axes.text(-0.75, 0.55, r"$(\omega; v)$", color=ORANGE, ha="right")
    axes.text(1.5, 0.3, "$c$")
    axes.text(2.45, 3.15, r"$p = m (v + \omega \times c)$", color=BLUE, ha="right")
    axes.text(4.7, 1.2, "angular, about the origin:", fontsize=chart.SMALL)
    axes.text(4.7, 0.65, r"$I \omega + c \times p$", color=BLUE)
    axes.set(xlim=(-2.2, 8.3), ylim=(-0.8, 3.6))
    chart.blank(axes)


@chart.picture(height=9.0)
def torques(figure: Figure) -> None:
    """Draw bars of the three torques per joint, a row for each pose."""
    rows = figure.subplots(len(POSES), 1, sharex=True, sharey=True)
    for axes, (name, q) in zip(rows, POSES.items(), strict=True):
        _bars(axes, name, q)
    figure.legend(*rows[0].get_legend_handles_labels(), loc="outside upper left")
    rows[1].set_ylabel("fraction of the motor's limit, %")


@chart.picture(height=6.6)
def float_and_push(figure: Figure) -> None:
    """Draw how far the hand is from where it was, over time, on a log axis."""
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    calm = 0 * PUSH
    runs = {
        "let go, to a joint limit": (RED, "-", (0.0, (0.5, calm))),
        "99 % of gravity_torque": (ORANGE, "-.", (0.99, (2.0, calm))),
        "all of it, pushed for 0.5 s": (BLUE, "--", (1.0, (0.5, PUSH), (4.5, calm))),
        "all of it": (GREEN, "-", (1.0, (5.0, calm))),
    }
    axes = figure.subplots()
    for name, (colour, style, given) in runs.items():
        away = np.linalg.norm(let_go(model, arm, *given), axis=1)[1:]
        t = np.linspace(0.0, sum(s for s, _ in given[1:]), len(away) + 1)[1:]
        axes.semilogy(t, np.maximum(away, 1e-17), style, color=colour)
        x, up = (2.05, 0.02) if "%" in name else (t[-1], 2.5)
        side = "left" if t[-1] < 5 else "right"
        words = {"ha": side, "va": "bottom", "fontsize": chart.SMALL}
        axes.text(x, up * away[-1], name, color=colour, **words)
    axes.axhline(1e-6, color=INK, ls="--", lw=1.5)
    axes.text(4.98, 1.6e-6, "limit of float_5s", ha="right", fontsize=chart.SMALL)
    axes.axhline(1e-10, color=RULE, zorder=0)
    axes.text(4.98, 1.6e-10, "size of an atom", ha="right", fontsize=chart.SMALL)
    axes.set(
        xlabel="time, s",
        ylabel="distance of the hand from its start, m",
        ylim=(3e-18, 30),
    )


def _parts(q: Array) -> dict[str, tuple[str, Array]]:
    """Return gravity's, Coriolis' and the acceleration's torque, N m, (7,) each."""
    model = panda.load("panda_nohand")
    arm = panda.arm(model)
    qd = np.full(7, SPEED)
    now = arm.at(q)
    G = link_inertias(now.T_links, *panda.inertias(model))
    g = gravity_torque(now.J_space, arm.masses, now.coms_world, arm.gravity)
    c = bias_torque(now.J_space, G, qd, arm.gravity) - g
    M = mass_matrix(now.J_space, G, arm.armature)
    return {
        "gravity": (BLUE, g),
        f"Coriolis, every joint at {SPEED} rad/s": (RED, c),
        f"inertia, every joint at {ACCELERATION:g} rad/s²": (
            GREEN,
            M @ np.full(7, ACCELERATION),
        ),
    }


def _bars(axes: Axes, name: str, q: Array) -> None:
    limits = simulate.limits(panda.load("panda_nohand"))[1]
    joints = np.arange(1, 8)
    for k, (label, (colour, tau)) in enumerate(_parts(q).items()):
        x = joints + 0.27 * (k - 1)
        share = 100 * tau / limits
        hatch = ("", "//", "..")[k]
        axes.bar(x, share, 0.25, color=colour, label=label, hatch=hatch, ec="white")
    axes.axhline(0, color=INK, lw=1)
    axes.set_title(name, loc="left")
    axes.set(ylim=(-70, 40), yticks=[-50, -25, 0, 25], xlim=(0.5, 7.5))
    words = [f"{i}\n±{limit:.0f}" for i, limit in enumerate(limits, 1)]
    axes.set_xticks(joints, words)
    axes.set_xlabel(
        "joint, and its motor's limit, N m"
        if axes.get_subplotspec().is_last_row()
        else ""
    )
    axes.tick_params(length=0)


def small() -> Image.Image:
    """Return the arm held by your torques, and where it has glided after a push."""
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)

    def hold(t: float, q: Array, qd: Array) -> Array:
        now = arm.at(q)
        return gravity_torque(now.J_space, arm.masses, now.coms_world, arm.gravity)

    data = simulate.start(model, READY_Q)
    push = simulate.push_at("attachment_site", np.append(np.zeros(3), PUSH))
    simulate.run(model, data, hold, 0.5, push=push)
    q = simulate.run(model, data, hold, GLIDES).q[-1]
    camera = Camera((0.1, 0.0, 0.45), 2.1, np.radians(150.0))
    return cards.arm(READY_Q, camera, ghosts=cards.elsewhere(READY_Q, q))


FIGURES = {"momentum": momentum, "torques": torques, "float": float_and_push}
SMALL = (small, "")  # of a table of days, and its number
