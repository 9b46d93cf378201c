"""The picture of Day 14, made with the lab's own functions; drawn by `make figures`.

touched   two cubes between the pads with their friction cones; a learned policy
slip      the end of two lifts with the learned policy
"""

import day14_touch as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from PIL import Image

from labkit.figures import cards, chart, sheet
from labkit.figures.chart import BLUE, INK, RED
from labkit.figures.scene import Box, Camera
from robo47 import panda, scenes, se3
from robo47.jacobian import dls_step
from robo47.rotation_log import pose_error

import day14_mujoco

MASS = 0.15  # kg, of both cubes on the left
GRIPS = (0.9, 0.25)  # their friction
WHEN = 0.02  # s after the hand has begun to rise
CUBES = 150
NEWTON = 7.0  # mm, the length of an arrow for 1 N


@chart.picture(height=9.0)
def touched(figure: Figure) -> None:
    """Draw two grasps with forces and friction cones, and the cubes of a test."""
    grid = figure.add_gridspec(2, 2, height_ratios=(1.1, 1.2))
    held, slips = (figure.add_subplot(grid[0, i]) for i in (0, 1))
    tries = figure.add_subplot(grid[1, :])
    model, data = day14_mujoco.hand()
    theta = lab.learn(model, data, lab.SEED)
    for axes, mu in zip((held, slips), GRIPS, strict=True):
        _grip(axes, model, data, theta, mu)
    held.set_ylabel("z, mm")
    _tried(tries, model, data, theta)


def _grip(axes: Axes, model, data, theta: np.ndarray, mu: float) -> None:
    """Draw a cube between the pads from the front, with forces and friction cones."""
    cube = day14_mujoco.Cube(0.0, 0.0, 0.0, MASS, mu)
    action = theta * [0, 0, 0, 1, 1, 1]
    episode = day14_mujoco.episode(model, data, cube, action)
    ticks = round((day14_mujoco.CLOSED + WHEN) / day14_mujoco.STEP / day14_mujoco.TICK)
    for _ in range(ticks):
        next(episode)
    felt = day14_mujoco.felt(model, data)
    margin = lab.cone_margin(felt.force, felt.normal, felt.mu)
    most = mu * np.sum(felt.force * felt.normal, axis=1)
    slips = bool((margin < 0.02 * most).any())
    colour = RED if slips else BLUE
    y, z = 1000 * data.body("cube").xpos[1:]
    axes.add_patch(Rectangle((y - 20, z - 20), 40, 40, facecolor="0.9", edgecolor=INK))
    for side in (1, -1):
        some = felt.points[:, 1] * side > 0
        if not some.any():  # the cube has left this pad
            continue
        at = 1000 * felt.points[some].mean(axis=0)
        force = NEWTON * felt.force[some].sum(axis=0)
        normal = felt.normal[some][0]
        high = 1000 * data.geom("left" if side > 0 else "right").xpos[2]
        axes.add_patch(
            Rectangle((at[1] - 4 + 4 * side, high - 8.5), 8, 17, facecolor="0.6")
        )
        edges = lab.cone_edges(normal, mu, 36)[:, 1:] * (force @ normal) * 1.6
        for edge in (edges[edges[:, 1].argmin()], edges[edges[:, 1].argmax()]):
            axes.plot(*np.transpose([at[1:], at[1:] + edge]), color=INK, linewidth=0.9)
        axes.annotate(
            "",
            xy=at[1:] + force[1:],
            xytext=at[1:],
            arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.8},
        )
    says = "slipping" if slips else "held"
    axes.set(title=f"Friction {mu}: {says}", xlabel="y, mm", aspect="equal")
    axes.set(xlim=(-34, 34), ylim=(z - 34, z + 34))
    axes.text(0, z - 31, f"smallest margin {margin.min():.2f} N", ha="center")


def _tried(axes: Axes, model, data, theta: np.ndarray) -> None:
    """Draw the held cubes over friction and mass, and the limit of the grip force."""
    rng = np.random.default_rng(lab.CUBES_SEED)
    cubes = day14_mujoco.cubes(CUBES, rng, (0.2, 1.0))
    noise = lab.NOISE * rng.normal(size=(CUBES, 3))
    good = lab.held(lab.tried(model, data, theta, cubes, noise))
    mu = np.array([cube.mu for cube in cubes])
    grams = 1000 * np.array([cube.mass for cube in cubes])
    axes.plot(mu[good], grams[good], "o", ms=4, color=BLUE, label="held")
    axes.plot(mu[~good], grams[~good], "x", ms=5, color=RED, label="not held")
    line = np.array([0.2, 1.0])
    heaviest = 2000 * line * lab.squeezed(theta) / lab.G
    axes.plot(line, heaviest, "-", color=INK, linewidth=1.2, label="m = 2 mu F / g")
    axes.axvspan(*lab.ROUGH, color="0.92", zorder=0)
    axes.text(0.95, 8, "training\nset", ha="center", va="bottom", fontsize=chart.SMALL)
    axes.set(title="The learned policy", xlabel="friction", ylabel="mass, g")
    axes.set(ylim=(0, 265), xlim=(0.19, 1.01))
    axes.legend(loc="lower left", ncols=3, columnspacing=1.0, handletextpad=0.4)
    axes.grid()


def lifted(mu: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return an episode of the learned policy with a cube of 150 g.

    Returns:
        The Panda's configurations (n, 9), with hand and pads of the episode, the
        cube's positions relative to the point between the pads when it is grasped,
        (n, 3), and the smallest margins of the friction cone, N, (n,).
    """
    model, data = day14_mujoco.hand()
    theta = lab.learn(model, data, lab.SEED)
    cube = day14_mujoco.Cube(0.0, 0.0, 0.0, MASS, mu)
    action = lab.act(
        theta, lab.observe(se3.make_T(np.eye(3), (0, 0, 0.02)), np.zeros(3))
    )
    action[:3] = 0.0  # a centred grasp, so that friction alone decides
    pads, heights, places, margins = [], [], [], []
    for _ in day14_mujoco.episode(model, data, cube, action):
        felt = day14_mujoco.felt(model, data)
        margin = lab.cone_margin(felt.force, felt.normal, felt.mu)
        margins.append(margin.min() if len(margin) else 0.0)
        pads.append([data.joint(name).qpos[0] for name in ("left", "right")])
        heights.append(data.body("hand").xpos[2])
        places.append(data.body("cube").xpos.copy())
    rise = np.array(heights) - action[3]
    arm = panda.arm(panda.load("panda_nohand"))
    goals = np.tile(arm.at(panda.READY_Q).T_world_ee, (len(rise), 1, 1))
    goals[:, 2, 3] += rise
    angles = followed(arm, goals)
    return (
        np.hstack([angles, pads]),
        np.array(places) - [0, 0, action[3]],
        np.array(margins),
    )


def followed(arm, goals: np.ndarray) -> np.ndarray:
    """Return angles of the arm at neighbouring poses of the hand, (n, 7)."""
    q = panda.READY_Q.copy()
    found = []
    for goal in goals:
        for _ in range(3):
            now = arm.at(q)
            q = q + dls_step(now.J_site, pose_error(now.T_world_ee, goal), 1e-3)
        found.append(q)
    return np.array(found)


def slip() -> Image.Image:
    """Return the end of two lifts with the same policy, on two frictions."""
    T = panda.arm(panda.load("panda_nohand")).at(panda.READY_Q).T_world_ee
    tcp = (T @ se3.make_T(np.eye(3), scenes.TCP))[:3, 3]
    camera = Camera((tcp[0], tcp[1], tcp[2] + 0.06), 0.95, np.radians(160.0))
    panels = []
    for mu in GRIPS:
        q, cube, _ = lifted(mu)
        up = cube[-1, 2] - cube[0, 2]
        half = (day14_mujoco.HALF,) * 3
        box = Box(se3.make_T(np.eye(3), tcp + cube[-1]), half, cards.ORANGE)
        floor = tcp + cube[0] - [0, 0, day14_mujoco.HALF + 0.005]
        table = Box(se3.make_T(np.eye(3), floor), (0.2, 0.2, 0.005), cards.WOOD)
        told = f"the cube is {1000 * up:.0f} mm above the table"
        picture = cards.arm(q[-1], camera, [box, table])
        panels.append((picture, f"Friction {mu}", told))
    return sheet.side_by_side(*panels)


def small() -> Image.Image:
    """Return the hand with a cube between its fingers."""
    half = day14_mujoco.HALF
    q = np.append(panda.READY_Q, (half, half))
    T = panda.arm(panda.load("panda_nohand")).at(panda.READY_Q).T_world_ee
    tcp = T @ se3.make_T(np.eye(3), scenes.TCP)
    cube = Box(tcp, (half, half, half), cards.ORANGE)
    camera = Camera(tuple(tcp[:3, 3] - [0, 0, 0.03]), 1.0, np.radians(160.0))
    return cards.arm(q, camera, [cube])


FIGURES = {"touched": touched, "slip": slip}
SMALL = (small, "60 of 60")  # of a table of days, and its number
