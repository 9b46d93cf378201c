"""The pictures of Day 4, made with the lab's own functions; drawn by `make figures`.

torques   what each joint's motor spends at three poses: gravity, Coriolis, inertia
float     the hand's path: let go, on 99 % of gravity, on all of it, and pushed
"""

import io

import matplotlib
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
from matplotlib.figure import Figure  # not pyplot, which may look for a display
from PIL import Image

from robo47 import panda, simulate
from robo47.checks import Array

BLUE, RED, GREEN, INK, RULE = "#1c64f2", "#e03131", "#2f9e44", "#212529", "#dee2e6"
SPEED, ACCELERATION = 1.5, 5.0  # rad/s and rad/s^2, of every joint at once
POSES = {
    "ready": READY_Q,
    "stretched out to the front": np.array([0, 1.4, 0, -0.4, 0, 1.7, 0.785]),
    "folded up": np.array([0, -0.6, 0, -2.9, 0, 2.4, 0.785]),
}


def torques() -> Image.Image:
    """Return bars of the three torques per joint, a row for each pose."""
    figure = Figure(figsize=(12, 10), dpi=100, layout="constrained")
    with matplotlib.rc_context({"font.size": 17, "axes.linewidth": 1.2}):
        rows = figure.subplots(len(POSES), 1, sharex=True, sharey=True)
        for axes, (name, q) in zip(rows, POSES.items(), strict=True):
            _bars(axes, name, q)
        bars, words = rows[0].get_legend_handles_labels()
        figure.legend(
            bars, words, loc="outside upper left", ncols=3, frameon=False, fontsize=15
        )
        rows[1].set_ylabel("share of the motor's limit, %")
    return _to_image(figure)


def float_and_push() -> Image.Image:
    """Return how far the hand is from where it was, over time, on a log axis."""
    model = panda.load("panda_nohand", drive="torque")
    arm, calm = panda.arm(model), 0 * PUSH
    runs = {
        "let go (a joint limit stops it)": (RED, (0.0, (0.5, calm))),
        "99 % of gravity_torque": ("#e8590c", (0.99, (2.0, calm))),
        "all of it, pushed for 0.5 s": (BLUE, (1.0, (0.5, PUSH), (4.5, calm))),
        "all of it": (GREEN, (1.0, (5.0, calm))),
    }
    figure = Figure(figsize=(12, 7), dpi=100, layout="constrained")
    with matplotlib.rc_context({"font.size": 17, "axes.linewidth": 1.2}):
        axes = figure.subplots()
        for name, (colour, given) in runs.items():
            path = let_go(model, arm, *given)
            away = np.linalg.norm(path - path[0], axis=1)[1:]
            t = np.linspace(0.0, sum(s for s, _ in given[1:]), len(path))[1:]
            axes.semilogy(t, np.maximum(away, 1e-17), color=colour, lw=3)
            x, up = (2.05, 0.3) if "%" in name else (t[-1], 2.5)
            side = "left" if t[-1] < 5 else "right"
            axes.text(x, up * away[-1], name, color=colour, ha=side, va="bottom")
        axes.axhline(1e-6, color=INK, ls="--", lw=2)
        axes.text(4.98, 1.4e-6, "limit of float_5s", ha="right", color=INK)
        axes.axhline(1e-10, color=RULE, lw=2, zorder=0)
        axes.text(4.98, 1.4e-10, "size of an atom", ha="right", color=INK)
        axes.set(
            xlabel="seconds",
            ylabel="the hand's distance from its start, m",
            ylim=(3e-18, 30),
        )
        axes.spines[["top", "right"]].set_visible(False)
    return _to_image(figure)


def _parts(q: Array) -> dict[str, tuple[str, Array]]:
    """Return gravity's, Coriolis' and the acceleration's torque, N m, (7,) each."""
    model = panda.load("panda_nohand")
    arm, qd = panda.arm(model), np.full(7, SPEED)
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
        x, share = joints + 0.27 * (k - 1), 100 * tau / limits
        axes.bar(x, share, 0.25, color=colour, label=label)
        for x_bar, y, value in zip(x, share, tau, strict=True):
            if abs(y) >= 3:
                up, va = (1.5, "bottom") if y > 0 else (-1.5, "top")
                text = f"{value:.1f}"
                axes.text(x_bar, y + up, text, ha="center", va=va, fontsize=11)
    axes.axhline(0, color=INK, lw=1)
    for sign in (-100, 100):
        axes.axhline(sign, color=INK, lw=2, ls="--")
    axes.set_title(name, loc="left", fontsize=18, color=INK)
    axes.set(ylim=(-112, 112), yticks=[-100, -50, 0, 50, 100], xlim=(0.5, 7.5))
    words = [f"joint{i}\n±{limit:.0f} N m" for i, limit in enumerate(limits, 1)]
    axes.set_xticks(joints, words, fontsize=14)
    axes.spines[["top", "right", "bottom"]].set_visible(False)
    axes.tick_params(length=0)


def _to_image(figure: Figure) -> Image.Image:
    file = io.BytesIO()
    figure.savefig(file, format="png")
    return Image.open(file).convert("RGB")


FIGURES = {"torques": torques, "float": float_and_push}
