"""The picture of Day 19, made with the lab's own functions; drawn by `make figures`.

pixels   one scene through the camera; the puck's end and successes over its offset
"""

from functools import cache
from types import SimpleNamespace
from typing import NamedTuple

import day19_pixels as lab
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from PIL import Image

from labkit.figures import chart, pushing
from labkit.figures.chart import BLUE, INK, ORANGE, RED
from labkit.figures.pushing import MM

import day15_mujoco

SEEN = np.array([[0.13, 0.22, 0.06, 0.27]])  # a scene of the picture: pusher, puck
OFFSETS = (0.0, 0.005, 0.01, 0.015, 0.02, 0.03)  # m
SILENT = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))


class Trained(NamedTuple):
    """Both policies, and what they did in the test."""

    pixels: "lab.Policy"
    centroids: "lab.Policy"
    runs: dict[str, day15_mujoco.Episodes]  # by name


@cache
def trained() -> Trained:
    """Train both networks and test them; two seconds of processor time."""
    images, action, _ = lab.demonstrations()
    policies = [
        lab.Policy(SILENT, "", features, images, action)
        for features in (lab.as_pixels, lab.as_centroids)
    ]
    names = ("288 pixels", "4 centroids")
    runs = {name: one.tested() for name, one in zip(names, policies, strict=True)}
    return Trained(*policies, runs)


def pinhole_images(seen: np.ndarray) -> np.ndarray:
    """Return the images of an observation without blur, (2, 12, 12)."""
    radii = (day15_mujoco.PUSHER, day15_mujoco.PUCK)
    return np.array(
        [
            lab.height_map(at[None], np.array([r]), lab.GRID, lab.GRID) > 0
            for at, r in zip(seen.reshape(2, 2), radii, strict=True)
        ]
    )


def show(axes: Axes, images: np.ndarray) -> None:
    """Draw both channels in the background: the pusher in red, the puck in orange."""
    bright = images / max(images.max(), 1e-9)
    colours = np.array([[0.80, 0.30, 0.10], [0.95, 0.65, 0.10]])
    rgb = 1 - np.einsum("chw,cd->hwd", bright, 1 - colours)
    half = MM * (lab.GRID[-1] + lab.CELL / 2)
    axes.imshow(
        np.clip(rgb, 0, 1), origin="lower", extent=(-half, half, -half, half), zorder=0
    )


@chart.picture(height=6.6)
def pixels(figure: Figure) -> None:
    """Draw what the camera sees, and what its offset does."""
    above, below = figure.subfigures(2, 1, height_ratios=(1.0, 1.0))
    _seen(above)
    ends, home = below.subplots(1, 2)
    _offsets(ends, home)


def _seen(figure) -> None:
    """Draw a scene without blur, with blur, and as two points."""
    blurred = lab.camera(SEEN)
    points = lab.as_centroids(blurred)[0]
    empty = np.zeros_like(blurred[0])
    titles = ("pinholes", "blurred by half a pixel", "two centroids")
    for axes, title, images in zip(
        figure.subplots(1, 3), titles, (pinhole_images(SEEN[0]), blurred[0], empty),
        strict=True,
    ):  # fmt: skip
        show(axes, images)
        pushing.bodies(axes, SEEN[0])
        axes.set(title=title, aspect="equal", xlim=(-150, 350), ylim=(0, 500))
        axes.set(xticks=(0, 200), yticks=(0, 200, 400))
    axes.plot(*MM * points[:2], "+", color=RED, ms=11, mew=2)
    axes.plot(*MM * points[2:], "+", color=ORANGE, ms=11, mew=2)
    off = MM * np.linalg.norm((points - SEEN[0]).reshape(2, 2), axis=1)
    axes.text(100, 60, f"off by\n{off[0]:.1f} and {off[1]:.1f} mm", ha="center")


def _offsets(ends: Axes, home: Axes) -> None:
    """Draw the shift of the puck and the successes over the offset of the camera."""
    policy = trained().centroids
    runs = [policy.tested(offset) for offset in OFFSETS]
    places = MM * np.array([lab.ends_of(run) for run in runs])
    x = MM * np.array(OFFSETS)
    ends.plot(x, x, color=INK, linewidth=1, label="predicted")
    ends.plot(x, places - places[0], "o", color=BLUE, ms=8, label="measured")
    ends.set(title="Shift of the puck", xlabel="offset of the camera, mm", ylabel="mm")
    ends.legend()
    home.plot(x, [np.sum(run.home()) for run in runs], "o-", color=BLUE, ms=8)
    home.set(title="Pucks at home", xlabel="offset of the camera, mm")
    home.set(ylabel=f"of {lab.TESTED}", ylim=(-5, 1.08 * lab.TESTED))
    for axes in (ends, home):
        axes.grid()


def small() -> Image.Image:
    """Return a puck and a pusher behind large pixels."""
    figure = Figure(figsize=(6.72, 5.04), dpi=100, facecolor="#1b1f24")
    axes = figure.add_axes((0, 0, 1, 1))
    images = lab.camera(SEEN)[0]
    dark = np.array([0.106, 0.122, 0.141])
    colours = np.array([[0.95, 0.26, 0.21], [1.0, 0.60, 0.10]])
    rgb = dark + np.einsum("chw,cd->hwd", images, colours - dark)
    half = MM * (lab.GRID[-1] + lab.CELL / 2)
    extent = (-half, half, -half, half)
    axes.imshow(np.clip(rgb, 0, 1), origin="lower", extent=extent)
    axes.add_patch(
        Circle(MM * SEEN[0, 2:], 50, fill=False, color="#59bff2", linewidth=8)
    )
    axes.add_patch(Circle(MM * SEEN[0, :2], 15, color="#59bff2"))
    axes.set(xlim=(-230, 370), ylim=(0, 450), aspect="equal")
    axes.set_axis_off()
    return chart.image_of(figure)


FIGURES = {"pixels": pixels}
SMALL = (small, "30 of 100")  # of a table of days, and its number
