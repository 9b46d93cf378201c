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
    alpha-inverted 2: your two weights use alpha = prev / abar, a number above 1. From
      prev to abar the signal becomes weaker, so alpha is abar / prev
    alpha-inverted 3: your alpha is prev / abar, so the variance would be negative, and
      you take its absolute value. From prev to abar the signal becomes weaker, so alpha
      is abar / prev
    eps-of-one-step: your mean subtracts sqrt(1 - alpha) eps from x. eps is the noise of
      all levels up to abar, so its factor is (1 - alpha) / sqrt(1 - abar)
    variance-of-prev: your weights are divided by 1 - prev. Divide them by the variance
      of the innovation, 1 - abar
    no-fresh-noise: your result is the mean. Add the given noise times the standard
      deviation
    gain-without-root: your gain is (1 - prev) / (1 - abar). The measurement x contains
      sqrt(alpha) times the sample, so the gain also has the factor sqrt(alpha)
    innovation-at-prev: your code subtracts sqrt(prev) times the clean sample from x.
      The measurement x is at the level abar, so subtract sqrt(abar) times the clean
      sample
    variance-without-root: your variance is (1 - prev) (1 - K). The measurement contains
      sqrt(alpha) times the sample, so the variance is (1 - prev) (1 - K sqrt(alpha))
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

    def inverted(variance):  # the weights of the clean sample and of x
        up = prev / abar
        of_both = np.sqrt(prev) * (1 - up) * clean + np.sqrt(up) * (1 - prev) * x
        return of_both / (1 - abar) + np.sqrt(variance) * noise

    gain = (1 - prev) / (1 - abar)
    first, root = np.sqrt(prev) * clean, np.sqrt(alpha)
    no_root = np.sqrt((1 - prev) * (1 - gain * root))
    up = (1 - prev) * (1 - prev / abar) / (1 - abar)
    return {
        "alpha-inverted 2": inverted(up),
        "alpha-inverted 3": inverted(-up),
        "eps-of-one-step": (x - np.sqrt(beta) * eps) / root + fresh,
        "variance-of-prev": mean / gain + fresh if prev < 1 else np.nan * x,
        "no-fresh-noise": mean,
        "gain-without-root": first + gain * (x - keep * clean) + no_root * noise,
        "innovation-at-prev": first + gain * root * (x - first) + fresh,
        "variance-without-root": mean + no_root * noise,
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
