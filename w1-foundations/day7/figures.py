"""The pictures of Day 7, made with the lab's own functions; drawn by `make figures`.

profiles   s, its velocity, acceleration and jerk, of four time scalings
grip       a cube between two pads, with their friction cones
pick       the arm over the table, and the path of the cube as a line
letters    the arm that has written 47 in the air, and the strokes
"""

from collections.abc import Callable
from itertools import pairwise

import day7_trajectory
import numpy as np
from day7_trajectory import A_MAX, GOAL_Q, READY_Q, V_MAX, profiles, quintic_duration
from matplotlib.figure import Figure
from PIL import Image

from labkit.figures import cards, chart, client, portrait
from labkit.figures.chart import BLUE, GREEN, GREY, INK, ORANGE, RED
from labkit.figures.overlay import HALO, SMOOTH, Layer
from labkit.figures.scene import Box, Camera, Scene
from robo47 import capstone, scenes, se3
from robo47.checks import Array

from . import letters

LOOKS = {
    "constant speed": (GREY, "-"),
    "trapezoid": (ORANGE, "--"),
    "cubic": (BLUE, "-."),
    "quintic": (GREEN, "-"),
}
ROWS = (
    ("s", (-0.05, 1.05)),
    ("velocity, 1/s", (-0.1, 2.0)),
    ("accel., 1/s²", (-8.0, 8.0)),
    ("jerk, 1/s³", (-90.0, 90.0)),
)
SAMPLES = 2000  # times at which the curves are drawn
SIZE = (1200, 900)
LARGE = (SIZE[0] * SMOOTH, SIZE[1] * SMOOTH)  # of the sheet over it
WAY = (255, 94, 87)
WOOD, PAINT = (0.80, 0.72, 0.60, 1.0), (0.95, 0.55, 0.15, 1.0)


@chart.picture(height=9.5)
def profile_sheet(figure: Figure) -> None:
    """Draw s, velocity, acceleration and jerk over time, one below the other."""
    T = quintic_duration(GOAL_Q - READY_Q, V_MAX, A_MAX)
    axes = figure.subplots(4, 1)
    for name, (scaling, seconds) in profiles(T).items():
        if name in LOOKS:
            colour, style = LOOKS[name]
            curves = _sampled(scaling, seconds, T)
            for ax, curve in zip(axes, curves[1:], strict=True):
                ax.plot(curves[0], curve, style, color=colour, label=name)
    for ax, (label, limits) in zip(axes, ROWS, strict=True):
        ax.set(ylabel=label, ylim=limits, xticks=[])
        ax.grid()
    axes[3].text(0.5 * T, 58.0, "off the scale where the acceleration jumps",
                 ha="center", fontsize=chart.SMALL)  # fmt: skip
    figure.legend(
        *axes[0].get_legend_handles_labels(), loc="outside upper left", ncols=2
    )
    axes[3].set(xlabel="time, s", xticks=np.arange(0.0, 1.1, 0.2))


@chart.picture(height=5.6)
def grip(figure: Figure) -> None:
    """Draw a cube between two pads, and the forces of the pads with their limits."""
    axes = figure.subplots()
    axes.fill([-1, 1, 1, -1], [-1, -1, 1, 1], facecolor="#f2dfc4", edgecolor=INK, lw=2)
    for side in (-1, 1):
        pad = np.array([[1.0, -0.5], [1.3, -0.5], [1.3, 0.5], [1.0, 0.5]]) * [side, 1]
        axes.fill(*pad.T, color=GREY)
        tip = np.array([side, 0.0])  # the force acts here, inwards and up
        reach = np.array([-side * 0.85, 0.85])
        axes.fill(
            *np.array([tip, tip + reach, tip + reach * [1, -1]]).T,
            color=BLUE,
            alpha=0.15,
        )
        for y in (1, -1):
            axes.plot(
                *np.array([tip, tip + reach * [1, y]]).T, "--", color=BLUE, lw=1.5
            )
        chart.arrow(axes, (2.4 * side, 0), (1.3 * side, 0), INK, 3.0)
        chart.arrow(axes, tip, (side, 0.85), GREEN, 3.5)
        axes.text(2.45 * side, 0.25, "normal force $N$", ha="center")
    chart.arrow(axes, (0, -1.0), (0, -2.0), RED, 3.5)
    axes.text(0.15, -1.7, r"$m (g + a)$", color=RED)
    axes.text(1.45, 0.85, r"at most $\mu N$", color=GREEN)
    axes.text(-1.45, 0.85, r"at most $\mu N$", color=GREEN, ha="right")
    axes.text(0, 1.25, "friction cones for $\\mu = 1$", color=BLUE, ha="center")
    axes.set(xlim=(-3.4, 3.4), ylim=(-2.2, 1.7))
    chart.blank(axes)


def pick() -> Image.Image:
    """Return the arm as it lifts, and the whole path of the cube."""
    done = capstone.pick(capstone.with_own(vars(day7_trajectory)))
    began = dict(done.phases)
    now = int(np.searchsorted(done.t, began["carry"] + 0.25))
    cube = done.qpos[:, 9:16]
    boxes = (_table(), _cube(cube[0], 0.35), _cube(cube[now]), _cube(cube[-1], 0.35))
    camera = Camera((0.3, 0.0, 0.32), 2.3, np.radians(205.0), np.radians(-18.0))
    scene = Scene(done.qpos[now, :9], SIZE, camera, boxes=boxes, fast=False)
    return _with_way(scene, [cube[::4, :3]])


def forty_seven() -> Image.Image:
    """Return the arm after it has written, and the strokes of the pen on the board."""
    written = letters.write(day7_trajectory)
    camera = Camera((0.3, 0.0, 0.42), 2.0, np.radians(20.0), np.radians(-8.0))
    scene = Scene(portrait.with_fingers(written.q), SIZE, camera, fast=False)
    on_board = np.abs(written.reached[:, 0] - letters.BOARD) < 5e-4
    ends = np.flatnonzero(np.diff(on_board)) + 1
    pieces = np.split(written.reached, ends)
    return _with_way(scene, pieces[0 if on_board[0] else 1 :: 2])


def _sampled(scaling: Callable[[float], Array], seconds: float, T: float) -> Array:
    """Return t, s, sd, sdd and the jerk, (5, SAMPLES), also after the end."""
    t = np.linspace(-0.05 * T, 1.05 * T, SAMPLES)
    rows = np.array([
        scaling(x) if 0.0 <= x < seconds else [float(x >= seconds), 0.0, 0.0]
        for x in t
    ])  # fmt: skip
    return np.vstack([t, rows.T, np.gradient(rows[:, 2], t)])


def _with_way(scene: Scene, pieces: list[Array]) -> Image.Image:
    """Draw a scene, and over it lines through points, (n, 3) each."""
    layer = Layer(LARGE)
    for colour, width in ((HALO, 9), (WAY, 5)):
        for piece in pieces:
            pixels = scene.camera.project(piece, LARGE)[:, :2]
            for a, b in pairwise(pixels):
                layer.line([tuple(map(float, a)), tuple(map(float, b))], colour, width)
    return layer.over(Image.fromarray(client.draw(scene)))


def _table() -> Box:
    half = (*scenes.TABLE_HALF, scenes.TABLE_HEIGHT / 2)
    place = np.array([*scenes.TABLE_CENTRE, scenes.TABLE_HEIGHT / 2])
    return Box(se3.make_T(np.eye(3), place), half, WOOD)


def _cube(pose: Array, opacity: float = 1.0) -> Box:
    T = se3.make_T(se3.quat_to_R(pose[3:]), pose[:3])
    return Box(T, (scenes.CUBE_HALF,) * 3, (*PAINT[:3], opacity))


def small() -> Image.Image:
    """Return the arm as it lifts the cube, and the cube's path."""
    done = capstone.pick(capstone.with_own(vars(day7_trajectory)))
    now = int(np.searchsorted(done.t, dict(done.phases)["carry"] + 0.25))
    cube = done.qpos[:, 9:16]
    boxes = [_table(), _cube(cube[now]), *cards.line(cube[::40, :3], cards.RED)]
    camera = Camera((0.38, 0.0, 0.3), 1.9, np.radians(205.0), np.radians(-18.0))
    return cards.arm(done.qpos[now, :9], camera, boxes)


FIGURES = {
    "profiles": profile_sheet,
    "grip": grip,
    "pick": pick,
    "letters": forty_seven,
}
SMALL = (small, "")  # of a table of days, and its number
