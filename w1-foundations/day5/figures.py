"""The picture of Day 5, made with the lab's own functions; drawn by `make figures`.

error_curves   an error of 0.1 rad decays under five controllers; dashed: predicted
"""

import io

import matplotlib
import numpy as np
from day5_control import (
    E0,
    OMEGA,
    READY_Q,
    equal_springs,
    error_response,
    gains_outside,
    run,
    springs,
    springs_and_gravity,
)
from matplotlib.figure import Figure  # not pyplot, which may look for a display
from PIL import Image

from robo47 import panda, references, simulate
from robo47.checks import Array
from robo47.verify import loops

SECONDS, RATE = 1.0, 500.0  # at 500 Hz the curve is predicted to 1.2 % of e0
COLOURS = ("#868e96", "#9c36b5", "#e8590c", "#2f9e44", "#1c64f2")


def curves() -> dict[str, Array]:
    """Return the largest |e| / e0 of any joint at every instant, per controller."""
    model, start, goal = loops.motors(), READY_Q - E0, references.hold(READY_Q)
    arm = panda.arm(model)
    servos = panda.load("panda_nohand")
    logs = {
        "servos of the file": simulate.run(
            servos,
            simulate.start(servos, start),
            lambda t, q, qd: READY_Q,
            SECONDS,
            rate=RATE,
        )
    }
    for name, law in {
        "springs": springs,
        "springs and gravity": springs_and_gravity,
        "gains outside M": gains_outside,
        "computed torque": equal_springs(),
    }.items():
        logs[name] = run(model, arm, law, goal, SECONDS, start, RATE)
    return {
        name: np.abs((READY_Q - log.q) / E0).max(axis=1) for name, log in logs.items()
    }


def error_curves() -> Image.Image:
    """Return the five errors on one log axis, and the predicted curve dashed."""
    t = np.arange(round(SECONDS * RATE) + 1) / RATE
    figure = Figure(figsize=(12, 8), dpi=100, layout="constrained")
    with matplotlib.rc_context({"font.size": 18, "axes.linewidth": 1.2}):
        axes = figure.subplots()
        for (name, e), colour in zip(curves().items(), COLOURS, strict=True):
            axes.plot(t, e, color=colour, linewidth=3)
            axes.text(1.01 * SECONDS, e[-1], name, color=colour, va="center")
        predicted = error_response(t, OMEGA, 1.0)
        axes.plot(t, predicted, "k--", linewidth=2)
        axes.text(0.06, 2e-4, "predicted, dashed:\n(1 + ωt) e^(-ωt)", ha="left")
        axes.set_yscale("log")
        axes.set_xlim(0.0, SECONDS)
        axes.set_ylim(1e-7, 4.0)
        axes.set_title("0.1 rad off in every joint: what is left of it, worst joint")
        axes.set_xlabel("time, s")
        axes.set_ylabel("|e| / e0")
        axes.grid(color="#dee2e6")
        axes.spines[["top", "right"]].set_visible(False)
    file = io.BytesIO()
    figure.savefig(file, format="png")
    return Image.open(file).convert("RGB")


FIGURES = {"error_curves": error_curves}
