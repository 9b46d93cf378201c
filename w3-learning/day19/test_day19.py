"""Day 19: the numbers in the guide's sentences, and every reason in it."""

import re
from functools import cache
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest

from conftest import ROOT, load_script, printed_by, sentences
from robo47 import cloning, pixels

import day15_mujoco

SENTENCES = sentences(19)
lab = load_script(ROOT / "w3-learning/src/day19_pixels.py")
SHIFT = np.array([0.05, 0, 0, 0])  # m, of the pusher along x
SILENT = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))


@cache
def data(seed=lab.SEED, demos=lab.DEMOS, blur=lab.BLUR):
    """Return images and actions of demonstrations, and the same held out."""
    with patch.multiple(lab, SEED=seed, DEMOS=demos, BLUR=blur):
        return lab.demonstrations()


def trained(features=lab.as_pixels, blur=lab.BLUR, rows=None, **how):
    """Return training loss, held-out loss, and the pucks that a policy brings home."""
    seed = how.get("SEED", lab.SEED)
    images, action, held = data(seed, how.get("DEMOS", lab.DEMOS), blur)
    if rows is not None:
        images, action = rows(images, action)
    with patch.multiple(lab, BLUR=blur, **how):
        policy = lab.Policy(SILENT, "", features, images, action)
        came = int(np.sum(policy.tested().home()))
        return policy.loss(images, action), policy.loss(*held), came


@pytest.fixture(scope="module")
def printed():
    """Return what the lab prints."""
    told = {"images that do not show the pusher, fraction": "0.9",
            "images that do not show the puck, fraction": "0.2",
            "largest error of a centroid, mm": "2",
            "shift of the puck, camera off by 10 mm, mm": "10"}  # fmt: skip
    return printed_by(lab, told)


# What a student's run tells in seconds.


def test_the_missed_fractions_on_paper():
    for r, words in ((15, "0.929 for the pusher"), (50, "0.215 for the puck")):
        assert f"{1 - np.pi * r**2 / 100**2:.3f}" in words
        assert words in SENTENCES
    seen = 100 * np.pi * day15_mujoco.PUSHER**2 / lab.CELL**2
    assert f"sees the pusher in {seen:.0f} % of its images" in SENTENCES
    assert 1 - np.pi * 60**2 / 100**2 < 0
    assert "For 60 mm it gives a negative fraction" in SENTENCES


def test_the_cases_on_paper_are_what_the_functions_return():
    seen = lab.height_map(
        np.zeros((1, 2)), np.array([50.0]), np.array([0.0, 30]), np.zeros(1)
    )
    assert seen == pytest.approx(np.array([[50, 40]]))
    side, corner = np.exp(-0.5), np.exp(-1)
    total = 1 + 4 * side + 4 * corner
    words = f"{side:.3f} (sides) and {corner:.3f} (corners). Their sum is {total:.3f}"
    assert words in SENTENCES
    assert f"the middle is {lab.gaussian_kernel(1, 1)[1, 1]:.3f}" in SENTENCES
    assert lab.centroid_error(1, 0.5) == pytest.approx(0.0226, abs=5e-5)
    assert "a blur of 0.5 give 0.0226, or 2.3 % of a pixel" in SENTENCES
    factor = np.exp(-(np.pi**2) / 2)
    assert f"= {-(np.pi**2) / 2:.3f}$" in SENTENCES
    words = f"{100 * np.pi:.1f} mm times {factor:.5f}, which is "
    assert f"{words}{100 * np.pi * factor:.2f} mm" in SENTENCES


def test_the_second_term_of_poissons_sum_is_what_the_guide_says():
    n = np.arange(-30, 31)
    for sigma in (0.3, 0.5):
        g = np.exp(-(n**2) / (2 * sigma**2)) / (sigma * np.sqrt(2 * np.pi))
        rest = g.sum() - 1 - 2 * np.exp(-2 * np.pi**2 * sigma**2)
        second = 2 * np.exp(-8 * np.pi**2 * sigma**2)
        assert rest == pytest.approx(second, rel=0.01, abs=1e-12)
    total = 1 - 2 * np.exp(-8 * np.pi**2 * 0.3**2)
    paper = 1e3 * lab.centroid_error(0.1, 0.03)
    words = f"to {total:.4f}, and {paper:.3f} mm / {total:.4f} is {paper / total:.3f}"
    assert words in SENTENCES
    off = np.abs(lab.sampled_centroid(0.3, lab.FINER // 4))
    assert 1e3 * off == pytest.approx(paper / total, abs=1e-3)


def test_a_mistake_hides_where_the_guide_says():
    rng = np.random.default_rng(0)
    image = rng.normal(size=(7, 7))
    kernel = lab.gaussian_kernel(1.0, 1)
    flipped = lab.conv2d(image, kernel[::-1, ::-1], 2)
    assert np.abs(flipped - lab.conv2d(image, kernel, 2)).max() == 0
    seen = lab.camera(np.array([[0.1, 0.2, 0.03, 0.04]]))
    assert lab.as_centroids(3 * seen) == pytest.approx(lab.as_centroids(seen))
    maps = rng.normal(size=(1, 3, 4))
    at = np.arange(4.0), np.arange(3.0)
    one, two = (lab.spatial_softmax(maps + a, *at, 0.5) for a in (0.0, 7.0))
    assert one == pytest.approx(two)


def test_the_image_of_a_point_is_what_kernel_and_convolution_make():
    fine = pixels.pixel_grid(finer=lab.FINER, margin=24)
    light = np.zeros((len(fine), len(fine)))
    light[60, 70] = 1.0
    seen = lab.conv2d(light, lab.gaussian_kernel(lab.BLUR * lab.FINER, 24), lab.FINER)
    spot = lab.camera(np.array([[fine[70], fine[60], 0, 0]]))[0, 0]
    assert seen / seen.max() == pytest.approx(spot / spot.max(), abs=1e-7)


# What only an author can break.


@pytest.mark.kit
def test_the_opening_is_what_the_lab_prints(printed):
    losses = re.findall(r"loss (0\.\d{3})", printed)
    assert np.array(losses[:2], float) == pytest.approx([0.005, 0.035], abs=0.003)
    assert "Its loss on the training data is 0.005" in SENTENCES
    assert "seven times as large, 0.035" in SENTENCES
    counts = [int(n) for n in re.findall(r"home about +(\d+) of +100", printed)]
    assert counts == pytest.approx([30, 100, 80], abs=10)
    assert "it brings about 30 of 100 pucks home" in SENTENCES
    assert "it brings about 100 of 100 pucks home" in SENTENCES


@pytest.mark.kit
@pytest.mark.parametrize("units", [12, 48, 96])
def test_a_larger_network_does_not_help(units):
    row = re.search(rf"\| {units} units.*?\| ([\d.]+) \| ([\d.]+) \| about (\d+) \|",
                    SENTENCES)  # fmt: skip
    loss, held, came = trained(UNITS=units)
    assert loss == pytest.approx(float(row[1]), abs=0.002)
    assert held == pytest.approx(float(row[2]), abs=0.06)
    assert came == pytest.approx(int(row[3]), abs=8)


@pytest.mark.kit
def test_more_demonstrations_help():
    loss, held, came = trained(DEMOS=300)
    assert "300 demonstrations | 0.016 | 0.20 | about 80 |" in SENTENCES
    assert loss == pytest.approx(0.016, abs=0.002)
    assert held == pytest.approx(0.20, abs=0.05)
    assert came == pytest.approx(80, abs=8)


@pytest.mark.kit
def test_the_same_holds_for_seed_3():
    words = "each of the four networks brings about 20 pucks home, and 300 "
    assert f"With seed 3, {words}demonstrations about 90" in SENTENCES
    assert trained(SEED=3, DEMOS=300)[2] == pytest.approx(90, abs=8)
    assert trained(SEED=3, UNITS=96)[2] == pytest.approx(20, abs=8)


@pytest.mark.kit
def test_a_wider_blur_helps_pixels():
    assert "| pixels, blur 1 | about 60 |" in SENTENCES
    assert trained(blur=1.0)[2] == pytest.approx(60, abs=8)
    alike = []
    for blur in (1.0, 0.5):
        with patch.object(lab, "BLUR", blur):
            at = np.random.default_rng(0).uniform(0, lab.CELL, (400, 4))
            one, two = (lab.as_pixels(lab.camera(at + a)[:, :1]) for a in (0, SHIFT))
        size = np.linalg.norm(one, axis=1) * np.linalg.norm(two, axis=1)
        alike.append(np.mean(np.sum(one * two, axis=1) / size))
    assert "0.94 on average with the wider blur, and 0.78 with" in SENTENCES
    assert alike == pytest.approx([0.94, 0.78], abs=0.01)


def pinholes(seen, offset=0.0):
    """Return the images of observations without blur."""
    points = seen.reshape(-1, 2, 2)
    dx = points[..., 0, None, None] - lab.GRID
    dy = points[..., 1, None, None] - lab.GRID[:, None]
    radii = np.array([day15_mujoco.PUSHER, day15_mujoco.PUCK])[:, None, None]
    return (dx**2 + dy**2 < radii**2).astype(float)


@pytest.mark.kit
def test_pinholes_teach_nothing():
    assert "| pixels, pinholes (no blur) | 0 |" in SENTENCES
    with patch.object(lab, "camera", pinholes):
        images, action, _ = lab.demonstrations()
        policy = lab.Policy(SILENT, "", lab.as_pixels, images, action)
        assert np.sum(policy.tested().home()) <= 2


def plain_pixels():
    """Return the functions of `cloning`, with pixels that are not normalised."""

    def scaler(x):
        plain = np.stack([0 * x[0], 0 * x[0] + 1])
        return plain if x.shape[1] == 288 else cloning.fit_scaler(x)

    names = ("normalise", "denormalise", "mlp", "mse", "mlp_gradient", "fit",
             "random_net", "batches", "cosine_rate")  # fmt: skip
    return SimpleNamespace(
        fit_scaler=scaler, **{name: getattr(cloning, name) for name in names}
    )


@pytest.mark.kit
def test_pixels_that_are_not_normalised_are_worse():
    loss, _, came = trained(cloning=plain_pixels())
    assert "the training loss is 0.108, and about 10 pucks come home" in SENTENCES
    assert loss == pytest.approx(0.108, abs=0.01)
    assert came == pytest.approx(10, abs=6)


@pytest.mark.kit
def test_with_a_wider_blur_the_larger_network_needs_no_normalisation():
    plain = plain_pixels()
    words = "about 40 pucks come home with 24 units, but about 80 with 96 units"
    assert words in SENTENCES
    assert trained(blur=1.0, cloning=plain)[2] == pytest.approx(40, abs=8)
    assert trained(blur=1.0, UNITS=96, cloning=plain)[2] == pytest.approx(80, abs=8)


def unturned(images, action, k):
    """Return rotated images, and the action as it is."""
    return pixels.quarter_turn(images, action, k)[0], action


def mirrored(images, action, k):
    """Return images whose rows are reversed k times, with the rotated action."""
    return images[:, :: (-1) ** k], pixels.quarter_turn(images, action, k)[1]


@pytest.mark.kit
@pytest.mark.parametrize(("change", "loss"), [(unturned, 0.6), (mirrored, 1.0)])
def test_rows_without_the_symmetry_are_worse(change, loss):
    with patch.object(lab, "quarter_turn", change):
        found, _, came = trained(rows=lab.turned_data)
    assert found == pytest.approx(loss, abs=0.05)
    assert came <= 2
    assert "The training loss is 0.6 and 1.0" in SENTENCES


@pytest.mark.kit
def test_a_reflection_is_a_symmetry_of_this_demonstrator():
    def doubled(images, action):
        return (np.concatenate([images, images[:, :, ::-1]]),
                np.concatenate([action, action * [1, -1]]))  # fmt: skip

    came = trained(rows=doubled)[2]
    assert came == pytest.approx(60, abs=8)
    assert "about 60 pucks of 100 come home instead of 30" in SENTENCES
    seen = np.array([[0.1, 0.25, 0.05, 0.2]])
    flip = np.array([1, -1, 1, -1])
    action = day15_mujoco.demonstrator(seen)
    assert day15_mujoco.demonstrator(seen * flip) == pytest.approx(action * [1, -1])
    seen = np.array([[0.02, 0.01, 0.05, 0.2]])  # it has to go around the puck
    left = day15_mujoco.demonstrator(seen, side=np.ones(1))
    other = day15_mujoco.demonstrator(seen * flip, side=np.ones(1))
    assert np.abs(other - left * [1, -1]).max() > 0.01


@pytest.mark.kit
def test_quarter_turns_help_for_another_seed():
    low, high = map(
        int, re.search(r"for seeds 1 to 4 it is (\d+) to (\d+)", SENTENCES).groups()
    )
    gain = trained(rows=lab.turned_data, SEED=3)[2] - trained(SEED=3)[2]
    assert low - 8 <= gain <= high + 8


def uncentred(maps, xs, ys, temperature, d):
    """Return the gradient without the expected value."""
    p = np.exp((maps - maps.max()) / temperature)
    at = d[:, 0, None, None] * xs + d[:, 1, None, None] * ys[:, None]
    return p / p.sum() * at / temperature


def warm(maps, xs, ys, temperature, d):
    """Return the gradient without the factor 1 / temperature."""
    return temperature * pixels.spatial_softmax_gradient(maps, xs, ys, temperature, d)


def flipped(image, kernel, stride):
    """Return the convolution of mathematics."""
    return pixels.conv2d(image, kernel[::-1, ::-1], stride)


def gradient_flipped(image, kernel, stride, d):
    """Return the gradient of the kernel, flipped."""
    of_kernel, of_image = pixels.conv2d_gradient(image, kernel, stride, d)
    return of_kernel[::-1, ::-1], of_image


@pytest.mark.kit
@pytest.mark.parametrize(
    ("row", "change"),
    [
        ("none", {}),
        ("1. not divided by the temperature", {"spatial_softmax_gradient": warm}),
        ("2. both flipped", {"conv2d": flipped, "conv2d_gradient": gradient_flipped}),
        ("3. gradient flipped", {"conv2d_gradient": gradient_flipped}),
        ("4. expected value not subtracted", {"spatial_softmax_gradient": uncentred}),
    ],
)
def test_a_training_shows_some_mistakes(row, change):
    fast = {"conv2d": pixels.conv2d, "conv2d_gradient": pixels.conv2d_gradient}
    with patch.multiple(lab, **fast | change):
        kernel, losses = lab.learned_kernel(SILENT)
        images, places = lab.scenes(np.random.default_rng(lab.STARTS_SEED))
        ends = np.array([lab.found(image, kernel)[1][0] for image in images])
    words = re.search(rf"\| {re.escape(row)} \| ([\d.]+) \| (\d+) \|", SENTENCES)
    assert np.mean(losses[-20:]) == pytest.approx(float(words[1]), abs=0.02)
    off = np.median(np.linalg.norm(ends - places[:, 0], axis=1))
    assert 1e3 * off == pytest.approx(int(words[2]), abs=3)


@pytest.mark.kit
def test_without_its_edge_the_learned_kernel_finds_the_large_sphere():
    kernel, _ = lab.learned_kernel(SILENT)
    kernel[[0, -1]] = kernel[:, [0, -1]] = 0.0
    images, places = lab.scenes(np.random.default_rng(lab.STARTS_SEED))
    ends = np.array([lab.found(image, kernel)[1][0] for image in images])
    off = 1e3 * np.median(np.linalg.norm(ends - places[:, 1], axis=1))
    assert off == pytest.approx(10, abs=1.5)
    assert "with a median error of 10 mm" in SENTENCES


@pytest.mark.kit
def test_the_mean_of_the_end_shows_the_camera():
    images, action, _ = data()
    policy = lab.Policy(SILENT, "", lab.as_centroids, images, action)
    base = lab.ends_of(policy.tested())
    for offset in (-0.01, 0.01):
        run = policy.tested(offset)
        assert lab.ends_of(run) - base == pytest.approx(offset, abs=1e-3)
        assert np.sum(run.home()) > 90


@pytest.mark.kit
def test_seed_1_is_the_least_clear_case_of_the_camera():
    images, action, _ = data(1)
    with patch.object(lab, "SEED", 1):
        policy = lab.Policy(SILENT, "", lab.as_centroids, images, action)
    words = re.search(r"(\d+) pucks come home without an offset, and (\d+) with 10 mm",
                      SENTENCES)  # fmt: skip
    came = [np.sum(policy.tested(offset).home()) for offset in (0.0, 0.01)]
    assert came == pytest.approx([int(n) for n in words.groups()], abs=4)
