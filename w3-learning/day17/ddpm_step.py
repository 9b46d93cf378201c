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
    """beta-for-the-variance: your code uses 1 - abar / prev as the variance. Multiply
      this variance by (1 - prev) / (1 - abar) to obtain the variance of the new sample
      given x and the clean sample
    level-of-prev: your code draws from the distribution given only the clean sample.
      Draw from the distribution given both x and the clean sample instead. The mean of
      this distribution is a weighted sum of x and the clean sample
    as-ddim: your code adds the fresh noise to the result of `ddim_step`. Add this noise
      to the conditional mean of the next sample instead, which is a weighted sum of x
      and the clean sample
    alpha-inverted: your code uses prev / abar as alpha, so alpha is greater than 1. Use
      abar / prev instead, because alpha is the factor by which the data's power falls
      from prev to abar
    alpha-inverted 2: your code uses prev / abar as alpha in both weights, so alpha is
      greater than 1. Use abar / prev instead, because alpha is the factor by which the
      data's power falls from prev to abar
    alpha-inverted 3: your code uses prev / abar as alpha and takes the absolute value
      of the negative variance. Use abar / prev instead, because alpha is the factor by
      which the data's power falls from prev to abar
    eps-of-one-step: your code subtracts sqrt(1 - alpha) * eps from x. Use the factor (1
      - alpha) / sqrt(1 - abar) instead, because eps is the total noise in x and not
      only the noise of this step
    variance-of-prev: your code divides both weights by 1 - prev. Divide both weights by
      1 - abar instead, because 1 - abar is the variance of the innovation
    no-fresh-noise: your function returns the mean without fresh noise. Add the given
      noise, multiplied by the standard deviation
    gain-without-root: your code uses the gain (1 - prev) / (1 - abar). Multiply this
      gain by sqrt(alpha), because the measurement x contains sqrt(alpha) times the
      sample at the level prev
    innovation-at-prev: in the innovation, your code subtracts sqrt(prev) times the
      clean sample from x. Subtract sqrt(abar) times the clean sample instead, because x
      is at the level abar
    variance-without-root: your code uses the variance (1 - prev) * (1 - K), where K is
      the gain. Multiply K by sqrt(alpha), because the measurement x contains
      sqrt(alpha) times the sample at the level prev
    abar-for-alpha: your code uses abar as alpha. Use abar / prev instead, because alpha
      is the factor by which the data's power falls from prev to abar
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
