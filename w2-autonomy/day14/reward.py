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
    """no-cap: your code returns 1 for a height above the cap. Return -1, because the
      cube was thrown
    no-cap 2: your code returns 1 for a height above the cap. Return -1, because the
      cube was thrown
    below-the-floor-is-lost: your code returns -1 for a height below the floor. Return 0
      instead
    nan-passes: your code returns NaN for a height of NaN. Return -1 for every height
      that is not finite, and test the heights with `np.isfinite`
    nan-passes 2: your code returns NaN for a height of NaN, and 0 for a height of minus
      infinity. Test the heights with `np.isfinite`
    nan-is-zero: your code returns 0 for a height of NaN. Return -1, because the
      simulation failed
    infinity-passes: your code returns 0 for a height of minus infinity. Return -1 for
      every height that is not finite
    thrown-is-zero: your code returns 0 for a height above the cap. Return -1, because
      the cube was thrown
    success-only: your code returns 0 for heights between the floor and the target. In
      this range, the reward should rise linearly with the height
    success-only 2: your code returns 0 for heights between the floor and the target. In
      this range, the reward should rise linearly with the height
    not-limited: your code returns a reward above 1 for a height above the target.
      Return 1 instead
    below-the-floor: your code returns a negative reward for a height below the floor.
      Return 0 instead
    thrown-is-minus-cap: your code returns minus the height for a height above the cap.
      Return -1 instead
    cap-for-target: your code divides the height by the cap. Divide it by the target
      instead
    cap-for-target 2: your code divides a height below the target by the cap. Divide it
      by the target instead
    halved: your code returns -1 for a cube on the floor. The reward should rise from 0
      on the floor to 1 at the target
    one-minus: for finite heights up to the cap, your code returns 1 minus the reward.
      Return the reward itself
    nothing-lost: your code omits episodes whose height is not finite or is above the
      cap. Return a reward of -1 for each of these episodes
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
        "below-the-floor-is-lost": lost(share, ~good | (h < 0)),
        "nan-passes": np.where(np.isnan(h), np.nan, right),
        "nan-passes 2": np.where(np.isnan(h), np.nan, np.where(low, 0.0, right)),
        "nan-is-zero": np.where(np.isnan(h), 0.0, right),
        "infinity-passes": np.where(low, 0.0, right),
        "thrown-is-zero": np.where((h > cap) & ~np.isinf(h), 0.0, right),
        "success-only": lost((h >= target).astype(float), ~good),
        "success-only 2": lost((h > target).astype(float), ~good),
        "not-limited": lost(np.maximum(h, 0) / target, ~good),
        "below-the-floor": lost(np.minimum(h, target) / target, ~good),
        "thrown-is-minus-cap": np.where(h > cap, -h, right),
        "cap-for-target": lost(np.clip(h, 0, cap) / cap, ~good),
        "cap-for-target 2": lost(
            np.where(h >= target, 1.0, np.maximum(h, 0) / cap), ~good
        ),
        "halved": lost(2 * share - 1, ~good),
        "one-minus": np.where(good, 1 - share, right),
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
