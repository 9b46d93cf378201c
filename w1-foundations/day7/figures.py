"""The pictures of Day 7, made with the lab's own functions; drawn by `make figures`.

profiles   s, speed, acceleration and jerk of four ways to go from 0 to 1
pick       the arm over the table, and the way of the cube as a line
letters    the arm that has written 47 in the air, and what it wrote
"""

import io
from collections.abc import Callable
from itertools import pairwise

import day7_trajectory
import matplotlib
import numpy as np
from day7_trajectory import A_MAX, GOAL_Q, READY_Q, V_MAX, profiles, quintic_duration
from matplotlib.figure import Figure  # not pyplot, which may look for a display
from PIL import Image

from labkit.figures import client, portrait
from labkit.figures.overlay import HALO, Layer
from labkit.figures.scene import Box, Camera, Scene
from robo47 import capstone, scenes, se3
from robo47.checks import Array

from . import letters

COLOURS = {
    "constant speed": "#868e96",
    "trapezoid": "#e8590c",
    "cubic": "#1c64f2",
    "quintic": "#2f9e44",
}
ROWS = (
    ("s", (-0.05, 1.05)),
    ("speed, 1/s", (-0.1, 2.0)),
    ("acceleration, 1/s²", (-8.0, 8.0)),
    ("jerk, 1/s³", (-90.0, 90.0)),
)
SAMPLES = 2000  # times at which the curves are drawn
SIZE = (1200, 900)
WAY = (224, 49, 49)
WOOD, ORANGE = (0.80, 0.72, 0.60, 1.0), (0.95, 0.55, 0.15, 1.0)


def profile_sheet() -> Image.Image:
    """Return s, speed, acceleration and jerk over time, one below the other."""
    T = quintic_duration(GOAL_Q - READY_Q, V_MAX, A_MAX)
    figure = Figure(figsize=(12, 12), dpi=100, layout="constrained")
    with matplotlib.rc_context({"font.size": 17, "axes.linewidth": 1.2}):
        axes = figure.subplots(4, 1, sharex=True)
        for name, (scaling, seconds) in profiles(T).items():
            if name in COLOURS:
                curves = _sampled(scaling, seconds, T)
                for ax, curve in zip(axes, curves[1:], strict=True):
                    ax.plot(curves[0], curve, color=COLOURS[name], lw=3, label=name)
        for ax, (label, limits) in zip(axes, ROWS, strict=True):
            ax.set_ylabel(label)
            ax.set_ylim(*limits)
            ax.grid(color="#dee2e6")
            ax.set_axisbelow(True)
        axes[3].text(0.5 * T, 62.0, "jumps of the acceleration leave the sheet",
                     ha="center", color="#495057")  # fmt: skip
        axes[0].legend(loc="upper left", frameon=False)
        axes[3].set_xlabel("seconds")
    return _to_image(figure)


def pick() -> Image.Image:
    """Return the arm as it lifts, and the way that the cube takes in all."""
    done = capstone.pick(capstone.with_own(vars(day7_trajectory)))
    began = dict(done.phases)
    now = int(np.searchsorted(done.t, began["carry"] + 0.25))
    cube = done.qpos[:, 9:16]
    boxes = (_table(), _cube(cube[0], 0.35), _cube(cube[now]), _cube(cube[-1], 0.35))
    camera = Camera((0.3, 0.0, 0.32), 2.3, np.radians(205.0), np.radians(-18.0))
    scene = Scene(done.qpos[now, :9], SIZE, camera, boxes=boxes, fast=False)
    return _with_way(scene, [cube[::4, :3]])


def forty_seven() -> Image.Image:
    """Return the arm at the end of its writing, and where the pen was on the board."""
    written = letters.write(day7_trajectory)
    camera = Camera((0.3, 0.0, 0.42), 2.0, np.radians(20.0), np.radians(-8.0))
    scene = Scene(portrait.with_fingers(written.q), SIZE, camera, fast=False)
    on_board = np.abs(written.reached[:, 0] - letters.BOARD) < 5e-4
    ends = np.flatnonzero(np.diff(on_board)) + 1
    pieces = np.split(written.reached, ends)
    return _with_way(scene, pieces[0 if on_board[0] else 1 :: 2])


def _sampled(scaling: Callable[[float], Array], seconds: float, T: float) -> Array:
    """Return t, s, sd, sdd and the jerk, (5, SAMPLES), still after the end."""
    t = np.linspace(-0.05 * T, 1.05 * T, SAMPLES)
    rows = np.array([
        scaling(x) if 0.0 <= x < seconds else [float(x >= seconds), 0.0, 0.0]
        for x in t
    ])  # fmt: skip
    return np.vstack([t, rows.T, np.gradient(rows[:, 2], t)])


def _with_way(scene: Scene, pieces: list[Array]) -> Image.Image:
    """Draw a scene, and over it lines through points, (n, 3) each."""
    layer = Layer(SIZE)
    for colour, width in ((HALO, 9), (WAY, 5)):
        for piece in pieces:
            pixels = scene.camera.project(piece, SIZE)[:, :2]
            for a, b in pairwise(pixels):
                layer.line([tuple(map(float, a)), tuple(map(float, b))], colour, width)
    return layer.over(Image.fromarray(client.draw(scene)))


def _table() -> Box:
    half = (*scenes.TABLE_HALF, scenes.TABLE_HEIGHT / 2)
    place = np.array([*scenes.TABLE_CENTRE, scenes.TABLE_HEIGHT / 2])
    return Box(se3.make_T(np.eye(3), place), half, WOOD)


def _cube(pose: Array, opacity: float = 1.0) -> Box:
    T = se3.make_T(se3.quat_to_R(pose[3:]), pose[:3])
    return Box(T, (scenes.CUBE_HALF,) * 3, (*ORANGE[:3], opacity))


def _to_image(figure: Figure) -> Image.Image:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    return Image.open(buffer).convert("RGB")


FIGURES = {"profiles": profile_sheet, "pick": pick, "letters": forty_seven}
