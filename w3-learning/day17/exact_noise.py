"""17.3 `exact_noise(x, abar, means, sigma, weights)`: its questions and mistakes."""

import numpy as np

from labkit.judge import Matrix, Row

from .modes import TWO, asked, cases, posterior, wrong_probabilities

row = Row(
    Matrix((None, None)),
    # The root of 1 - abar has no derivative at 1.
    at_edge=lambda x, abar, means, sigma, weights: abar < 1,
)


@row.inputs
def _(rng):
    yield from asked(rng, 0.36, 0.9)


cases(row)
row.at_least_0(abar="a fraction", sigma="a standard deviation", weights="probabilities")


@row.wrongs(
    hidden={
        "per-coordinate": "the lab's mixture has one dimension",
        "overflow 4": "the lab compares two results that are both 0",
        "overflow 5": "the lab compares two results that are both 0",
    }
)
def _(x, abar, means, sigma, weights):
    """data-width-forgotten: your code uses 1 - abar as the variance of each noisy mode.
      Use abar * sigma^2 + 1 - abar instead, because the data in a mode have the
      variance sigma^2
    data-width-forgotten 2: your code divides the mean deviation of x from the noisy
      means by sqrt(1 - abar). Multiply this deviation by sqrt(1 - abar) / (abar *
      sigma^2 + 1 - abar) instead
    data-width-forgotten 3: your code uses the variance 1 - abar in the exponent. Use
      abar * sigma^2 + 1 - abar instead, which is the variance of each noisy mode
    x-not-deviation: your code multiplies x itself by sqrt(1 - abar) / variance.
      Multiply the mean deviation of x from the noisy means by this factor instead.
      Weight the deviations by the probabilities of the modes given x
    nearest-mode: for each row of x, your code uses only the nearest mode. Return the
      mean noise over all modes, weighted by the probabilities of the modes given x
    nearest-mode 2: your code assigns each row only to its most probable mode. Return
      the mean noise over all modes, weighted by the probabilities of the modes given x
    weights-only: your code uses the weights of the modes as their probabilities given
      x. Multiply each weight by the density of its mode at x, and normalise the
      products
    clean: your function returns the mean of the data given x. Return the mean of the
      noise given x instead
    score: your function returns the score, which is the gradient of ln p(x). Multiply
      the score by -sqrt(1 - abar) to obtain the mean of the noise
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
