"""The eye below the tray: an image of the puck, blurred, and its centroid.

A vertical ray goes up from the glass for each pixel of a fine grid. The image is 1
where the ray meets the puck first, and 0 elsewhere. A convolution blurs the image and
keeps every fourth pixel; the centroid is a spatial softmax (Day 19). Metres.
"""

from typing import Any

import mujoco
import numpy as np

from robo47.checks import Array
from robo47.pixels import pixel_grid
from robo47.pushing import scene

SIDE = 56  # pixels along each side of the fine image
CELL = 0.0125  # m between two of them
STRIDE = 4  # one pixel in four is kept along each axis
BLUR = 2.0  # pixels, standard deviation of the blur
HALF = 4  # pixels on each side of the middle of the kernel
ABOVE = 0.0005  # m from the top of the glass to the start of the rays
DARK = 1e-12  # added to the blurred image, whose logarithm is taken
UP = np.array([0.0, 0.0, 1.0])


class Eye:
    """The camera, and the functions that find the puck in its image."""

    def __init__(
        self, fns: Any, model: mujoco.MjModel, *, blur: bool = True, offset: float = 0.0
    ):
        """Prepare the rays and the kernel.

        Args:
            fns: has `gaussian_kernel`, `conv2d` and `spatial_softmax`.
            model: of `scene.tray`.
            blur: False keeps every fourth pixel without a blur.
            offset: added to the estimate along x, m: the eye is not where it is
                assumed to be.
        """
        self.fns = fns
        self.model = model
        self.seen = mujoco.MjData(model)
        self.puck = model.geom("puck").id
        self.offset = np.array([offset, 0.0])
        grid = pixel_grid(CELL, SIDE)
        self.kept = grid[HALF : SIDE - HALF : STRIDE]
        x, y = np.meshgrid(*np.add.outer(scene.HOME, grid))
        height = np.full(x.size, scene.TRAY + ABOVE)
        self.starts = np.column_stack([x.ravel(), y.ravel(), height])
        only = np.zeros((2 * HALF + 1, 2 * HALF + 1))
        only[HALF, HALF] = 1.0
        self.kernel = fns.gaussian_kernel(BLUR, HALF) if blur else only

    def image(self, data: mujoco.MjData) -> Array:
        """Return the fine image, (SIDE, SIDE), rows along y and columns along x."""
        self.seen.qpos[:] = data.qpos
        mujoco.mj_kinematics(self.model, self.seen)
        hit = np.zeros(1, np.int32)
        found = np.zeros(len(self.starts))
        for i, start in enumerate(self.starts):
            mujoco.mj_ray(self.model, self.seen, start, UP, None, 1, -1, hit)
            found[i] = hit[0] == self.puck
        return found.reshape(SIDE, SIDE)

    def look(self, data: mujoco.MjData) -> Array:
        """Return the estimated position of the puck in the plane, (2,)."""
        image = self.fns.conv2d(self.image(data), self.kernel, STRIDE)
        some = np.log(np.asarray(image) + DARK)[None]
        place = self.fns.spatial_softmax(some, self.kept, self.kept, 1.0)
        return np.asarray(place)[0] + self.offset
