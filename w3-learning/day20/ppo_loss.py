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


row = Row(
    (Scalar(called="the loss"), Vector((None,), called="the gradient")),
    # On the edge of the range both sides are right.
    at_edge=lambda logp, old_logp, advantage, clip: bool(
        np.all(np.abs(np.abs(np.exp(logp - old_logp) - 1) - clip) > 1e-6)
    ),
    held_out=[
        HeldOut(
            "overflows",
            "Your function is right for moderate ratios. For a very large one exp "
            "overflows to infinity, and infinity times an advantage of 0 is NaN. Limit "
            "the exponent before exp.",
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


@row.wrongs
def _(logp, old_logp, advantage, clip):
    """no-clip: your code does not clip. Without it nothing keeps the new policy close
      to the policy that drew the data
    always-clipped: your loss uses the clipped ratio only. Use the minimum of both
      terms, so that a ratio which went in the wrong direction is still pulled back
    gradient-through-the-clip: your loss is right, but its gradient ignores the clip.
      Where the clipped term is smaller, the loss does not depend on logp
    gradient-clipped: your gradient is 0 for all ratios beyond the range. It is 0 only
      where the clipped term is the smaller one
    max-for-min: your code uses the maximum of both terms. The minimum is pessimistic:
      it gives no reward for a ratio that has gone too far
    ratio-forgotten-in-the-gradient: your gradient is -A / n. The derivative of the
      ratio with respect to logp is the ratio itself
    ratio-of-logs: your code uses logp - old_logp, or 1 plus it, as the ratio. The ratio
      of the probabilities is exp(logp - old_logp)
    ratio-inverted: your ratio is exp(old_logp - logp). Divide the new probability by
      the old one
    clip-above-only: your code clips at 1 + clip only. With a negative advantage, a
      ratio below 1 - clip has gone far enough as well
    sign: your loss and gradient have the wrong sign. A loss is minimised, so it is
      minus the mean
    summed: your loss is a sum. Divide loss and gradient by the number of actions
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
