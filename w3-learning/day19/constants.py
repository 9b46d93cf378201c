"""The sensitivity of Day 19's numbers: each constant doubled, measured, explained."""

from functools import cache
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(19))
SILENT = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))

numbers = Numbers(
    radius="radius of the body: {} mm",
    spacing="distance between two pixels: {} mm",
    sigma="standard deviation of the blur: {} mm",
    finer="points of the fine grid per pixel: {}",
    images="images: {}",
    offset="offset of the camera: {} mm",
    demos="demonstrations: {}",
    seed="seed: {}",
)


@numbers.add(
    "images that do not show the pusher", "{:.3f}",
    radius=between(0.7, 0.82, "1 - pi r²/s²: 0.717"),
    spacing=between(1.04, 1.07, "1 - pi r²/s²: 0.982"),
    images=between(0.99, 1.01, "more random positions"),
    seed=between(0.99, 1.01, "other random positions"),
)  # fmt: skip
def missed(radius=15.0, spacing=100.0, images=LAB.PINHOLES, seed=LAB.SEED):
    """Return the fraction of images in which no pixel shows a body."""
    rng = np.random.default_rng(seed)
    r = np.array([radius / 1e3])
    grid = spacing / LAB.CELL / 1e3 * LAB.GRID
    places = rng.uniform(-4 * spacing / 1e3, 4 * spacing / 1e3, (images, 1, 2))
    return np.mean([not LAB.height_map(at, r, grid, grid).any() for at in places])


@numbers.add(
    "largest error of a centroid", "{:.2f} mm",
    spacing=between(20.0, 23.0, "first term: × exp(3.7) / 2 = 20; the second matters now"),
    sigma=times(0.0, "exp(-2 (pi sigma/s)²) is below 1e-8"),
    finer=same("a quarter of a pixel is on both grids"),
)  # fmt: skip
def aliased(spacing=100.0, sigma=50.0, finer=LAB.FINER):
    """Return the largest error of the centroid of a point of light, mm."""
    blur = sigma / spacing
    with patch.object(LAB, "FINER", finer):
        shifts = range(0, finer // 2 + 1, finer // 8)
        errors = [LAB.sampled_centroid(blur, shift) for shift in shifts]
    return np.max(np.abs(errors)) * spacing / LAB.CELL


@cache
def policy(demos, seed):
    """Return a policy on centroids, and where the puck ends, m."""
    with patch.multiple(LAB, DEMOS=demos, HELD_OUT=20, SEED=seed):
        images, action, _ = LAB.demonstrations()
        trained = LAB.Policy(SILENT, "", LAB.as_centroids, images, action)
    return trained, LAB.ends_of(trained.tested())


@numbers.add(
    "shift of the puck, camera off by 10 mm", "{:.0f} mm",
    offset=between(1.9, 2.1, "the image of the puck ends at the same place"),
    demos=same("the camera causes the shift, not the policy"),
    seed=same("the camera causes the shift, not the policy"),
)  # fmt: skip
def shifted(offset=10.0, demos=LAB.DEMOS, seed=LAB.SEED):
    """Return by how much the mean end of the puck moves, mm."""
    trained, base = policy(demos, seed)
    return 1e3 * (LAB.ends_of(trained.tested(offset / 1e3)) - base)
