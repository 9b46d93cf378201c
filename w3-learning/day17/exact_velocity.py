"""17.9 `exact_velocity(x, t, means, sigma, weights)`: its questions and mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .modes import (
    TWO,
    asked,
    cases,
    posterior,
    posterior_of,
    wrong_probabilities,
)

row = Row(Matrix((None, None)))


@row.inputs
def _(rng):
    yield from asked(rng, 0.5, 0.8)


cases(row)
row.at_least_0(t="from 0 to 1", sigma="a standard deviation", weights="probabilities")


@row.wrongs(
    hidden={
        "per-coordinate": "the lab's mixture has one dimension",
        "overflow 4": "the lab compares two results that are both 0",
        "overflow 5": "the lab compares two results that are both 0",
        "division-by-0": "the lab's last step begins before t = 1",
    }
)
def _(x, t, means, sigma, weights):
    """data-width-forgotten: your code uses (1 - t)^2 as the variance of x in each mode.
      Use t^2 * sigma^2 + (1 - t)^2 instead, because the data in a mode have the
      variance sigma^2
    data-width-forgotten 2: your code uses the variance (1 - t)^2 in the exponent. Use
      t^2 * sigma^2 + (1 - t)^2 instead, which is the variance of x in each mode
    x-not-deviation: your code multiplies x by covariance / variance, as if the mean of
      x were 0. Multiply x - t * mu by this factor instead, where mu is the mean of the
      mode
    distance-so-far: your function returns the mean displacement from the noise to x.
      Return the mean velocity instead, which is the mean of `data - noise` given x
    division-by-0 2: your code divides by t, which is 0 at t = 0. Use the formula for
      the conditional mean instead, which divides only by the variance of x in each mode
    nearest-mode: for each row of x, your code uses only the nearest mode. Return the
      mean velocity over all modes, weighted by the probabilities of the modes given x
    nearest-mode 2: your code assigns each row only to its most probable mode. Return
      the mean velocity over all modes, weighted by the probabilities of the modes given
      x
    weights-only: your code uses the weights of the modes as their probabilities given
      x. Multiply each weight by the density of its mode at x, and normalise the
      products
    clean: your function returns the mean of the data given x. Return the mean of `data
      - noise` given x instead
    minus-x: your function returns the mean displacement from x to the data. Return the
      mean velocity instead, which is the mean of `data - noise` given x
    covariance-squared: your code uses t^2 * sigma^2 - (1 - t)^2 as the covariance of x
      and the velocity. Use t * sigma^2 - (1 - t) instead, because the velocity is `data
      - noise`
    variance-not-squared: your code uses t * sigma^2 + 1 - t as the variance of x in
      each mode. Use t^2 * sigma^2 + (1 - t)^2 instead, because the variance contains
      the squares of the factors of data and noise
    noisy-means: your code uses t * mu as the mean of the velocity in a mode, where mu
      is the mean of the mode. Use mu instead, because the mean of the noise is 0
    division-by-0: your code divides by 1 - t, which is 0 at t = 1. Use the formula for
      the conditional mean instead, which divides only by the variance of x in each mode
    means-only: your code uses the mean mu of a mode as the velocity in this mode. Add
      (x - t * mu) * covariance / variance, because the velocity also depends on x
    time-reversed: your code uses the factor 1 - t for the data and t for the noise.
      Swap these factors, because x is the noise at t = 0 and the data at t = 1
    diffusion-roots: your code uses the factor sqrt(t) for the data and sqrt(1 - t) for
      the noise, as in diffusion. Use t and 1 - t instead, as in `flow_pair`
    overflow: your function returns NaN for a row far from all modes, because the
      densities of all modes underflow to 0. Subtract the largest exponent of each row
      before you call exp
    overflow 2: your code subtracts the same number from the exponents of all rows.
      Subtract the largest exponent of each row from the exponents of that row instead,
      because otherwise a row far from all modes gives 0 / 0
    over-all-rows: your code normalises the probabilities over all rows together.
      Normalise each row separately, so that the probabilities of each row sum to 1
    over-all-rows 2: your code normalises the probabilities over all rows together.
      Normalise each row separately, so that the probabilities of each row sum to 1
    per-coordinate: your code computes separate probabilities for each coordinate of a
      row. In the exponent, sum the squared deviations over the coordinates, because all
      coordinates of a row belong to the same mode
    overflow 3: for each mode, your code subtracts the largest exponent over all rows,
      which changes the probabilities. For each row, subtract the largest exponent over
      all modes instead
    overflow 4: your function returns 0 for a row far from all modes, because the
      densities of all modes underflow to 0. Subtract the largest exponent of each row
      before you call exp
    overflow 5: your code adds a small number to the sum of the densities, so all
      probabilities are 0 for a row far from all modes. Subtract the largest exponent of
      each row before you call exp instead
    """
    given = x, t, 1 - t, means, sigma, weights

    def data(prob, off, variance, keep=t):  # the mean of the data
        return np.sum(prob * (means + keep * sigma**2 / variance * off), axis=1)

    def velocity(prob, off, variance, keep=t, lose=1 - t):
        slope = (keep * sigma**2 - lose) / variance
        return np.sum(prob * (means + slope * off), axis=1)

    prob, off, variance = posterior(*given)
    others = wrong_probabilities(off, variance, weights)
    clean = data(prob, off, variance)
    right = velocity(prob, off, variance)
    squared = t**2 * sigma**2 - (1 - t) ** 2
    linear = t * sigma**2 + 1 - t
    roots = np.sqrt(t), np.sqrt(1 - t)
    rooted = posterior(x, *roots, means, sigma, weights)
    back = posterior(x, 1 - t, t, means, sigma, weights)
    return {
        # Without the data's width the variance is 0 at t = 1.
        "data-width-forgotten": lambda: velocity(*posterior(*given, wide=False)),
        "clean": clean,
        "minus-x": clean - x,
        "distance-so-far": t * right,
        "division-by-0 2": right if t else np.nan * x,
        "data-width-forgotten 2": lambda: velocity(
            posterior(*given, wide=False)[0], off, variance
        ),
        "x-not-deviation": np.sum(prob * means, 1)
        + (t * sigma**2 - 1 + t) / variance * x,
        "covariance-squared": np.sum(prob * (means + squared / variance * off), axis=1),
        "variance-not-squared": velocity(
            posterior_of(off, linear, weights), off, linear
        ),
        "noisy-means": right - (1 - t) * np.sum(prob * means, 1),
        "division-by-0": (clean - x) / (1 - t) if t < 1 else np.nan * x,
        "means-only": np.sum(prob * means, axis=1),
        "time-reversed": velocity(*back, 1 - t, t),
        "diffusion-roots": velocity(*rooted, *roots),
        **{name: velocity(prob, off, variance) for name, prob in others.items()},
    }


@row.right  # From the mean of the data: the distance over the remaining time.
def _(x, t, means, sigma, weights):
    v = (t * sigma) ** 2 + (1 - t) ** 2
    logs = np.log(weights) - ((x[:, None] - t * means) ** 2).sum(-1) / (2 * v)
    prob = np.exp(logs - logs.max(axis=1)[:, None])
    prob /= prob.sum(axis=1)[:, None]
    centre = prob @ means
    data = centre + t * sigma**2 / v * (x - t * centre)
    noise = (1 - t) / v * (x - t * centre)
    return data - noise


@row.right  # Mode by mode, with the covariance of x and the velocity.
def _(x, t, means, sigma, weights):
    variance = t * t * sigma * sigma + (1 - t) * (1 - t)
    covariance = t * sigma * sigma - 1 + t
    squares = [((x - t * m) ** 2).sum(axis=1) for m in means]
    least = np.min(squares, axis=0)
    total = np.zeros(x.shape)
    parts = np.zeros((len(x), 1))
    for m, w, square in zip(means, weights, squares):
        p = (w * np.exp((least - square) / (2 * variance)))[:, None]
        total += p * (m + covariance / variance * (x - t * m))
        parts += p
    return total / parts


@row.spans
def _(rng):
    yield np.array([[-3.0], [4.0]]), 0.01, TWO, 0.1, np.array([0.3, 0.7])
    yield np.array([[-1.0], [0.7]]), 0.99, TWO, 0.1, np.array([0.3, 0.7])
