"""17.9 `exact_velocity(x, t, means, sigma, weights)`: its questions and mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .modes import mixtures, posterior, posterior_of, wrong_probabilities

row = Row(Matrix((None, None)))
TWO = np.array([[-1.0], [1]])


@row.inputs
def _(rng):
    yield np.array([[0.5]]), 0.5, TWO, 0.1, np.array([0.5, 0.5])
    for x, means, sigma, weights in mixtures(rng):
        yield x, float(rng.numbers(0.1, 0.9)), means, sigma, weights
    x, means, sigma, weights = next(mixtures(rng))
    yield x, 0.0, means, sigma, weights
    yield x, 1.0, means, sigma, weights
    yield x, 0.5, means, 0.0, weights
    yield 40 * x, 0.8, means, sigma, weights  # far from all modes


row.cases(
    one_mode=lambda x, t, means, *_: len(means) == 1,
    several_modes=lambda x, t, means, *_: len(means) > 1,
)
row.cases(
    equal_weights=lambda *given: bool(np.ptp(given[-1]) == 0),
    different_weights=lambda *given: bool(np.ptp(given[-1]) > 0),
)


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
    """data-width-forgotten: in your code, the variance of x in a mode is (1 - t)^2. The
      data have a width as well, so it is t^2 sigma^2 + (1 - t)^2
    data-width-forgotten 2: the variance in your exponent is (1 - t)^2. The data have a
      width as well, so it is t^2 sigma^2 + (1 - t)^2, as in the slope
    x-not-deviation: your code multiplies x itself by the slope. Multiply the deviation
      of x from the mean of x in each mode
    distance-so-far: your result is x minus the mean of the noise, the distance that is
      covered. The velocity is this distance divided by the time t
    division-by-0 2: your code divides by t, which is 0 at the start. Use the slope of
      the velocity, the covariance divided by the variance of x
    nearest-mode: in your code, each row belongs to its nearest mode alone. Take the
      mean over all modes, weighted with their probabilities given x
    nearest-mode 2: in your code, each row belongs to its most probable mode alone. Take
      the mean over all modes, weighted with their probabilities given x
    weights-only: in your code, the probability of a mode does not depend on x. Multiply
      its weight by its density at x and normalise
    clean: your result is the mean of the data given x. Return the mean of data - noise
    minus-x: your result is the mean of the data minus x, the distance that is left. The
      velocity is this distance divided by the remaining time 1 - t
    covariance-squared: your covariance of x and the velocity has the squares of t and
      1 - t, as the variance of x. It has their first powers: t sigma^2 - (1 - t)
    variance-not-squared: your variance of x is t sigma^2 + 1 - t. A factor acts on the
      variance by its square, so it is t^2 sigma^2 + (1 - t)^2
    noisy-means: your velocity in a mode contains t times the mode's mean, which is the
      mean of x. The mean of the velocity is the mode's mean itself
    division-by-0: your code divides by 1 - t, which is 0 at t = 1. Use the slope of the
      velocity, the covariance divided by the variance of x
    means-only: your velocity in a mode is the mode's mean. It also depends on the
      distance of x from t times this mean
    time-reversed: in your code, t runs from the data to the noise. In this lab it runs
      from the noise at t = 0 to the data at t = 1
    diffusion-roots: your factors of data and noise are sqrt(t) and sqrt(1 - t), as in
      diffusion. In flow matching they are t and 1 - t
    overflow: all densities of a row far from the modes are 0 in your code, and 0 / 0 is
      NaN. Subtract the row's largest exponent before you call exp
    overflow 2: in your code, one number is subtracted from the exponents of all rows.
      Subtract each row's own largest exponent, or a row far from the modes gives 0 / 0
    over-all-rows: your probabilities add up to 1 over all rows together. Each row has
      probabilities of its own, so divide by the row's sum
    over-all-rows 2: your probabilities add up to 1 over all rows together. Each row has
      probabilities of its own, so divide by the row's sum
    per-coordinate: in your code, each coordinate of a row has probabilities of its own.
      A row belongs to one mode: sum the squares over the coordinates in the exponent
    overflow 3: in your code, the largest exponent of each mode over all rows is
      subtracted, which changes the probabilities. Subtract each row's largest exponent
    overflow 4: your velocity is 0 far from all modes, because every density is 0 there
      in floating-point numbers. Subtract the row's largest exponent before you call exp
    overflow 5: your code adds a small number to the sum of the densities, so far from
      all modes, where every density is 0, every probability is 0 as well. Subtract the
      row's largest exponent before you call exp
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
        "data-width-forgotten": velocity(*posterior(*given, wide=False)),
        "clean": clean,
        "minus-x": clean - x,
        "distance-so-far": t * right,
        "division-by-0 2": right if t else np.nan * x,
        "data-width-forgotten 2": velocity(
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
