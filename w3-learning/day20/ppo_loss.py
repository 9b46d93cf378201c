"""20.5 `ppo_loss(logp, old_logp, advantage, clip)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import HeldOut, Row, Scalar, Vector

from .actions import logps


def far(rng):
    """Yield ratios that exceed what exp can represent, with an advantage of 0."""
    for n in (2, 3):
        logp, old = logps(rng, n)
        logp[0] = old[0] + 800.0
        advantage = rng.numbers(0.2, 1, n)
        advantage[0] = 0.0
        yield logp, old, advantage, 0.2


def large(rng):
    """Yield ratios from 20 to 160 000, with a negative advantage."""
    for more in (3.0, 6.0, 12.0):
        logp, old = logps(rng, 3)
        logp[0] = old[0] + more
        advantage = rng.numbers(0.2, 1, 3)
        advantage[0] = -advantage[0]
        yield logp, old, advantage, 0.2


row = Row(
    (Scalar(called="the loss"), Vector((None,), called="the gradient")),
    # On the edge of the range both sides are right.
    at_edge=lambda logp, old_logp, advantage, clip: bool(
        np.all(np.abs(np.abs(np.exp(logp - old_logp) - 1) - clip) > 1e-6)
    ),
    held_out=[
        HeldOut(
            "limited-too-early",
            "Your function is correct for moderate ratios, but your loss is too small "
            "for a large ratio with a negative advantage. The term of such a ratio is "
            "not clipped. Limit logp - old_logp only where exp would overflow, for "
            "example at 600.",
            large,
            relative=True,
        ),
        HeldOut(
            "overflows",
            "Your function is correct for moderate ratios. For a very large ratio, exp "
            "overflows to infinity, and infinity times an advantage of 0 is NaN. Limit "
            "logp - old_logp, for example to 600, before you call exp.",
            far,
        ),
    ],
)


@row.inputs
def _(rng):
    yield np.log([1.5, 0.5]).round(6), np.zeros(2), np.array([1.0, -1]), 0.2
    sides = np.array([0.5, 0.5, -0.6, -0.6, 0.1, -0.1])
    some = rng.permutation(6)
    signs = np.array([1.0, -1, 1, -1, 1, -1]) * rng.numbers(0.3, 2, 6)
    old = rng.numbers(-3, 0, 6)
    yield old + sides[some], old, signs[some], 0.2
    yield old, old, signs, 0.1  # the first update: all ratios are 1
    for n in (1, 3, 4, 5):
        yield *logps(rng, n), rng.numbers(-2, 2, n), float(rng.numbers(0.1, 0.4))
    inside = rng.numbers(-0.1, 0.1, 4)
    yield old[:4] + inside, old[:4], rng.numbers(-2, 2, 4), 0.3
    for sign in (1, -1):
        yield *logps(rng, 4), sign * rng.numbers(0.3, 2, 4), 0.2


def ratios(logp, old_logp):
    """Return the ratios of the probabilities."""
    return np.exp(logp - old_logp)


row.cases(
    a_first_update=lambda logp, old_logp, advantage, clip: (logp == old_logp).all(),
    ratios_inside_the_range=lambda logp, old_logp, advantage, clip: bool(
        (logp != old_logp).any() and (np.abs(ratios(logp, old_logp) - 1) < clip).all()
    ),
    ratios_beyond_the_range=lambda logp, old_logp, advantage, clip: bool(
        (np.abs(ratios(logp, old_logp) - 1) >= clip).any()
    ),
)
row.cases(
    positive_advantages=lambda logp, old_logp, advantage, clip: (advantage > 0).all(),
    negative_advantages=lambda logp, old_logp, advantage, clip: (advantage < 0).all(),
)


@row.rare
def _(rng):
    for sign in (1, -1):
        yield *logps(rng, 3), sign * rng.numbers(0.3, 2, 3), 0.2


@row.wrongs
def _(logp, old_logp, advantage, clip):
    """no-clip: your code does not clip the ratio. Use the minimum of the clipped and
      the unclipped term, so that the new policy stays close to the policy that drew the
      actions
    always-clipped: your loss contains only the clipped term. Use the minimum of the
      clipped and the unclipped term, so that a ratio that has moved in the wrong
      direction is still corrected
    gradient-through-the-clip: your loss is correct, but your gradient ignores the
      clipping. Set the gradient to 0 where the clipped term is smaller, because the
      loss does not depend on logp for these entries
    gradient-clipped: your gradient is 0 for all ratios outside the range from 1 - clip
      to 1 + clip. Set the gradient to 0 only where the clipped term is smaller than the
      unclipped term
    max-for-min: your code uses the maximum of the clipped and the unclipped term. Use
      the minimum instead, so that a ratio that has already moved too far gives no
      further improvement
    ratio-forgotten-in-the-gradient: your gradient is -advantage / n. Multiply this
      gradient by the ratio, because the derivative of the ratio with respect to logp is
      the ratio itself
    ratio-of-logs: your code uses 1 + logp - old_logp as the ratio, which is accurate
      only near 1. Use the ratio of the probabilities, exp(logp - old_logp), instead
    ratio-inverted: your ratio is exp(old_logp - logp). Use exp(logp - old_logp)
      instead, which is the new probability density divided by the old probability
      density
    clip-above-only: your code clips the ratio only at 1 + clip. Clip the ratio at 1 -
      clip as well, because an update with a negative advantage lowers the ratio
    minimum-of-ratios: your code takes the minimum of the clipped and the unclipped
      ratio before it multiplies by the advantage. Multiply both ratios by the advantage
      first, because a negative advantage reverses their order
    minimum-of-ratios 2: your loss contains the product of the advantage and the minimum
      of the clipped and the unclipped ratio. Multiply both ratios by the advantage
      first, because a negative advantage reverses their order
    minimum-for-a-negative-advantage: your code uses the minimum of the ratio and 1 -
      clip for a negative advantage. Use the maximum instead, because the larger ratio
      has the smaller product with a negative advantage
    product-clipped: your code limits the product of the ratio and the advantage to the
      range from 1 - clip to 1 + clip. Limit the ratio first, and then multiply by the
      advantage
    logs-clipped: your code limits logp - old_logp to the range from -clip to clip.
      Limit the ratio exp(logp - old_logp) to the range from 1 - clip to 1 + clip
      instead
    lower-end-inverted: your code uses 1 / (1 + clip) as the lower end of the range. Use
      1 - clip instead
    sign: your loss and gradient have the wrong sign. A loss is minimised, so negate
      both the loss and the gradient
    summed: your loss is the sum over the actions. Divide the loss and the gradient by
      the number of actions
    """
    n = len(logp)

    def both(r, low=1 - clip, high=1 + clip, least=np.minimum):
        plain, cut = r * advantage, np.clip(r, low, high) * advantage
        kept = least(plain, cut) == plain
        return -np.mean(least(plain, cut)), np.where(kept, -plain / n, 0)

    r = ratios(logp, old_logp)
    right = both(r)
    free = r * advantage
    inside = np.abs(r - 1) <= clip
    of_cut = np.mean(np.clip(r, 1 - clip, 1 + clip) * advantage)
    linear = 1 + logp - old_logp
    at_most = np.minimum(r, np.where(advantage >= 0, 1 + clip, 1 - clip))
    low, high = np.exp(-clip), np.exp(clip)
    least = np.minimum(r, 1 + clip)
    kept = right[1] != 0
    return {
        "no-clip": (-np.mean(free), -free / n),
        "always-clipped": (-of_cut, np.where(inside, -free / n, 0)),
        "gradient-through-the-clip": (right[0], -free / n),
        "gradient-clipped": (right[0], np.where(inside, -free / n, 0)),
        "max-for-min": both(r, least=np.maximum),
        "ratio-forgotten-in-the-gradient": (
            right[0],
            np.where(kept, -advantage / n, 0),
        ),
        "ratio-of-logs": both(linear),
        "ratio-inverted": both(1 / r),
        "clip-above-only": both(r, low=-np.inf),
        "minimum-of-ratios": (
            -np.mean(least * advantage),
            np.where(r <= 1 + clip, -free / n, 0),
        ),
        "minimum-of-ratios 2": (
            -np.mean(np.minimum(r, np.clip(r, 1 - clip, 1 + clip)) * advantage),
            right[1],
        ),
        "minimum-for-a-negative-advantage": (
            -np.mean(at_most * advantage),
            np.where(at_most == r, -free / n, 0),
        ),
        "product-clipped": (
            -np.mean(np.minimum(free, np.clip(free, 1 - clip, 1 + clip))),
            np.where(free <= 1 + clip, -free / n, 0),
        ),
        "logs-clipped": both(r, low, high),
        "lower-end-inverted": both(r, 1 / (1 + clip)),
        "sign": (-right[0], -right[1]),
        "summed": (n * right[0], n * right[1]),
    }


@row.right  # By cases on the sign of the advantage.
def _(logp, old_logp, advantage, clip):
    loss, slope = 0.0, np.zeros(len(logp))
    for i, A in enumerate(advantage):
        r = np.exp(min(logp[i] - old_logp[i], 500.0))
        used = min(r, 1 + clip) if A >= 0 else max(r, 1 - clip)
        loss -= used * A / len(logp)
        slope[i] = -r * A / len(logp) if used == r else 0.0
    return loss, slope


@row.right  # As in Spinning Up: the limit is (1 + clip) A or (1 - clip) A.
def _(logp, old_logp, advantage, clip):
    r = np.exp(np.clip(logp - old_logp, -500, 500))
    limit = np.where(advantage > 0, (1 + clip) * advantage, (1 - clip) * advantage)
    objective = np.minimum(r * advantage, limit)
    return -objective.mean(), -r * advantage * (r * advantage <= limit) / len(r)


@row.spans
def _(rng):
    for size in (1e-3, 1e3):
        logp, old = logps(rng, 8)
        yield 12 + logp, 12 + old, size * rng.numbers(-1, 1, 8), 0.2


row.at_least_0(clip="half the width of a range")
