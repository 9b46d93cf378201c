"""17.3 `exact_noise(x, abar, means, sigma, weights)`: its questions and mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .modes import mixtures, posterior, wrong_probabilities

row = Row(
    Matrix((None, None)),
    # The root of 1 - abar has no derivative at 1.
    at_edge=lambda x, abar, means, sigma, weights: abar < 1,
)
TWO = np.array([[-1.0], [1]])


@row.inputs
def _(rng):
    yield np.array([[0.5]]), 0.36, TWO, 0.1, np.array([0.5, 0.5])
    for x, means, sigma, weights in mixtures(rng):
        yield x, float(rng.numbers(0.1, 0.9)), means, sigma, weights
    x, means, sigma, weights = next(mixtures(rng))
    yield x, 0.0, means, sigma, weights
    yield x, 1.0, means, sigma, weights
    yield x, 0.5, means, 0.0, weights
    yield 40 * x, 0.9, means, sigma, weights  # far from all modes


row.cases(
    one_mode=lambda x, abar, means, *_: len(means) == 1,
    several_modes=lambda x, abar, means, *_: len(means) > 1,
)
row.cases(
    equal_weights=lambda *given: bool(np.ptp(given[-1]) == 0),
    different_weights=lambda *given: bool(np.ptp(given[-1]) > 0),
)


row.at_least_0(abar="a fraction", sigma="a standard deviation", weights="probabilities")


@row.wrongs(
    hidden={
        "per-coordinate": "the lab's mixture has one dimension",
        "overflow 4": "the lab compares two results that are both 0",
        "overflow 5": "the lab compares two results that are both 0",
    }
)
def _(x, abar, means, sigma, weights):
    """data-width-forgotten: in your code, the variance of a noisy mode is 1 - abar. The
      data have a width as well, so it is abar sigma^2 + 1 - abar
    data-width-forgotten 2: in your code, the mean distance is divided by sqrt(1 - abar)
      at the end, as if all of it were noise. A part of it is the width of the data:
      multiply by sqrt(1 - abar) / (abar sigma^2 + 1 - abar)
    data-width-forgotten 3: the variance in your exponent is 1 - abar. The data have a
      width as well, so it is abar sigma^2 + 1 - abar, as in the factor of the result
    x-not-deviation: your code multiplies x itself by the gain. Multiply the deviation
      of x from the mean of each noisy mode, and average over the modes
    nearest-mode: in your code, each row belongs to its nearest mode alone. Take the
      mean over all modes, weighted with their probabilities given x
    nearest-mode 2: in your code, each row belongs to its most probable mode alone. Take
      the mean over all modes, weighted with their probabilities given x
    weights-only: in your code, the probability of a mode does not depend on x. Multiply
      its weight by its density at x and normalise
    clean: your result is the mean of the data given x. Return the mean of the noise
    score: your result is the gradient of ln p, the score. The mean of the noise is
      -sqrt(1 - abar) times the score
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
    overflow 4: your result is 0 far from all modes, because every density is 0 there in
      floating-point numbers. Subtract the row's largest exponent before you call exp
    overflow 5: your code adds a small number to the sum of the densities, so far from
      all modes, where every density is 0, every probability is 0 as well. Subtract the
      row's largest exponent before you call exp
    """
    keep, lose = np.sqrt(abar), np.sqrt(1 - abar)
    given = x, keep, lose, means, sigma, weights

    def noise(prob, off, variance):
        return lose / variance * np.sum(prob * off, axis=1)

    prob, off, variance = posterior(*given)
    mean = np.sum(prob * (means + keep * sigma**2 / variance * off), axis=1)
    others = wrong_probabilities(off, variance, weights)
    return {
        "data-width-forgotten": noise(*posterior(*given, wide=False)),
        "data-width-forgotten 2": np.sum(prob * off, axis=1) / lose
        if lose
        else np.nan * x,
        "clean": mean,
        "data-width-forgotten 3": noise(
            posterior(*given, wide=False)[0], off, variance
        ),
        "x-not-deviation": lose / variance * x,
        "score": -np.sum(prob * off, axis=1) / variance,
        **{name: noise(prob, off, variance) for name, prob in others.items()},
    }


@row.right  # Mode by mode, with logarithms.
def _(x, abar, means, sigma, weights):
    variance = abar * sigma**2 + (1 - abar)
    logs = np.stack(
        [
            np.log(w) - 0.5 * ((x - np.sqrt(abar) * m) ** 2).sum(-1) / variance
            for m, w in zip(means, weights)
        ]
    )
    prob = np.exp(logs - np.logaddexp.reduce(logs, axis=0))
    eps = np.zeros(x.shape)
    for one, m in zip(prob, means):
        eps += one[:, None] * (x - np.sqrt(abar) * m)
    return eps * np.sqrt(1 - abar) / variance


@row.right  # Row by row, from the mean of the means.
def _(x, abar, means, sigma, weights):
    rows = []
    v = 1 - abar * (1 - sigma**2)
    for one in x:
        squares = np.sum((means * np.sqrt(abar) - one) ** 2, axis=1)
        p = np.exp((squares.min() - squares) / (2 * v)) * weights
        centre = p @ means / np.sum(p)
        rows.append(np.sqrt(1 - abar) * (one - np.sqrt(abar) * centre) / v)
    return np.array(rows)


@row.spans
def _(rng):
    yield np.array([[-3.0], [4.0]]), 2.4e-7, TWO, 0.1, np.array([0.3, 0.7])
    yield np.array([[-1.0], [0.7]]), 0.9999, TWO, 0.1, np.array([0.3, 0.7])
    yield np.array([[0.1]]), 0.5, TWO, 0.1, np.array([0.3, 0.7])
