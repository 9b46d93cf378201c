"""The picture of Day 10, made with the lab's own functions; drawn by `make figures`.

shown   the depth image, the cloud that it makes, and fits in their 95 % ellipse
calibrated  two cameras that eight poses cannot distinguish
"""

import day10_camera as lab
import mujoco
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart, sheet
from labkit.figures.chart import BLUE, INK, RED, SKY
from labkit.figures.scene import Box, Camera
from robo47 import camera as library
from robo47 import depth_camera, panda, scenes, se3
from robo47.screws import skew

import day10_mujoco

FITS = 150
CHI2_2 = 5.991  # of two numbers: 95 % are within


@chart.picture(height=7.5)
def shown(figure: Figure) -> None:
    """Draw a depth image, the points above the table, and how far fits are off."""
    grid = figure.add_gridspec(2, 2, height_ratios=(1.35, 1.0))
    above = [figure.add_subplot(grid[0, i]) for i in (0, 1)]
    below = figure.add_subplot(grid[1, :])
    model, data = day10_mujoco.table()
    T_world_cube = day10_mujoco.cubes(1, lab.SEED + 1)[0]
    day10_mujoco.place(model, data, T_world_cube)
    mujoco.mj_forward(model, data)  # fills cam_xpos, cam_xmat, and what rays meet
    K, T_world_cam = depth_camera.camera(model, data, "eye")
    _image(above[0], depth_camera.depth(model, data, "eye"))
    corners = day10_mujoco.CORNERS @ T_world_cube[:3, :3].T + T_world_cube[:3, 3]
    pixels = lab.project(K, se3.inverse(T_world_cam), corners)
    above[0].plot(*pixels.T, "o", ms=3, color=RED, label="project: its corners")
    above[0].legend(loc="lower left", facecolor="white", framealpha=0.8, frameon=True)
    cloud = lab.depth_cloud(model, data, K, T_world_cam)
    _cloud(above[1], cloud[cloud[:, 2] > day10_mujoco.TABLE + lab.ABOVE], T_world_cube)
    T = se3.make_T(se3.Rz(0.3) @ se3.Rx(2.3), (0.05, 0.02, lab.NEAR))
    for distance, colour in ((2 * lab.NEAR, SKY), (lab.NEAR, BLUE)):
        T[:3, 3] *= distance / T[2, 3]
        _ellipse(below, K, T, colour)
    below.set(xlabel="error along the view, mm", ylabel="across, mm")
    below.set_title(f"{FITS} fits with noise, and their 95 % ellipses")
    below.legend(loc="upper left")
    below.grid()


def _image(axes: Axes, depth: np.ndarray) -> None:
    """Draw the depth image, dark is near."""
    height, width = depth.shape
    seen = np.where(np.isfinite(depth), depth, np.nan)
    edge = (0, width, height, 0)  # (0, 0) is the picture's corner, as in the lab
    axes.imshow(seen, cmap="Blues_r", extent=edge)
    axes.set(title="Depth: what is seen", xlabel="u, px", ylabel="v, px")
    axes.set(xlim=(130, 190), ylim=(140, 80))  # the cube is small in it


def _cloud(axes: Axes, cloud: np.ndarray, T_world_cube: np.ndarray) -> None:
    """Draw the cube's points from above, its outline, their mean."""
    x, y = 1000 * cloud[:, :2].T
    half = 1000 * day10_mujoco.CORNERS[-1, 0]
    square = half * np.array([[-1, 1, 1, -1, -1], [-1, -1, 1, 1, -1]])
    turned = T_world_cube[:2, :2] @ square + 1000 * T_world_cube[:2, 3:]
    axes.plot(x, y, ".", ms=3, color=BLUE, label="seen")
    axes.plot(*turned, "-", color=INK, linewidth=1.5, label="the cube")
    axes.plot(x.mean(), y.mean(), "s", ms=8, color=RED, label="mean of the points")
    axes.set(title="The cloud, from above", xlabel="x, mm", ylabel="y, mm")
    axes.legend(loc="lower center")
    middle = x.mean() - 6, y.mean() - 16
    axes.set(xlim=(middle[0] - 45, middle[0] + 45), aspect="equal")
    axes.set(ylim=(middle[1] - 45, middle[1] + 45))
    axes.grid()


def _ellipse(axes: Axes, K: np.ndarray, T: np.ndarray, colour: str) -> None:
    """Draw the positions of noisy fits, and the ellipse of the covariance."""
    corners = day10_mujoco.CORNERS
    exact = lab.project(K, T, corners)
    J = lab.projection_jacobian(K, corners @ T[:3, :3].T + T[:3, 3])
    at_cube = np.hstack([-skew(T[:3, 3]), np.eye(3)])
    C = at_cube @ lab.pose_covariance(J, lab.NOISE) @ at_cube.T
    rng = np.random.default_rng(lab.NOISE_SEED)
    seen = exact + lab.NOISE * rng.normal(size=(FITS, *exact.shape))
    places = np.array([lab.refine_pose(K, T, corners, one)[:3, 3] for one in seen])
    off = 1000 * (places - T[:3, 3])[:, [2, 0]]
    turn = np.linspace(0, 2 * np.pi, 200)
    circle = np.sqrt(CHI2_2) * np.array([np.cos(turn), np.sin(turn)])
    across = 1000 * np.linalg.cholesky(C[np.ix_([2, 0], [2, 0])]) @ circle
    axes.plot(*off.T, ".", ms=5, color=colour, label=f"{T[2, 3]:.1f} m away")
    axes.plot(*across, "-", linewidth=2.0, color=RED)


def small() -> Image.Image:
    """Return the eye over the table, what it sees of it, and the cube."""
    centre = (*scenes.TABLE_CENTRE, day10_mujoco.TABLE / 2)
    half = (*scenes.TABLE_HALF, day10_mujoco.TABLE / 2)
    T_world_cube = day10_mujoco.cubes(1, lab.SEED + 1)[0]
    size = 2 * scenes.CUBE_HALF  # twice as large, to be seen
    corners = 2 * day10_mujoco.CORNERS @ T_world_cube[:3, :3].T + T_world_cube[:3, 3]
    rays = [cards.rod(day10_mujoco.AT, p, cards.SKY, 0.004) for p in corners]
    eye_box = Box(se3.make_T(np.eye(3), day10_mujoco.AT), (0.05,) * 3, cards.SKY)
    table = Box(se3.make_T(np.eye(3), centre), half, cards.WOOD)
    cube = Box(T_world_cube, (size,) * 3, cards.ORANGE)
    camera = Camera((0.6, 0.0, 0.42), 2.2, np.radians(118.0), np.radians(-18.0))
    return cards.arm(panda.READY_Q, camera, [table, cube, eye_box, *rays])


def poses(joints: np.ndarray, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return eight configurations (8, 7), and the hand's and the camera's poses there.

    Args:
        joints: 1 for each joint that moves, else 0, (7,).
        seed: of the configurations.
    """
    away = np.random.default_rng(seed).uniform(-0.5, 0.5, (lab.LOOKS, 7))
    q = panda.READY_Q + away * joints
    return q, *day10_mujoco.looks(day10_mujoco.handheld(), q)


def calibrated() -> Image.Image:
    """Return two cameras that some poses cannot distinguish, and others can."""
    wrong = library.apply_twist(day10_mujoco.ON_HAND, lab.FREE)
    q, hands, _ = poses(np.eye(7)[6], lab.SEED)
    near = Camera(tuple(hands[0][:3, 3] + [0, 0, 0.02]), 0.8, np.radians(150.0))
    both = (day10_mujoco.ON_HAND, cards.SKY), (wrong, cards.RED)
    eyes = [part for X, colour in both for part in camera_at(hands[0] @ X, colour)]
    fresh, hands, seen = poses(np.ones(7), lab.SEED + 1)
    far = Camera((0.35, 0.0, 0.4), 2.3, np.radians(150.0), np.radians(-22.0))
    wood = (*cards.WOOD[:3], 0.5)  # points below the table are seen through it
    middle = se3.make_T(np.eye(3), (*scenes.TABLE_CENTRE, day10_mujoco.TABLE - 0.005))
    top = Box(middle, (*scenes.TABLE_HALF, 0.005), wood)
    points = [dot(p, cards.RED) for p in lab.said(hands, seen, wrong)]
    points.append(dot(day10_mujoco.TO, cards.SKY))
    mm = 1000 * np.linalg.norm((wrong - day10_mujoco.ON_HAND)[:3, 3])
    return sheet.side_by_side(
        (cards.bare(q[0], near, eyes), "Only joint 7 moves",
         f"both cameras fit exactly, {mm:.0f} mm apart"),
        (cards.bare(fresh[0], far, [top, *points]), "Eight other poses",
         "the table's middle, by the wrong camera"),
    )  # fmt: skip


def camera_at(T: np.ndarray, colour: cards.Paint) -> list[Box]:
    """Return a camera's box and its direction of view."""
    ahead = T[:3, 3] + 0.1 * T[:3, 2]
    return [
        Box(T, (0.016, 0.012, 0.02), colour),
        cards.rod(T[:3, 3], ahead, colour, 0.003),
    ]


def dot(point: np.ndarray, colour: cards.Paint) -> Box:
    """Return a small cube at a point."""
    return Box(se3.make_T(np.eye(3), point), (0.012,) * 3, colour)


FIGURES = {"shown": shown, "calibrated": calibrated}
SMALL = (small, "0.8 mm")  # of a table of days, and its number
