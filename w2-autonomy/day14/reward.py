"""14.6 `reward(heights, target, cap)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.policy import reward

row = Row(
    Vector((None,)),
    at_edge=lambda heights, target, cap: 0 < target < cap,
)


@row.inputs
def _(rng):
    yield np.array([0.01, 0.05, 0.2, 0.9, np.nan, -0.01]), 0.05, 0.3
    yield np.array([0.01, 0.02, 0.03, 0.04]), 0.05, 0.3
    yield np.array([0.3, 0.02, 0.04]), 0.05, 0.3  # as high as the cap is not above it
    yield np.array([np.inf, 0.03, -np.inf, np.nan, 0.31]), 0.04, 0.3
    yield np.array([-0.7, 0.06, 0.02]), 0.1, 0.25
    yield np.array([-0.2, -0.01, 0.0, 0.07]), 0.1, 0.25
    for n in (3, 5, 8, 8):
        heights = rng.numbers(-0.03, 0.5, n)
        target = float(rng.numbers(0.02, 0.12))
        if n == 8:
            heights[rng.integers(n)] = np.nan
        yield heights, target, float(rng.numbers(0.2, 0.4))


@row.spans
def _(rng):
    yield np.array([2e-4, 9e-4, 0.05, 0.3]), 0.05, 0.3  # the target and the cap, too
    yield np.array([2e-4, 1e-3, 40.0, 1e3]), 40.0, 1e3


@row.wrongs
def _(heights, target, cap):
    """no-cap: what is above the cap is worth 1; it was thrown, so it is worth -1
    no-cap 2: what is above the cap is worth 1; it was thrown, so it is worth -1
    size-against-the-cap: the height's size is compared with the cap; what is far below
      the floor was not thrown, and is worth 0
    below-the-floor-is-lost: what is below the floor counts as lost; it is worth 0
    nan-passes: a NaN stays a NaN: no comparison with it is True, so ask np.isfinite
    nan-is-zero: a NaN is worth 0; a simulation that was lost is worth -1
    infinity-passes: minus infinity is worth 0; what is no finite number is worth -1
    success-only: it is 1 at the target and 0 below; half of the way is worth half
    success-only 2: it is 1 above the target and 0 below; half of the way is worth half
    not-divided: the height is not divided by the target, so a cube at the target is
      worth so many metres
    not-limited: more than the target is worth more than 1
    below-the-floor: what is below the floor is worth less than 0
    thrown-is-zero: what was thrown or lost is worth 0, as on the floor; it is -1
    thrown-is-minus-cap: what was thrown is worth minus its height; it is -1
    cap-for-target: the cap is taken for the target
    cap-for-target 2: below the target the height is divided by the cap; the target
      divides it, so that half of the way is worth half
    target-for-cap: the target is taken for the cap: what is above it was thrown
    at-the-cap: what is as high as the cap counts as thrown; only what is above it does
    halved: the worth of the floor is -1; it is 0
    one-minus: it is 1 minus that: how much is missing
    squared: it is squared; half of the way is worth half
    nothing-lost: NaN and what is above the cap are taken out; each episode has a worth
    """
    h = heights
    good = np.isfinite(h) & (h <= cap)
    share = np.clip(h, 0, target) / target
    right = reward(heights, target, cap)

    def lost(worth, where):
        return np.where(where, -1.0, worth)

    low = np.isneginf(h)
    return {
        "no-cap": lost(share, ~np.isfinite(h) & ~np.isposinf(h)),
        "no-cap 2": lost(share, ~np.isfinite(h)),
        "size-against-the-cap": lost(share, ~(np.isfinite(h) & (np.abs(h) <= cap))),
        "below-the-floor-is-lost": lost(share, ~good | (h < 0)),
        "nan-passes": np.where(np.isnan(h), np.nan, right),
        "nan-is-zero": np.where(np.isnan(h), 0.0, right),
        "infinity-passes": np.where(low, 0.0, right),
        "success-only": lost((h >= target).astype(float), ~good),
        "success-only 2": lost((h > target).astype(float), ~good),
        "not-divided": lost(np.clip(h, 0, target), ~good),
        "not-limited": lost(np.maximum(h, 0) / target, ~good),
        "below-the-floor": lost(np.minimum(h, target) / target, ~good),
        "thrown-is-zero": np.where(good, share, 0.0),
        "thrown-is-minus-cap": np.where(h > cap, -h, right),
        "cap-for-target": lost(np.clip(h, 0, cap) / cap, ~good),
        "cap-for-target 2": lost(
            np.where(h >= target, 1.0, np.maximum(h, 0) / cap), ~good
        ),
        "target-for-cap": lost(share, ~(np.isfinite(h) & (h <= target))),
        "at-the-cap": lost(share, ~(np.isfinite(h) & (h < cap))),
        "halved": lost(2 * share - 1, ~good),
        "one-minus": np.where(good, 1 - share, right),
        "squared": lost(share**2, ~good),
        "nothing-lost": share[good],
    }


row.at_least_0(target="a height", cap="a height")


@row.right  # A loop with a condition for each case.
def _(heights, target, cap):
    worth = []
    for h in heights:
        if np.isnan(h) or abs(h) == np.inf or h > cap:
            worth.append(-1.0)
        elif h <= 0:
            worth.append(0.0)
        else:
            worth.append(min(h / target, 1.0))
    return np.array(worth)


@row.wrong(
    "not-at-every-size", hidden="the numbers of the lab stay within its limits"
)  # Under 1 mm it lies on the floor.
def _(heights, target, cap):
    worth = np.clip(np.where(heights < 1e-3, 0.0, heights), 0, target) / target
    return np.where(np.isfinite(heights) & (heights <= cap), worth, -1.0)
