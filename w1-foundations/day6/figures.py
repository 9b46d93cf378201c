"""The pictures of Day 6, made with the lab's own functions; drawn by `make figures`.

push    displacement of a soft hand for eleven forces, on the predicted line
press   the force on the table over time: the soft arm, and the stiff one with and
        without the limits of its motors
loop    the impedance loop as a block diagram
cone    the friction cone of a tip on a table
"""

import day6_task_space as lab
import mujoco
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from PIL import Image

from labkit.figures import cards, chart
from labkit.figures.chart import BLUE, GREEN, INK, ORANGE, RED, RULE
from labkit.figures.scene import Box
from robo47 import panda, scenes, se3, simulate

STEP = 0.002  # s, of the simulator
FORCES = np.linspace(-20.0, 20.0, 11)  # N, along x
STIFFNESSES = (400.0, 1000.0)  # N/m
HAND = 0.1  # m that the pictures' arm, which has a hand, is longer
MU = 0.6  # sliding friction of the drawn cone


def moved(force: float, k: float) -> float:
    """Return how far the hand moves along x under a force along x, in metres."""
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    start = simulate.start(model, lab.READY_Q)
    stiffness = np.append(lab.K[:3], np.full(3, k))
    push = simulate.push_at(lab.day6_mujoco.SITE, [0.0, 0.0, 0.0, force, 0.0, 0.0])
    law = lab.soft_hand(arm, lab.READY_Q, stiffness=stiffness)
    run = simulate.run(model, start, law, 3.0, rate=lab.RATE, push=push)
    ends = [arm.at(q).T_world_ee[0, 3] for q in run.q[[0, -1]]]
    return ends[1] - ends[0]


def presses() -> tuple[np.ndarray, ...]:
    """Return the force on the table over three seconds: soft, stiff, without limits."""
    start = scenes.TOUCH + 0.01
    depth = lab.set_point_for_force(lab.PRESS, lab.K[5], scenes.TOUCH)
    sink = lambda t: max(depth, start - lab.SINK * t)  # noqa: E731
    soft = lab.day6_mujoco.press(
        lambda arm, q: lab.soft_hand(arm, q, sink), seconds=3.0, rate=lab.RATE
    )
    servos = {"drive": "servo", "seconds": 3.0}
    stiff = lab.day6_mujoco.press(lab.stiff_arm, **servos)
    return (
        soft,
        stiff,
        lab.day6_mujoco.press(lab.stiff_arm, change=_no_limits, **servos),
    )


def _no_limits(model: mujoco.MjModel) -> None:
    model.actuator_forcelimited[:] = 0


@chart.picture(height=6.0)
def push(figure: Figure) -> None:
    """Draw displacement against force, measured, over the line F / k."""
    axes = figure.subplots()
    looks = zip(STIFFNESSES, (BLUE, RED), ("o", "s"), strict=True)
    for k, colour, mark in looks:
        axes.plot(FORCES, 1000 * FORCES / k, color=colour, lw=1.5)
        off = [1000 * moved(force, k) for force in FORCES]
        axes.plot(FORCES, off, mark, color=colour)
        x = 13.0 if k > STIFFNESSES[0] else 4.0
        y = 1000 * x / k
        right = "left" if x > 5.0 else "right"
        axes.text(x, y + (5 if x < 5 else -8), f"{k:.0f} N/m", color=colour, ha=right)
    axes.text(-19, 36, "lines: F / k, predicted\nmarks: the hand at rest,\nmeasured",
              fontsize=chart.SMALL, va="center")  # fmt: skip
    axes.set(xlabel="force along x, N", ylabel="displacement along x, mm")
    axes.grid()


@chart.picture(height=6.4)
def press(figure: Figure) -> None:
    """Draw the contact force over time, soft, stiff, and stiff without limits."""
    axes = figure.subplots()
    names = "soft, 400 N/m", "servos, at their limits", "servos without limits"
    looks = zip(presses(), names, (BLUE, RED, INK), ("-", "--", "-."), strict=True)
    for felt, name, colour, style in looks:
        axes.plot(np.arange(1, len(felt) + 1) * STEP, felt, style, color=colour)
        words = f"{name}: {felt[-1]:.0f} N, peak {felt.max():.0f} N"
        above = felt[round(0.75 / STEP)] + 14
        axes.text(0.75, above, words, color=colour, fontsize=chart.SMALL)
    axes.axhline(lab.PRESS, color=INK, ls=":", lw=1.5)
    axes.text(3.0, lab.PRESS - 32, "20 N: wanted and predicted", ha="right",
              fontsize=chart.SMALL)  # fmt: skip
    axes.set(xlabel="time, s", ylabel="force on the table, N")
    axes.set_title("Commanded 50 mm into a table", loc="left")
    axes.grid()


BOXES = {  # what stands in each, its middle, and its colour
    "target\nminus hand": ((1.0, 5.0), INK),
    "spring\n$K e$": ((3.4, 5.6), BLUE),
    "damper\n$D \\dot e$": ((3.4, 4.2), BLUE),
    "$J^T F$": ((5.7, 5.0), BLUE),
    "bias,\nfriction": ((3.4, 2.6), GREEN),
    "null-space\ntorque": ((3.4, 1.1), ORANGE),
    "arm": ((7.6, 3.0), INK),
}
WIDE, HIGH = 0.8, 0.5  # halves of a box


@chart.picture(height=5.4)
def loop(figure: Figure) -> None:
    """Draw the loop of a soft hand: what is computed of what, and what comes back."""
    axes = figure.subplots()
    for words, ((x, y), colour) in BOXES.items():
        _box(axes, x, y, words, colour)
    to = 6.35, 3.0  # where the torques are added
    axes.add_patch(Circle(to, 0.22, facecolor="white", edgecolor=INK, lw=2.0, zorder=2))
    axes.text(*to, "+", ha="center", va="center")
    for points in (
        [(1.8, 5.0), (2.15, 5.0), (2.15, 5.6), (2.6, 5.6)],
        [(2.15, 5.0), (2.15, 4.2), (2.6, 4.2)],
        [(4.2, 5.6), (4.55, 5.6), (4.55, 5.0), (4.9, 5.0)],
        [(4.2, 4.2), (4.55, 4.2), (4.55, 5.0)],
        [(6.35, 4.5), (6.35, 3.22)],
        [(4.2, 2.6), (5.2, 2.6), (5.2, 3.0), (6.13, 3.0)],
        [(4.2, 1.1), (6.35, 1.1), (6.35, 2.78)],
        [(6.57, 3.0), (6.8, 3.0)],
        [(7.6, 2.5), (7.6, 0.1), (1.0, 0.1), (1.0, 4.5)],
        [(1.0, 1.1), (2.6, 1.1)],
        [(1.0, 2.6), (2.6, 2.6)],
    ):
        axes.plot(*np.array(points).T, color=INK, lw=1.8)
        chart.arrow(axes, points[-2], points[-1], INK, 1.8)
    axes.text(6.5, 3.75, r"$\tau$", va="center")
    axes.text(4.6, 5.95, "$F$", ha="center")
    axes.text(2.1, 5.95, "$e$", ha="center")
    axes.text(2.1, 3.65, r"$\dot e$", ha="center")
    axes.text(4.3, 0.25, r"measured $q$, $\dot q$", ha="center", fontsize=chart.SMALL)
    axes.set(xlim=(0.0, 8.6), ylim=(-0.1, 6.4))
    chart.blank(axes)


def _box(axes: Axes, x: float, y: float, words: str, colour: str) -> None:
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [WIDE, HIGH] + [x, y]
    axes.fill(*corners.T, facecolor="white", edgecolor=colour, lw=2.5, zorder=2)
    axes.text(x, y, words, ha="center", va="center", fontsize=chart.SMALL, zorder=3,
              linespacing=1.1)  # fmt: skip


@chart.picture(height=5.0)
def cone(figure: Figure) -> None:
    """Draw a tip on a table, its friction cone, a force inside and one outside."""
    axes = figure.subplots()
    up = 3.0
    side = MU * up
    axes.fill([-3.4, 5.0, 5.0, -3.4], [0, 0, -0.5, -0.5], color=RULE)
    axes.fill([0, -side, side], [0, up, up], color=BLUE, alpha=0.15)
    for x in (-side, side):
        axes.plot([0, x], [0, up], color=BLUE, lw=2, ls="--")
    chart.arrow(axes, (0, 0), (0.9, 2.4), GREEN, 3.5)
    axes.text(1.9, 2.6, "inside: it sticks", color=GREEN)
    chart.arrow(axes, (0, 0), (2.4, 1.5), RED, 3.5)
    axes.text(2.45, 1.55, "outside:\nit slides", color=RED, va="center")
    chart.arrow(axes, (0, 0), (0, 2.7), INK, 2.0)
    axes.text(-0.1, 2.75, "normal", ha="right")
    angle = np.linspace(np.pi / 2, np.pi / 2 + np.arctan(MU), 40)
    axes.plot(1.2 * np.cos(angle), 1.2 * np.sin(angle), color=INK, lw=1.5)
    axes.text(-1.9, 1.0, r"$\tan^{-1} \mu$", ha="center")
    axes.text(-3.3, -0.27, "table", va="center", fontsize=chart.SMALL)
    axes.set(xlim=(-3.4, 5.0), ylim=(-0.55, 3.2))
    chart.blank(axes)


def small() -> Image.Image:
    """Return the hand on the table, and the force that it presses with."""
    model = scenes.press_table()
    q = lab.day6_mujoco.above_table(model, HAND)
    x, y = scenes.PRESS_XY
    top = scenes.PRESS_HEIGHT
    T_world_table = se3.make_T(np.eye(3), [x, y, top - 0.03])
    table = Box(T_world_table, (0.22, 0.3, 0.03), cards.WOOD)
    force = cards.arrow((x, y - 0.2, top + 0.4), (x, y - 0.2, top), cards.ORANGE)
    return cards.arm(q, boxes=[table, *force])


FIGURES = {"push": push, "press": press, "loop": loop, "cone": cone}
SMALL = (small, "")  # of a table of days, and its number
