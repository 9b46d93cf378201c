"""The picture of Day 8, made with the lab's own functions; drawn by `make figures`.

shown   singular values of two motions, and the error of a predicted torque
"""

import day8_identification as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart
from labkit.figures.chart import BLUE, INK, RED
from labkit.figures.scene import Box
from robo47 import panda, se3

import day8_mujoco

JOINT = 3  # joint4, which carries much of the arm
SAMPLES = 200


@chart.picture(height=9.0)
def shown(figure: Figure) -> None:
    """Draw singular values of two motions, and a predicted torque with its band."""
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    robot = day8_mujoco.changed(model, lab.ROBOT_SEED)
    above, below = figure.subplots(2, 1)
    motion = day8_mujoco.excitation(robot, lab.ROBOT_SEED, SAMPLES)
    Y = lab.regressor(arm, motion)
    swing = day8_mujoco.swing(SAMPLES)
    rubs = np.abs(swing.qd) > lab.SLOW  # the rows that the lab fits
    _values(above, lab.regressor(arm, swing)[rubs], "Day 5's swing", "s", RED)
    _values(above, Y[np.abs(motion.qd) > lab.SLOW], "excitation", "o", BLUE)
    _torque(below, arm, robot, Y, motion)
    for axes in (above, below):
        axes.grid()


def _values(axes: Axes, Y: np.ndarray, name: str, mark: str, colour: str) -> None:
    """Draw the singular values of a motion, with rank and condition number."""
    Y = Y.reshape(-1, Y.shape[-1])
    s = np.linalg.svd(Y, compute_uv=False)
    rank, condition = lab.rank_and_condition(Y, lab.RTOL)
    number = float(f"{condition:.3g}")
    words = f"{name}: rank {rank}, condition number {number:,.0f}"
    axes.semilogy(s / s[0], mark, ms=4, color=colour, label=words)
    axes.axhline(lab.RTOL, color=INK, linestyle="--", linewidth=1.5)
    axes.set(
        ylim=(1e-18, 30),
        title="Singular values of the regressor",
        xlabel="index of the singular value",
    )
    axes.set_ylabel("fraction of the largest")
    axes.legend(loc=(0.03, 0.25))


def _torque(axes: Axes, arm, robot, Y: np.ndarray, motion: day8_mujoco.Motion) -> None:
    """Draw the error of one joint's torque on a new motion, by fit and by file."""
    noise = lab.NOISE * np.random.default_rng(lab.NOISE_SEED).normal(
        size=motion.q.shape
    )
    tau = lab.mujoco_torques(robot, motion) + noise
    fast = np.abs(motion.qd) > lab.SLOW
    new = day8_mujoco.excitation(robot, lab.ROBOT_SEED + 1, SAMPLES)
    rows = lab.regressor(arm, new)[:, JOINT]
    t = np.arange(SAMPLES) * 10.0 / SAMPLES
    torque, sigma = lab.predict_with_sigma(Y[fast], tau[fast], rows, lab.RTOL)
    true = lab.mujoco_torques(robot, new)[:, JOINT]
    true[np.abs(new.qd[:, JOINT]) < lab.SLOW] = np.nan  # no column for these rows
    band = 1.96 * sigma
    axes.fill_between(t, -band, band, color=BLUE, alpha=0.25, label="1.96 sigma")
    axes.plot(t, torque - true, "o", ms=4, color=BLUE, label="error of the fit")
    axes.plot(
        t,
        rows @ day8_mujoco.numbers(arm) - true,
        "--",
        color=RED,
        label="error of the file",
    )
    axes.set(xlabel="time, s", ylabel=f"torque error, joint {JOINT + 1}, N m")
    axes.set_title("Predictions for a motion outside the data")
    axes.set_ylim(top=2.0)  # room for the legend
    axes.legend(loc="upper right", ncols=3)


def small() -> Image.Image:
    """Return the arm with the payload."""
    q = lab.POSES[0]
    hand = panda.arm(panda.load("panda_nohand")).at(q).T_world_ee[:3, 3]
    below = hand - [0.0, 0.0, 0.3]
    ball = Box(se3.make_T(np.eye(3), below), (0.07, 0.07, 0.07), cards.ORANGE)
    return cards.arm(q, boxes=[cards.rod(hand, below, cards.ORANGE), ball])


FIGURES = {"shown": shown}
SMALL = (small, "500 g")  # of a table of days, and its number
