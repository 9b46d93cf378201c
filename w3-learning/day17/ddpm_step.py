"""17.5 `ddpm_step(x, eps, abar, prev, noise)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .steps import steps

row = Row(Matrix((None, None)))


@row.inputs
def _(rng):
    one = np.ones((1, 1))
    yield one, 0.5 * one, 0.36, 0.64, 0 * one
    yield one, 0.5 * one, 0.36, 0.64, one
    for x, *others in steps(rng):
        yield x, *others, rng.numbers(-2, 2, *x.shape)
    for x, *others in list(steps(rng))[:2]:
        yield x, *others, 0 * x


row.cases(
    the_last_step=lambda x, eps, abar, prev, noise: prev == 1,
    earlier_steps=lambda x, eps, abar, prev, noise: prev < 1,
)
row.cases(
    no_fresh_noise=lambda x, eps, abar, prev, noise: not noise.any(),
    fresh_noise=lambda x, eps, abar, prev, noise: bool(noise.any()),
)


row.at_least_0(abar="a fraction", prev="a fraction")


@row.wrongs
def _(x, eps, abar, prev, noise):
    """beta-for-the-variance: your variance is 1 - abar / prev. Given the clean sample
      it is smaller: multiply it by (1 - prev) / (1 - abar)
    level-of-prev: your result is a sample at the level prev with fresh noise only.
      Given x, its mean also contains x, and its variance is smaller
    as-ddim: your result contains the noise eps again, as `ddim_step` does, and fresh
      noise. The mean is a weighted sum of the clean sample and x
    alpha-inverted: your alpha is prev / abar, which is above 1. From prev to abar the
      signal becomes weaker, so alpha is abar / prev
    abar-for-alpha: your alpha is abar. A single step keeps the fraction abar / prev
    """
    keep, lose = np.sqrt(abar), np.sqrt(1 - abar)
    clean = (x - lose * eps) / keep
    alpha = abar / prev
    beta = 1 - alpha
    of_clean = np.sqrt(prev) * beta / (1 - abar)
    of_x = np.sqrt(alpha) * (1 - prev) / (1 - abar)
    variance = (1 - prev) * beta / (1 - abar)
    mean = of_clean * clean + of_x * x
    fresh = np.sqrt(variance) * noise

    def plain(alpha):  # the usual form, with eps
        mean = (x - (1 - alpha) / lose * eps) / np.sqrt(alpha)
        return mean + np.sqrt((1 - prev) * (1 - alpha) / (1 - abar)) * noise

    return {
        "beta-for-the-variance": mean + np.sqrt(beta) * noise,
        "level-of-prev": np.sqrt(prev) * clean + np.sqrt(1 - prev) * noise,
        "as-ddim": np.sqrt(prev) * clean + np.sqrt(1 - prev) * eps + fresh,
        "alpha-inverted": plain(prev / abar),
        "abar-for-alpha": plain(abar),
    }


@row.right  # In the form with eps, as Ho and others write it.
def _(x, eps, abar, prev, noise):
    alpha = abar / prev
    mean = (x - (1 - alpha) / np.sqrt(1 - abar) * eps) / np.sqrt(alpha)
    return mean + np.sqrt((1 - prev) / (1 - abar) * (1 - alpha)) * noise


@row.right  # As DDIM with a part of the noise replaced.
def _(x, eps, abar, prev, noise):
    variance = (1 - prev) / (1 - abar) * (1 - abar / prev)
    clean = (x - np.sqrt(1 - abar) * eps) / np.sqrt(abar)
    kept = np.sqrt(np.maximum(1 - prev - variance, 0))
    return np.sqrt(prev) * clean + kept * eps + np.sqrt(variance) * noise


@row.right  # By Bayes' rule, with precisions.
def _(x, eps, abar, prev, noise):
    clean = (x - np.sqrt(1 - abar) * eps) / np.sqrt(abar)
    if prev == 1:
        return clean
    alpha = abar / prev
    first, second = alpha / (1 - alpha), 1 / (1 - prev)
    mean = x / np.sqrt(alpha) * first + np.sqrt(prev) * clean * second
    return (mean + np.sqrt(first + second) * noise) / (first + second)


@row.spans
def _(rng):
    x, eps, noise = rng.numbers(-1, 1, 3, 3, 2)
    yield x, eps, 2e-7, 0.0002, noise
    yield 3 * x, eps, 0.9996, 1.0, 3 * noise
