"""17.4 `ddim_step(x, eps, abar, prev)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .steps import steps

row = Row(Matrix((None, None)))


@row.inputs
def _(rng):
    yield np.array([[1.0]]), np.array([[0.5]]), 0.36, 0.64
    yield from steps(rng)
    yield rng.numbers(-2, 2, 2, 2), np.zeros((2, 2)), 0.3, 0.5


row.cases(
    the_last_step=lambda x, eps, abar, prev: prev == 1,
    earlier_steps=lambda x, eps, abar, prev: prev < 1,
)


row.at_least_0(abar="a fraction", prev="a fraction")


@row.wrongs
def _(x, eps, abar, prev):
    """noise-not-put-back: your function returns sqrt(prev) times the clean samples. Add
      sqrt(1 - prev) * eps, because samples at the level prev also contain noise
    clean-returned: your function returns the clean samples. Multiply these samples by
      sqrt(prev) and add sqrt(1 - prev) * eps, because samples at the level prev also
      contain noise
    prev-not-rooted: your code multiplies the clean samples by prev and eps by 1 - prev.
      Use the square roots of these factors instead, because prev is a fraction of the
      power, and the power is proportional to the square of the amplitude
    clipped-at-1: your code clamps the clean samples to the interval from -1 to 1, as
      for images. Omit this clamp, because the data may lie outside this interval
    ddpm-mean: your function returns the mean of a random step (task 17.5). For a
      deterministic step, multiply the clean samples by sqrt(prev) and add sqrt(1 -
      prev) * eps
    last-step-skipped: your function returns x for prev = 1. Return the clean samples
      instead, because the last step removes all the noise
    """
    keep, lose = np.sqrt(abar), np.sqrt(1 - abar)
    back, rest = np.sqrt(prev), np.sqrt(1 - prev)
    clean = (x - lose * eps) / keep
    alpha = abar / prev
    return {
        "noise-not-put-back": back * clean,
        "clean-returned": clean,
        "prev-not-rooted": prev * clean + (1 - prev) * eps,
        "clipped-at-1": back * np.clip(clean, -1, 1) + rest * eps,
        "ddpm-mean": (x - (1 - alpha) / lose * eps) / np.sqrt(alpha),
        "last-step-skipped": back * clean + rest * eps if prev < 1 else x,
    }


@row.right  # As a rotation by the difference of two angles.
def _(x, eps, abar, prev):
    before = np.arccos(np.sqrt(abar))
    after = np.arccos(np.sqrt(prev))
    across = (x * np.sin(before) - eps) / np.cos(before)  # the direction of less noise
    step = before - after
    return x * np.cos(step) + across * np.sin(step)


@row.right  # With the ratio of the levels.
def _(x, eps, abar, prev):
    grow = np.sqrt(prev / abar)
    return grow * x + (np.sqrt(1 - prev) - grow * np.sqrt(1 - abar)) * eps


@row.spans
def _(rng):
    x, eps = rng.numbers(-1, 1, 2, 3, 2)
    yield x, eps, 2e-7, 0.0002
    yield 3 * x, 20 * eps, 0.9996, 1.0
    yield 0.1 * x, eps, 0.4, 0.7
