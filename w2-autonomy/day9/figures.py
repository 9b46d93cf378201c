"""The picture of Day 9, made with the lab's own functions; drawn by `make figures`.

felt    the error of a filtered velocity over its cutoff; the residuals of a push
pushed  the arm after a push, with a bar of the residual at each joint
"""

import day9_estimation as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart, sheet
from labkit.figures.chart import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PURPLE,
    RED,
    SKY,
)
from labkit.figures.scene import Box, Camera
from robo47 import panda

import day9_mujoco

CUTOFFS = np.geomspace(2.0, 200.0, 13)  # Hz
ENCODERS = ((14, RED, "s-"), (16, BLUE, "o-"), (18, GREEN, "^-"))
COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY)


@chart.picture(height=9.0)
def felt(figure: Figure) -> None:
    """Draw the error over the cutoff for three encoders, and a push's residuals."""
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    above, below = figure.subplots(2, 1)
    _error_over_cutoff(above, day9_mujoco.moved(model, arm, day9_mujoco.SWING, 2.0))
    push = day9_mujoco.push(lab.FLANGE, lab.FORCE, lab.SINCE)
    held = day9_mujoco.moved(model, arm, day9_mujoco.STAY, 0.8, push)
    truth = lab.mujoco_external_torque(model, held.q[-1], lab.FLANGE, lab.FORCE)
    _push(below, lab.felt(arm, held), truth)
    for axes in (above, below):
        axes.grid()


def _error_over_cutoff(axes: Axes, swing) -> None:
    """Draw the error of a velocity behind each low pass, for each encoder."""
    qd = swing.qd[:, lab.JOINT]
    for bits, colour, mark in ENCODERS:
        raw = lab.backward_difference(lab.encoder(swing.q, bits)[:, lab.JOINT], lab.DT)
        off = [
            lab.rms((lab.low_pass(raw, lab.DT, f) - qd)[lab.SETTLED :]) for f in CUTOFFS
        ]
        axes.loglog(CUTOFFS, off, mark, color=colour, label=f"{bits} bits")
    lag = [lab.rms((lab.low_pass(qd, lab.DT, f) - qd)[lab.SETTLED :]) for f in CUTOFFS]
    axes.loglog(CUTOFFS, lag, "--", color=INK, label="lag alone")
    axes.set(
        xlabel="cutoff of the low pass, Hz", ylabel="RMS error of the velocity, rad/s"
    )
    axes.set_title("Joint 4: lag at low cutoffs, noise at high cutoffs")
    axes.legend(loc="lower left")


def _push(axes: Axes, residual: np.ndarray, truth: np.ndarray) -> None:
    """Draw the seven residuals, and the joint torques of the push by MuJoCo."""
    t = 1000 * (np.arange(len(residual)) * lab.DT - lab.SINCE)
    shown = (t > -60) & (t < 240)
    feels = np.abs(truth) > lab.THRESHOLD
    rest = ", ".join(str(joint + 1) for joint in np.flatnonzero(~feels))
    axes.plot(t[shown], residual[shown][:, ~feels], color=GREY)
    for joint, colour in zip(np.flatnonzero(feels), COLOURS, strict=False):
        name = f"joint {joint + 1}"
        axes.plot(t[shown], residual[shown, joint], color=colour, label=name)
        axes.plot([0, 240], [truth[joint]] * 2, "--", color=colour, linewidth=1.5)
    axes.text(240, 0.12, f"joints {rest}", color=GREY, ha="right", fontsize=chart.SMALL)
    axes.set(xlabel="time since the push, ms", ylabel="residual, N m")
    axes.set_title("10 N on the flange; dashed: $J^T F$")
    axes.legend(loc="center right", bbox_to_anchor=(1.0, 0.77))


def small() -> Image.Image:
    """Return the arm at ready, and the push on its flange."""
    q = panda.READY_Q
    at = panda.arm(panda.load("panda_nohand")).at(q).T_world_ee[:3, 3] + [0, 0, 0.16]
    push = cards.arrow(at - 0.035 * lab.FORCE, at, cards.RED, 0.02)
    return cards.arm(q, Camera((0.2, 0.0, 0.55), 2.6), push)


def pushed() -> Image.Image:
    """Return the arm after a push; a bar along each joint's axis is its residual."""
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    push = day9_mujoco.push(lab.FLANGE, lab.FORCE, lab.SINCE)
    run = day9_mujoco.moved(model, arm, day9_mujoco.STAY, lab.SINCE + 0.15, push)
    residual = lab.felt(arm, run)
    camera = Camera((0.2, 0.0, 0.5), 2.4)
    panels = []
    for ms in (10, 100):
        k = round((lab.SINCE + ms / 1000) / lab.DT)
        bars = [bar for one in bars_of(arm, run.q[k], residual[k]) for bar in one]
        at = arm.at(run.q[k]).T_world_ee[:3, 3] + [0, 0, 0.16]
        force = cards.arrow(at - 0.025 * lab.FORCE, at, cards.RED, 0.008)
        largest = np.abs(residual[k]).argmax()
        told = f"joint {largest + 1}: {residual[k, largest]:.1f} N m"
        picture = cards.bare(run.q[k], camera, [*bars, *force])
        panels.append((picture, f"{ms} ms after the push", told))
    return sheet.side_by_side(*panels)


def bars_of(arm, q: np.ndarray, residual: np.ndarray) -> list[list[Box]]:
    """Return a bar along each joint's axis, longer by 0.1 m per N m of its residual.

    A residual above the threshold of the lab is orange.
    """
    now = arm.at(q)
    found = []
    for T, x in zip(now.T_links, residual, strict=True):
        colour = cards.ORANGE if abs(x) > lab.THRESHOLD else cards.SKY
        ends = T[:3, 3] + np.outer([-1.0, 1.0], T[:3, 2]) * (0.08 + 0.05 * abs(x))
        found.append([cards.rod(*ends, colour, 0.012)])
    return found


FIGURES = {"felt": felt, "pushed": pushed}
SMALL = (small, "10 N")  # of a table of days, and its number
