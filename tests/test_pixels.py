"""Pixels: rays, convolutions and gradients against MuJoCo, SciPy, complex step."""

import mujoco
import numpy as np
import pytest
from compare import assert_same
from hypothesis import given
from hypothesis import strategies as st
from scipy.signal import correlate2d

from robo47 import cloning, pixels

SEEDS = st.integers(0, 2**32 - 1)


def test_the_worked_cases():
    seen = pixels.height_map([[0, 0]], [0.05], [0.0, 0.03], [0.0])
    assert_same(seen, [[0.05, 0.04]], 1e-14)
    kernel = pixels.gaussian_kernel(1.0, 1)
    assert_same(kernel[1], [0.123841, 0.204180, 0.123841], 1e-6)
    assert_same(kernel[0, ::2], [0.075114, 0.075114], 1e-6)
    image = np.arange(9.0).reshape(3, 3)
    kernel = [[1, 0], [0, 2]]
    assert_same(pixels.conv2d(image, kernel, 1), [[8, 11], [17, 20]], 0)
    of_kernel, of_image = pixels.conv2d_gradient(image, kernel, 1, [[1, 0], [0, 0]])
    assert_same(of_kernel, [[0, 1], [3, 4]], 0)
    assert_same(of_image, [[1, 0, 0], [0, 2, 0], [0, 0, 0]], 0)
    maps = np.log([[[1.0, 3.0]]])
    assert_same(pixels.spatial_softmax(maps, [0, 1], [5], 1.0), [[0.75, 5]], 1e-14)
    slope = pixels.spatial_softmax_gradient(maps, [0, 1], [5], 1.0, [[1, 0]])
    assert_same(slope, [[[-0.1875, 0.1875]]], 1e-14)
    assert pixels.centroid_error(0.1, 0.05) == pytest.approx(2.259e-3, abs=5e-7)
    turned, action = pixels.quarter_turn([[[1, 2], [3, 4]]], [0.1, 0.2], 1)
    assert_same(turned, [[[3, 1], [4, 2]]], 0)
    assert_same(action, [-0.2, 0.1], 0)


def test_the_height_map_is_what_vertical_rays_hit():
    centres, radii = [[0.01, -0.03], [0.05, 0.02]], [0.05, 0.03]
    geoms = "".join(
        f'<geom type="sphere" pos="{x} {y} 0" size="{r}"/>'
        for (x, y), r in zip(centres, radii, strict=True)
    )
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody>{geoms}</worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    xs, ys = np.linspace(-0.1, 0.11, 23), np.linspace(-0.09, 0.1, 17)
    hit = np.zeros((17, 23))
    for i, y in enumerate(ys):
        for j, x in enumerate(xs):
            far = mujoco.mj_ray(
                model, data, np.array([x, y, 1.0]), np.array([0.0, 0, -1]),
                None, 1, -1, np.zeros(1, np.int32),
            )  # fmt: skip
            hit[i, j] = 1.0 - far if far >= 0 else 0.0
    assert (hit > 0).sum() > 30
    assert_same(pixels.height_map(centres, radii, xs, ys), hit, 1e-8)


@given(SEEDS, st.integers(1, 4), st.sampled_from(((7, 9), (5, 5), (8, 6))))
def test_a_convolution_is_scipys_correlation_and_its_gradient_the_complex_step(
    seed, stride, size
):
    rng = np.random.default_rng(seed)
    image, kernel = rng.normal(size=size), rng.normal(size=(3, 2))
    out = pixels.conv2d(image, kernel, stride)
    assert_same(
        out, correlate2d(image, kernel, mode="valid")[::stride, ::stride], 1e-13
    )
    d = rng.normal(size=out.shape)

    def loss(image, kernel):
        return np.sum(d * pixels.conv2d(image, kernel, stride))

    of_image, of_kernel = cloning.complex_step(loss, [image, kernel])
    mine = pixels.conv2d_gradient(image, kernel, stride, d)
    assert_same(mine[0], of_kernel, 1e-13)
    assert_same(mine[1], of_image, 1e-13)


@given(SEEDS, st.floats(0.3, 3.0))
def test_the_gradient_of_the_spatial_softmax_is_that_of_the_complex_step(seed, heat):
    rng = np.random.default_rng(seed)
    maps, xs, ys = rng.normal(size=(2, 3, 4)), rng.normal(size=4), rng.normal(size=3)
    d = rng.normal(size=(2, 2))
    wanted = cloning.complex_step(
        lambda maps: np.sum(d * pixels.spatial_softmax(maps, xs, ys, heat)), [maps]
    )[0]
    mine = pixels.spatial_softmax_gradient(maps, xs, ys, heat, d)
    assert_same(mine, wanted, 1e-13)
    assert_same(mine.sum(axis=(1, 2)), [0, 0], 1e-13)


def test_limits_of_the_spatial_softmax():
    xs, ys = np.array([0.0, 1, 5]), np.array([2.0, 4])
    flat = pixels.spatial_softmax(np.full((1, 2, 3), 7e5), xs, ys, 0.1)
    assert_same(flat, [[2, 3]], 1e-12)
    maps = np.full((1, 2, 3), -np.inf)
    maps[0, 1, 2] = -3.0
    assert_same(pixels.spatial_softmax(maps, xs, ys, 1.0), [[5, 4]], 0)
    maps[0, 0, 2] = -3.0
    assert_same(
        pixels.spatial_softmax_gradient(maps, xs, ys, 1.0, [[1, 2]])[0, :, 2],
        [-1, 1],
        1e-14,
    )
    sharp = pixels.spatial_softmax([[[1.0, 2, 0], [0, 1, 1.9]]], xs, ys, 1e-3)
    assert_same(sharp, [[1, 2]], 1e-12)


@pytest.mark.parametrize(
    ("sigma", "off"), [(0.4, 0.005), (0.5, 1e-3), (0.6, 1e-3), (0.8, 1e-3)]
)
def test_the_centroid_of_a_sampled_gaussian_is_off_by_what_poisson_says(sigma, off):
    xs = np.arange(-20.0, 21.0)
    errors = []
    for u in np.linspace(0.0, 0.5, 51):
        image = pixels.spot_images([u, 0.0], xs, xs, sigma)
        x, y = pixels.spatial_softmax(np.log(image + 1e-300)[None], xs, xs, 1.0)[0]
        assert y == pytest.approx(0.0, abs=1e-12)
        errors.append(x - u)
    assert np.argmin(errors) in (24, 25, 26)  # a quarter of a pixel, towards 0
    paper = pixels.centroid_error(1.0, sigma)
    assert np.max(np.abs(errors)) / paper == pytest.approx(1.0, abs=off)
    assert pixels.centroid_error(0.3, 0.3 * sigma) == pytest.approx(0.3 * paper)


@given(SEEDS, st.integers(-7, 7))
def test_a_quarter_turn_moves_what_is_seen_as_it_turns_a_vector(seed, k):
    rng = np.random.default_rng(seed)
    point, grid = rng.uniform(-0.5, 0.5, 2), pixels.pixel_grid()
    image = pixels.spot_images(point, grid, grid, 0.07)
    turned, moved = pixels.quarter_turn(image[None], point, k)
    assert_same(turned[0], pixels.spot_images(moved, grid, grid, 0.07), 1e-13)
    assert moved @ moved == pytest.approx(point @ point)
    back, same = pixels.quarter_turn(turned, moved, -k)
    assert_same(back[0], image, 0)
    assert_same(same, point, 0)


def test_a_finer_grid_contains_the_pixels():
    fine = pixels.pixel_grid(finer=8, margin=20)
    assert_same(fine[20:-20:8], pixels.pixel_grid(), 1e-14)
    assert_same(pixels.pixel_grid()[[0, -1]], [-0.55, 0.55], 1e-14)


def test_a_spot_is_a_point_that_the_kernel_blurs():
    fine, grid = pixels.pixel_grid(finer=8, margin=24), pixels.pixel_grid()
    image = np.zeros((len(fine), len(fine)))
    image[60, 71] = 1.0
    blurred = pixels.conv2d(image, pixels.gaussian_kernel(4.0, 24), 8)
    spot = pixels.spot_images([fine[71], fine[60]], grid, grid, 0.05)
    assert_same(blurred / blurred.max(), spot / spot.max(), 1e-7)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: pixels.height_map([[0, 0]], [-1.0], [0], [0]), "radii is -1"),
        (lambda: pixels.height_map([[0, 0]], [1.0, 2], [0], [0]), "centres has shape"),
        (lambda: pixels.gaussian_kernel(0.0, 1), "sigma is 0"),
        (lambda: pixels.gaussian_kernel(1.0, -1), "half is -1"),
        (lambda: pixels.conv2d(np.eye(2), np.eye(3), 1), "fits into the image"),
        (lambda: pixels.conv2d(np.eye(2), np.eye(2), 0), "stride is 0"),
        (lambda: pixels.conv2d([1.0], np.eye(2), 1), "image has shape"),
        (
            lambda: pixels.conv2d_gradient(np.eye(3), np.eye(2), 1, np.eye(3)),
            "d has shape",
        ),
        (
            lambda: pixels.spatial_softmax(np.zeros((1, 2, 3)), [0, 1], [0, 1, 2], 1.0),
            "expected \\(c, h, w\\)",
        ),
        (
            lambda: pixels.spatial_softmax(np.zeros((1, 1, 1)), [0], [0], 0.0),
            "temperature is 0",
        ),
        (
            lambda: pixels.spatial_softmax(np.full((1, 1, 1), -np.inf), [0], [0], 1.0),
            "only entries of -inf",
        ),
        (
            lambda: pixels.spatial_softmax_gradient(
                np.zeros((1, 1, 1)), [0], [0], 1.0, [1.0, 2]
            ),
            "d has shape",
        ),
        (lambda: pixels.centroid_error(0.0, 1.0), "spacing is 0"),
        (lambda: pixels.quarter_turn(np.zeros((1, 2, 3)), [0, 0], 1), "images has"),
        (lambda: pixels.spot_images([0.0], [0], [0], 1.0), "points has shape"),
    ],
)
def test_what_cannot_be_computed_is_refused(call, says):
    with pytest.raises(ValueError, match=says):
        call()
