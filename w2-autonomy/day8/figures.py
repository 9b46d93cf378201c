"""The picture of Day 8, made with the lab's own functions; drawn by `make figures`.

shown   what two motions show, value by value; how far a predicted torque is off
"""

import io

import matplotlib
import numpy as np
from day8_identification import (
    NOISE,
    RTOL,
    SEED,
    SLOW,
    identifiable,
    predict_with_sigma,
    regressor,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure  # not pyplot, which may look for a display
from PIL import Image

from robo47 import panda, secret

BLUE, RED, INK, RULE = "#1c64f2", "#e03131", "#212529", "#dee2e6"
JOINT = 3  # joint4: much of the arm hangs on it
SAMPLES = 100


def shown() -> Image.Image:
    """Return singular values of two motions, and a predicted torque with its band."""
    model = panda.load("panda_nohand", drive="torque")
    arm, robot = panda.arm(model), secret.changed(model, SEED)
    with matplotlib.rc_context({"font.size": 16, "axes.linewidth": 1.2}):
        figure = Figure(figsize=(14, 7), dpi=100, layout="constrained")
        left, right = figure.subplots(1, 2, width_ratios=(2, 3))
        motion = secret.excitation(robot, SEED, SAMPLES)
        Y = regressor(arm, motion)
        _values(left, regressor(arm, secret.swing(SAMPLES)), "Day 5's swing", RED)
        _values(left, Y, "excited", BLUE)
        _torque(right, arm, robot, Y, motion)
        for axes in (left, right):
            axes.grid(color=RULE)
            axes.set_axisbelow(True)
            axes.spines[["top", "right"]].set_visible(False)
        file = io.BytesIO()
        figure.savefig(file, format="png")
    return Image.open(file).convert("RGB")


def _values(axes: Axes, Y: np.ndarray, name: str, colour: str) -> None:
    """Draw the singular values of a motion, and say how many count."""
    Y = Y.reshape(-1, Y.shape[-1])
    s, (rank, condition) = np.linalg.svd(Y, compute_uv=False), identifiable(Y, RTOL)
    words = f"{name}: {rank}, condition {condition:.0e}"
    axes.semilogy(np.arange(1, len(s) + 1), s / s[0], ".", color=colour, label=words)
    axes.axhline(RTOL, color=INK, linestyle="--", linewidth=1.5)
    axes.set(ylim=(1e-18, 30), xlabel="singular value", title="What a motion shows")
    axes.set_ylabel("of the largest")
    axes.legend(loc=(0.03, 0.25), fontsize=14)


def _torque(axes: Axes, arm, robot, Y: np.ndarray, motion: secret.Motion) -> None:
    """Draw how far one joint's torque is off on a new motion: by the fit, the file."""
    noise = NOISE * np.random.default_rng(SEED).normal(size=motion.q.shape)
    tau, fast = secret.torques(robot, motion) + noise, np.abs(motion.qd) > SLOW
    new = secret.excitation(robot, SEED + 1, SAMPLES)
    rows, t = regressor(arm, new)[:, JOINT], np.arange(SAMPLES) * 10.0 / SAMPLES
    torque, sigma = predict_with_sigma(Y[fast], tau[fast], rows, RTOL)
    true, band = secret.torques(robot, new)[:, JOINT], 1.96 * sigma
    axes.fill_between(t, -band, band, color=BLUE, alpha=0.25, label="1.96 sigma")
    axes.plot(t, torque - true, "o", color=BLUE, label="predicted by the fit")
    axes.plot(t, rows @ secret.numbers(arm) - true, color=RED, label="by the file")
    axes.set(xlabel="time (s)", ylabel=f"off joint{JOINT + 1}'s torque (N m)")
    axes.set_title("A motion that was never shown")
    axes.legend(loc="upper right", fontsize=14)


FIGURES = {"shown": shown}
