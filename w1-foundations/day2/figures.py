"""The pictures of Day 2, made with the lab's own functions; drawn by `make figures`.

screws        the arm at q = 0, its seven axes as lines, and how far apart they are
dh_roulette   one DH table, five readings of it, drawn as five arms
pitch, dh_conventions   drawings: a screw's two halves, one link's frame in two books
"""

from itertools import pairwise

import numpy as np
from day2_screws import FRANKA_DH, SEED, exp_rotation, joint_screws
from PIL import Image

from labkit.figures import cards, client, portrait
from labkit.figures.overlay import HALO, INK, LEADER, SMOOTH, Layer
from labkit.figures.scene import Camera, Scene
from robo47 import kinematics, panda, verify
from robo47.checks import Array

from .drawings import dh_conventions, pitch
from .roulette import READINGS, distances

SIZE = (1200, 1000)
LARGE = (SIZE[0] * SMOOTH, SIZE[1] * SMOOTH)  # of the sheet over it
LINKS = [f"body:link{i}" for i in range(1, 8)]  # each turns about its own z axis
AXES = [
    (255, 94, 87), (96, 156, 255), (255, 159, 64), (70, 201, 98),
    (204, 112, 235), (59, 201, 219), (247, 131, 172),
]  # fmt: skip
GHOSTS = [(255, 94, 87), (255, 159, 64), (204, 112, 235), (96, 156, 255), INK]
SHOWN_Q = np.array([0.4, -0.3, 0.3, -1.9, 0.5, 1.9, 0.6])  # where the five part well
THIN = 4.0  # of a line, in pixels of a picture 800 high
LENGTHS = {  # in the model file, metres: from where to where, (x, z) at y = 0
    "0.333": ((-0.3, 0.0), (-0.3, 0.333)),
    "0.316": ((-0.3, 0.333), (-0.3, 0.649)),
    "0.384": ((-0.3, 0.649), (-0.3, 1.033)),
    "0.0825": ((0.0, 0.79), (0.0825, 0.79)),
    "0.088": ((0.0, 1.19), (0.088, 1.19)),
}
HEIGHTS = {0.0: 0.0, 0.333: 0.0, 0.649: 0.0825, 1.033: 0.0}  # metres: of which x
HALF, ROUND = 0.21, 0.055  # metres: half a drawn axis; the radius of its curved arrow


def screws() -> Image.Image:
    """Return the arm at q = 0 with its seven axes; no numbers: they are asked for."""
    poses = kinematics.fk_all(panda.load("panda_nohand"), np.zeros(7))
    T_zero = np.array([poses[link] for link in LINKS])
    rows = joint_screws(T_zero)
    scene = Scene(
        portrait.with_fingers(np.zeros(7)),
        SIZE,
        Camera((0.17, 0.14, 0.58), 2.9, np.radians(130.0), np.radians(-12.0)),
        fast=False,
    )
    picture = Image.fromarray(client.draw(scene))
    layer = Layer(LARGE)
    _lengths(layer, scene.camera)
    anchors = []
    for i, (S, T) in enumerate(zip(rows, T_zero, strict=True)):
        anchors.append(_axis(layer, scene.camera, S, T[:3, 3], i))
    _labels(layer, np.array(anchors))
    return layer.over(picture)


def dh_roulette() -> Image.Image:
    """Return five readings of one DH table, drawn as arms over the real one."""
    scene = Scene(
        portrait.with_fingers(SHOWN_Q),
        SIZE,
        Camera((0.1, 0.0, 0.53), 2.4, np.radians(125.0), np.radians(-12.0)),
    )
    layer = Layer(LARGE)
    random = verify.random_q(panda.load("panda_nohand"), 20, SEED)
    median = {k: np.median(v) for k, v in distances(FRANKA_DH, random).items()}
    for i, (name, read) in enumerate(READINGS.items()):
        poses = read(FRANKA_DH, SHOWN_Q)
        seen = scene.camera.project(poses[:, :3, 3], LARGE)[:, :2]
        _polyline(layer, seen, GHOSTS[i], width=14 if i == 3 else 6)
        y = (60.0 + 46.0 * i) * SMOOTH
        layer.line([(40.0 * SMOOTH, y), (90.0 * SMOOTH, y)], GHOSTS[i], 8)
        words = f"{1000 * median[name]:.0f} mm  {name}"
        layer.text((110.0 * SMOOTH, y), words, "lm")
    return layer.over(Image.fromarray(client.draw(scene)))


def _axis(layer: Layer, camera: Camera, S: Array, origin: Array, i: int) -> Array:
    """Draw one screw's line with an arrow and its sense; return where it is named."""
    omega = S[:3]
    # Three of the seven are one line: draw each where its own link is.
    ends = np.array([origin - HALF / 2 * omega, origin + HALF * omega])
    start, tip = (tuple(p) for p in camera.project(ends, LARGE)[:, :2])
    layer.arrow(start, tip, HALO, 4)
    layer.arrow(start, tip, AXES[i], 0)
    across = np.cross(omega, [1.0, 0.0, 0.0])
    angles = np.radians(np.linspace(0.0, 290.0, 40))
    circle = np.array([exp_rotation(omega, x) @ across for x in angles])
    points = camera.project(
        ends[0] + 0.85 * (ends[1] - ends[0]) + ROUND * circle, LARGE
    )
    _polyline(layer, points[:-3, :2], AXES[i], THIN)
    layer.arrow(tuple(points[-4, :2]), tuple(points[-1, :2]), AXES[i], 0)
    return camera.project(origin + 0.6 * HALF * omega, LARGE)[:2]


def _labels(layer: Layer, anchors: Array) -> None:
    """Write each screw's name in a column at the right, with a leader."""
    tops = np.linspace(130.0, SIZE[1] - 250.0, len(anchors)) * SMOOTH
    for top, i in zip(tops, np.argsort(anchors[:, 1]), strict=True):
        layer.label(
            f"S{i + 1}", (760.0 * SMOOTH, float(top)), tuple(map(float, anchors[i]))
        )


def _lengths(layer: Layer, camera: Camera) -> None:
    """Draw how far the axes are apart, with ticks, and the origin's frame."""

    def seen(x: float, z: float) -> tuple[float, float]:
        at = camera.project(np.array([x, 0.0, z]), LARGE)
        return float(at[0]), float(at[1])

    for z, x in HEIGHTS.items():
        layer.line([seen(-0.33, z), seen(x, z)], LEADER, 1.5)
    for words, (start, end) in LENGTHS.items():
        a, b = seen(*start), seen(*end)
        if start[0] == end[0]:
            layer.arrow(a, b, INK, -2)
            layer.arrow(b, a, INK, -2)
            middle = ((a[0] + b[0]) / 2 - 42, (a[1] + b[1]) / 2)
            layer.text(middle, words, "rm")
        else:  # too short for two arrows
            layer.line([a, b], INK, 4)
            layer.text((b[0] + 42, b[1]), words, "lm")
    x, y = seen(0.0, 0.0)
    tips = [seen(0.15, 0.0), camera.project(np.array([0, 0.15, 0.0]), LARGE)[:2]]
    for name, tip in zip("xy", tips, strict=True):
        layer.arrow((x, y), (float(tip[0]), float(tip[1])), INK, -1)
        layer.text((float(tip[0]) + 30, float(tip[1]) + 36), name, "mm")


def _polyline(
    layer: Layer, points: Array, colour: tuple[int, int, int], width: float
) -> None:
    """Draw an open line through pixels, (n, 2), with a dot at each where it is wide."""
    pixels = [(float(x), float(y)) for x, y in points]
    for a, b in pairwise(pixels):
        layer.line([a, b], HALO, width + 3)
    for a, b in pairwise(pixels):
        layer.line([a, b], colour, width)
    for x, y in pixels if width > THIN else []:
        layer.dot((x, y), INK, 5)


def small() -> Image.Image:
    """Return the arm at q = 0 and the lines that its joints turn about."""
    poses = kinematics.fk_all(panda.load("panda_nohand"), np.zeros(7))
    origins = np.array([poses[link][:3, 3] for link in LINKS])
    axes = joint_screws(np.array([poses[link] for link in LINKS]))[:, :3]
    rods = [
        cards.rod(p - 0.4 * omega, p + 0.4 * omega, (*np.divide(colour, 255), 1.0))
        for p, omega, colour in zip(origins, axes, AXES, strict=True)
    ]
    return cards.arm(np.zeros(7), Camera((0.05, 0.0, 0.62), 2.9), rods)


FIGURES = {
    "screws": screws,
    "dh_roulette": dh_roulette,
    "pitch": pitch,
    "dh_conventions": dh_conventions,
}
SMALL = (small, "")  # of a table of days, and its number
