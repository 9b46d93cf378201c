"""The pictures of Day 6, made with the lab's own functions; drawn by `make figures`.

push    how far a soft hand gives way, for eleven forces, on the predicted line
press   the force on the table over time: the soft arm, and the stiff one with and
        without the limits of its motors
"""

import io

import matplotlib
import mujoco
import numpy as np
from day6_task_space import (
    PRESS,
    RATE,
    READY_Q,
    SINK,
    K,
    set_point_for_force,
    soft_hand,
    stiff_arm,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure  # not pyplot, which may look for a display
from PIL import Image

from robo47 import contact, panda, scenes, simulate

BLUE, RED, INK, RULE = "#1c64f2", "#e03131", "#212529", "#dee2e6"
STEP = 0.002  # s, of the simulator
FORCES = np.linspace(-20.0, 20.0, 11)  # N, along x
STIFFNESSES = (400.0, 1000.0)  # N/m


def moved(force: float, k: float) -> float:
    """Return how far the hand moves along x under a force along x, in metres."""
    model = panda.load("panda_nohand", drive="torque")
    arm, start = panda.arm(model), simulate.start(model, READY_Q)
    stiffness = np.append(K[:3], np.full(3, k))
    push = simulate.push_at(contact.SITE, [0.0, 0.0, 0.0, force, 0.0, 0.0])
    law = soft_hand(arm, READY_Q, stiffness=stiffness)
    run = simulate.run(model, start, law, 3.0, rate=RATE, push=push)
    ends = [arm.at(q).T_world_ee[0, 3] for q in run.q[[0, -1]]]
    return ends[1] - ends[0]


def presses() -> tuple[np.ndarray, ...]:
    """Return the force on the table over three seconds: soft, stiff, without limits."""
    depth, start = set_point_for_force(PRESS, K[5], scenes.TOUCH), scenes.TOUCH + 0.01
    soft = contact.press(
        lambda arm, q: soft_hand(arm, q, lambda t: max(depth, start - SINK * t)),
        seconds=3.0,
        rate=RATE,
    )
    servos = {"drive": "servo", "seconds": 3.0}
    stiff = contact.press(stiff_arm, **servos)
    return soft, stiff, contact.press(stiff_arm, change=_no_limits, **servos)


def _no_limits(model: mujoco.MjModel) -> None:
    model.actuator_forcelimited[:] = 0


def push() -> Image.Image:
    """Return displacement against force, measured, over the line F / k."""
    figure, axes = _axes("A push, predicted and measured", "force along x (N)")
    for k, colour in zip(STIFFNESSES, (BLUE, RED), strict=True):
        axes.plot(FORCES, 1000 * FORCES / k, color=colour, linewidth=1.5)
        off = [1000 * moved(force, k) for force in FORCES]
        axes.plot(FORCES, off, "o", color=colour, markersize=10)
        axes.text(
            12.0, 1000 * 12.0 / k - 9.0, f"{k:.0f} N/m", color=colour, fontsize=20
        )
    axes.set_ylabel("displacement along x (mm)")
    axes.text(-19, 38, "lines: F / k, before any simulation", color=INK, fontsize=18)
    axes.text(-19, 33, "dots: where the hand came to rest", color=INK, fontsize=18)
    return _to_image(figure)


def press() -> Image.Image:
    """Return the contact force over time, soft, stiff, and stiff without limits."""
    figure, axes = _axes("Told to go 50 mm into a table", "time (s)")
    names = "soft, 400 N/m", "servos, at their limits", "servos without limits"
    for felt, name, colour in zip(presses(), names, (BLUE, RED, INK), strict=True):
        t = np.arange(1, len(felt) + 1) * STEP
        axes.plot(t, felt, color=colour, linewidth=3)
        words = f"{name}: {felt[-1]:.0f} N, peak {felt.max():.0f} N"
        above = felt[round(1.1 / STEP)] + 12
        axes.text(1.1, above, words, color=colour, fontsize=20)
    axes.axhline(PRESS, color=INK, linestyle="--", linewidth=1.5)
    words = {"s": "20 N: wanted and predicted", "ha": "right", "fontsize": 18}
    axes.text(3.0, PRESS - 30, color=INK, **words)
    axes.set_ylabel("force on the table (N)")
    return _to_image(figure)


def _axes(title: str, below: str) -> tuple[Figure, Axes]:
    with matplotlib.rc_context({"font.size": 18, "axes.linewidth": 1.2}):
        figure = Figure(figsize=(12, 8), dpi=100, layout="constrained")
        axes = figure.subplots()
        axes.set_title(title, pad=16)
        axes.set_xlabel(below)
        axes.grid(color=RULE)
        axes.set_axisbelow(True)
        axes.spines[["top", "right"]].set_visible(False)
    return figure, axes


def _to_image(figure: Figure) -> Image.Image:
    file = io.BytesIO()
    with matplotlib.rc_context({"font.size": 18}):
        figure.savefig(file, format="png")
    return Image.open(file).convert("RGB")


FIGURES = {"push": push, "press": press}
