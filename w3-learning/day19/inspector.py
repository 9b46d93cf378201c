"""Day 19 in the inspector: the tab Pixels.

A point of light is blurred and sampled by a camera of 12 x 12 pixels. The student's
`gaussian_kernel` and `conv2d` compute the image, and `spatial_softmax` the centroid.
The panel shows the image with the centroid as a cross; the scene shows where the
policy believes the puck to be, for a camera that is beside its place.
"""

from typing import NamedTuple

import numpy as np

from labkit.inspector import declared as ui
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of
from robo47 import pixels
from robo47.checks import Array

import day15_mujoco

LAB = lab_of(find_day(19))
SIDE = 30  # screen pixels of a camera's pixel
UP = day15_mujoco.PUCK  # m, the height of the centre above the table


class Seen(NamedTuple):
    """An image, the centroid in it, and the error on paper."""

    image: Array  # (12, 12)
    point: Array  # (2,), m
    predicted: float  # m


class Pixels(ui.Declared):
    """What the camera sees of a puck, and where its centroid is."""

    title = "Pixels"
    library = pixels
    functions = {
        "gaussian_kernel": "", "conv2d": "", "spatial_softmax": "m",
        "centroid_error": "m",
    }  # fmt: skip
    arm_hidden = True
    camera = ((0.0, -0.7, 0.9), (0.0, 0.0, 0.0))

    x = ui.slider("puck: x", -0.3, 0.3, 0.06, "m")
    y = ui.slider("puck: y", -0.3, 0.3, 0.17, "m")
    blur = ui.slider("blur, in pixels", 0.2, 0.8, 0.5)
    beside = ui.slider("camera: offset along x", -0.05, 0.05, 0.0, "m")
    image = ui.panel.image(
        np.zeros((12 * SIDE, 12 * SIDE, 3)), "12 x 12 pixels, with the centroid"
    )
    puck = ui.scene.sphere(np.zeros(3), day15_mujoco.PUCK, "orange", legend="puck")
    best = ui.scene.sphere(np.zeros(3), 0.008, "white", legend="the library's centroid")
    ghost = ui.yours.sphere(
        np.zeros(3), day15_mujoco.PUCK, "blue", 0.4, legend="puck by your centroid"
    )

    def ask(self, fns, at) -> Seen:
        half = int(6 * at.blur * LAB.FINER)
        fine = pixels.pixel_grid(finer=LAB.FINER, margin=half)
        light = np.zeros((len(fine), len(fine)))
        column, row = (
            int(np.argmin(np.abs(fine - place))) for place in (at.x - at.beside, at.y)
        )
        light[row, column] = 1.0
        kernel = fns.gaussian_kernel(at.blur * LAB.FINER, half)
        image = np.asarray(fns.conv2d(light, kernel, LAB.FINER), dtype=float)
        maps = np.log(np.maximum(image, 0.0) + 1e-300)[None]
        point = np.asarray(fns.spatial_softmax(maps, LAB.GRID, LAB.GRID, 1.0))[0]
        error = fns.centroid_error(LAB.CELL, at.blur * LAB.CELL)
        # The bodies are on the fine grid, so the error is the camera's and the blur's.
        self.true = np.array([fine[column] + at.beside, fine[row]])
        return Seen(image, point, float(error))

    def show(self, yours: Seen, right: Seen) -> None:
        self.puck.position = np.array([*self.true, UP])
        self.ghost.position = np.array([*yours.point, UP])
        self.best.position = np.array([*right.point, 2 * UP])
        self.image.image = self.drawn(yours)

    def drawn(self, yours: Seen) -> Array:
        """Return the image with y upwards and a cross at the centroid, bytes."""
        most = max(float(np.max(np.abs(yours.image))), 1e-12)
        bright = np.clip(yours.image / most, 0.0, 1.0)
        colour = bright[..., None] * np.array([230, 159, 0]) + 25.0
        dots = np.clip(colour, 0, 255).astype(np.uint8)
        big = dots.repeat(SIDE, axis=0).repeat(SIDE, axis=1)
        column, row = (
            int(np.clip((value / LAB.CELL + 6.0) * SIDE, 8, 12 * SIDE - 9))
            for value in yours.point
        )
        big[row, column - 8 : column + 9] = 255
        big[row - 8 : row + 9, column] = 255
        return big[::-1]

    def says(self, yours: Seen, right: Seen):
        off = 1e3 * np.linalg.norm(yours.point - self.true)
        yield (
            f"Your centroid is {off:.2f} mm from the puck. By your `centroid_error`, "
            f"the blur causes at most {1e3 * yours.predicted:.2f} mm along each axis.",
            " ".join(self.functions),
        )


TABS = [Pixels]
