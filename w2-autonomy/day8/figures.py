"""The picture of Day 8, made with the lab's own functions; drawn by `make figures`.

shown   singular values of two motions, and the error of a predicted torque
floats  the loaded arm after two seconds, without and with the identified load
"""

import day8_identification as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart, sheet
from labkit.figures.chart import BLUE, INK, RED
from labkit.figures.scene import Box, Camera
from robo47 import panda, se3, simulate

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


def floating() -> dict[str, simulate.Run]:
    """Return how the loaded arm floats, by the load in the model of its gravity.

    The noise of the measurements is the lab's own, so the numbers are the lab's, too.
    """
    model = panda.load("panda_nohand", drive="torque")
    arm = panda.arm(model)
    robot = day8_mujoco.changed(model, lab.ROBOT_SEED)
    rng = np.random.default_rng(lab.NOISE_SEED)
    rng.normal(size=day8_mujoco.swing().q.shape)
    excited = day8_mujoco.excitation(robot, lab.ROBOT_SEED)
    tau = lab.mujoco_torques(robot, excited) + lab.NOISE * rng.normal(
        size=excited.q.shape
    )
    fast = np.abs(excited.qd) > lab.SLOW
    phi = lab.truncated_svd_fit(lab.regressor(arm, excited)[fast], tau[fast], lab.RTOL)
    rng.normal(size=excited.q.shape)
    load = day8_mujoco.load(lab.LOAD, lab.AT)
    hung = panda.load("panda_nohand", drive="torque", edit=load)
    loaded = day8_mujoco.changed(hung, lab.ROBOT_SEED)
    found = lab.weighings(robot, loaded, arm, rng)["each from both sides"][0]
    rest = np.zeros(7)

    def still(now):
        Y = lab.arm_regressor(now.J_space, now.T_links, rest, rest, arm.gravity)
        return Y @ phi[:70]

    loads = {"No load in the model": np.zeros(4), "Identified load": found}
    return {
        name: day8_mujoco.floats(loaded, arm, still, load)
        for name, load in loads.items()
    }


def floats() -> Image.Image:
    """Return the arm with its payload after two seconds of floating, and its start."""
    arm = panda.arm(panda.load("panda_nohand"))
    camera = Camera((0.25, 0.0, 0.4), 2.3)
    panels = []
    for name, run in floating().items():
        hands = np.array([arm.at(q).T_world_ee[:3, 3] for q in run.q[::20]])
        rise = 1000 * (arm.at(run.q[-1]).T_world_ee - arm.at(run.q[0]).T_world_ee)[2, 3]
        told = (
            f"the hand {'sinks' if rise < 0 else 'rises'} by {abs(rise):.0f} mm in 2 s"
        )
        boxes = cards.line(hands, cards.RED if rise < -100 else cards.SKY, 0.008)
        boxes.append(payload(arm.at(run.q[-1]).T_world_ee))
        panels.append((cards.bare(run.q[-1], camera, boxes), name, told))
    return sheet.side_by_side(*panels)


def payload(T_world_ee: np.ndarray) -> Box:
    """Return the payload as a cube at its centre of mass."""
    T = T_world_ee @ se3.make_T(np.eye(3), lab.AT)
    return Box(T, (0.035, 0.035, 0.035), cards.ORANGE)


FIGURES = {"shown": shown, "floats": floats}
SMALL = (small, "500 g")  # of a table of days, and its number
