"""Diffusion and flow matching: schedules, exact denoisers of a mixture, and samplers.

A sampler turns Gaussian noise into samples of a distribution of data. Two families are
here, and for a mixture of Gaussians the best network of each is known in closed form:

- **Diffusion** mixes data x0 and noise as sqrt(abar) x0 + sqrt(1 - abar) noise. abar is
  the fraction of the signal's power that is left: 1 without noise, near 0 at the noisy
  end. A schedule (T,) is the abar of each level, from little noise to much.
- **Flow matching** mixes them as (1 - t) noise + t x0; t runs from 0 (noise) to 1.

Rows are samples, (n, d). Random quantities are arguments. A mixture is `means` (k, d),
one standard deviation `sigma` of all modes and directions, and `weights` (k,).

Sources: Ho, Jain and Abbeel, "Denoising diffusion probabilistic models" (2020); Nichol
and Dhariwal, "Improved denoising diffusion probabilistic models" (2021), the cosine
schedule; Song, Meng and Ermon, "Denoising diffusion implicit models" (2021); Lipman and
others, "Flow matching for generative modeling" (2023).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robo47 import checks
from robo47.checks import Array

OFFSET = 0.008  # of the cosine schedule: little noise at first, but not none
MAX_BETA = 0.999  # of the cosine schedule: abar never reaches 0
MAX_DECAY = 0.995  # of `ema`


def cosine_schedule(T: int) -> Array:
    """Return the cosine schedule of Nichol and Dhariwal (2021).

    With f(t) = cos^2((t / T + 0.008) / 1.008 pi / 2), level t = 0 to T - 1 removes the
    fraction beta = 1 - f(t + 1) / f(t) of the signal's power, at most 0.999.

    Args:
        T: number of levels, at least 1.

    Returns:
        abar of each level, (T,): the products of 1 - beta so far.

    Raises:
        ValueError: no level.
    """
    _count(T, "T")
    f = np.cos((np.arange(T + 1) / T + OFFSET) / (1.0 + OFFSET) * np.pi / 2.0) ** 2
    beta = np.minimum(1.0 - f[1:] / f[:-1], MAX_BETA)
    return np.cumprod(1.0 - beta)


def linear_schedule(T: int, first: float = 1e-4, last: float = 0.02) -> Array:
    """Return the linear schedule of Ho and others (2020), made for T = 1000.

    Args:
        T: number of levels, at least 1.
        first, last: beta of the first and of the last level.

    Returns:
        abar of each level, (T,).

    Raises:
        ValueError: no level.
    """
    _count(T, "T")
    return np.cumprod(1.0 - np.linspace(first, last, T), dtype=np.float64)


def add_noise(x0: ArrayLike, noise: ArrayLike, abar: ArrayLike) -> Array:
    """Return noisy data: sqrt(abar) x0 + sqrt(1 - abar) noise.

    Args:
        x0: data, (n, d).
        noise: standard Gaussian numbers, (n, d).
        abar: of each row, (n,), or one number for all; 0 to 1.

    Returns:
        (n, d).

    Raises:
        ValueError: a wrong shape, or abar outside 0 to 1.
    """
    x0, noise = _two(x0, noise, "x0", "noise")
    abar = _per_row(abar, "abar", x0)
    return np.sqrt(abar) * x0 + np.sqrt(1.0 - abar) * noise


def exact_noise(
    x: ArrayLike, abar: float, means: ArrayLike, sigma: float, weights: ArrayLike
) -> Array:
    """Return the expected noise in noisy samples of a mixture of Gaussians.

    It is the prediction with the smallest mean squared error, E[noise | x], so no
    trained network can do better. It is -sqrt(1 - abar) times the score, the gradient
    of the logarithm of the density of x.

    Args:
        x: noisy samples, (n, d).
        abar: of all samples, 0 to 1.
        means: of the modes, (k, d).
        sigma: standard deviation of each mode without noise.
        weights: of the modes, (k,); only their ratios matter.

    Returns:
        (n, d).

    Raises:
        ValueError: a wrong shape, abar outside 0 to 1, or neither noise nor width.
    """
    abar = float(_fraction(abar, "abar"))
    keep, lose = np.sqrt(abar), np.sqrt(1.0 - abar)
    prob, off, variance = _modes(x, keep, lose, means, sigma, weights)
    return lose / variance * np.sum(prob * off, axis=-2)


def ddim_step(x: ArrayLike, eps: ArrayLike, abar: ArrayLike, prev: ArrayLike) -> Array:
    """Return samples with less noise: a deterministic step (DDIM, Song and others).

    The clean sample that belongs to x and eps receives the noise eps again, at the
    level prev.

    Args:
        x: samples at the level abar, (n, d).
        eps: the noise in them, (n, d).
        abar: level of x, above 0: one number, or one for each row (n,).
        prev: level of the result, likewise; 1 is no noise.

    Returns:
        (n, d).

    Raises:
        ValueError: a wrong shape, or a level outside its range.
    """
    x, eps = _two(x, eps, "x", "eps")
    abar, prev = _level(abar, x), _per_row(prev, "prev", x)
    clean = (x - np.sqrt(1.0 - abar) * eps) / np.sqrt(abar)
    return np.sqrt(prev) * clean + np.sqrt(1.0 - prev) * eps


def ddpm_step(
    x: ArrayLike, eps: ArrayLike, abar: ArrayLike, prev: ArrayLike, noise: ArrayLike
) -> Array:
    """Return samples with less noise: a random step (DDPM, Ho and others, 2020).

    The result is drawn from the Gaussian distribution of the sample at the level prev,
    given x and the clean sample that belongs to x and eps.

    Args:
        x: samples at the level abar, (n, d).
        eps: the noise in them, (n, d).
        abar: level of x, above 0 and below 1: one number, or one for each row (n,).
        prev: level of the result, likewise, from abar to 1.
        noise: standard Gaussian numbers, (n, d).

    Returns:
        (n, d).

    Raises:
        ValueError: a wrong shape, or a level outside its range.
    """
    x, eps = _two(x, eps, "x", "eps")
    x, noise = _two(x, noise, "x", "noise")
    abar, prev = _level(abar, x), _per_row(prev, "prev", x)
    if np.any(abar >= 1.0) or np.any(prev < abar):
        raise ValueError("expected abar below 1, and prev from abar to 1")
    clean = (x - np.sqrt(1.0 - abar) * eps) / np.sqrt(abar)
    alpha = abar / prev
    beta = 1.0 - alpha
    of_clean = np.sqrt(prev) * beta / (1.0 - abar)
    of_x = np.sqrt(alpha) * (1.0 - prev) / (1.0 - abar)
    variance = (1.0 - prev) / (1.0 - abar) * beta
    return of_clean * clean + of_x * x + np.sqrt(variance) * noise


def timesteps(T: int, n: int) -> NDArray[np.int64]:
    """Return the levels that a sampler of n steps uses, from the noisiest.

    Args:
        T: number of levels of the schedule.
        n: number of steps, 1 to T.

    Returns:
        (n,): equally spaced from T - 1 to 0, rounded to whole numbers (halves to even).
        One step uses T - 1.

    Raises:
        ValueError: n outside 1 to T.
    """
    _count(n, "n")
    if n > T:
        raise ValueError(f"n is {n}; a schedule of {T} levels has at most {T} steps")
    return np.rint(np.linspace(T - 1, 0, n)).astype(np.int64)


def width_kept(abars: ArrayLike, sigma: float) -> float:
    """Return the fraction of a mode's standard deviation that DDIM steps keep.

    The data are one Gaussian, the denoiser is exact, and the start has the standard
    deviation of the noisy data. A step rotates the vector (sigma sqrt(abar),
    sqrt(1 - abar)) and keeps the cosine of the angle.

    Args:
        abars: levels from the noisiest on, (k,); the last step leads to abar = 1.
        sigma: standard deviation of the data, above 0.

    Returns:
        The product of the cosines.

    Raises:
        ValueError: no level, a level outside 0 to 1, or sigma not above 0.
    """
    abars = checks.array(_fraction(abars, "abars"), "abars", ("k",))
    sigma = float(checks.positive(sigma, "sigma"))
    angle = np.arctan2(np.sqrt(1.0 - abars), sigma * np.sqrt(abars))
    return float(np.prod(np.cos(np.diff(angle, append=0.0))))


def flow_pair(x0: ArrayLike, noise: ArrayLike, t: ArrayLike) -> tuple[Array, Array]:
    """Return a point on the line from noise to data, and the velocity there.

    Args:
        x0: data, (n, d).
        noise: standard Gaussian numbers, (n, d).
        t: of each row, (n,), or one number for all; 0 (noise) to 1 (data).

    Returns:
        (x_t, velocity), (n, d) each: (1 - t) noise + t x0, and x0 - noise.

    Raises:
        ValueError: a wrong shape, or t outside 0 to 1.
    """
    x0, noise = _two(x0, noise, "x0", "noise")
    t = _per_row(t, "t", x0)
    return (1.0 - t) * noise + t * x0, x0 - noise


def exact_velocity(
    x: ArrayLike, t: float, means: ArrayLike, sigma: float, weights: ArrayLike
) -> Array:
    """Return the expected velocity of flow matching for a mixture of Gaussians.

    It is E[x0 - noise | x], the best prediction of `flow_pair`'s velocity.

    Args:
        x: points at the time t, (n, d).
        t: 0 (noise) to 1 (data).
        means: of the modes, (k, d).
        sigma: standard deviation of each mode.
        weights: of the modes, (k,); only their ratios matter.

    Returns:
        (n, d).

    Raises:
        ValueError: a wrong shape, t outside 0 to 1, or neither noise nor width.
    """
    t = float(_fraction(t, "t"))
    prob, off, variance = _modes(x, t, 1.0 - t, means, sigma, weights)
    slope = (t * sigma**2 - (1.0 - t)) / variance
    return np.sum(prob * (np.asarray(means, dtype=np.float64) + slope * off), axis=-2)


def ema(slow: ArrayLike, fast: ArrayLike, k: int) -> Array:
    """Return the exponential moving average of a network's parameters.

    The decay rate is min(0.995, (1 + k) / (10 + k)), so the first averages forget
    quickly.

    Args:
        slow: the average so far, any shape.
        fast: the new parameters, the same shape.
        k: number of averages so far, 0 for the first.

    Returns:
        decay slow + (1 - decay) fast, a new array.

    Raises:
        ValueError: different shapes, or k below 0.
    """
    slow, fast = _two(slow, fast, "slow", "fast")
    if k < 0:
        raise ValueError(f"k is {k}; the first average has k = 0")
    decay = min(MAX_DECAY, (1.0 + k) / (10.0 + k))
    return decay * slow + (1.0 - decay) * fast


def time_features(fraction: ArrayLike) -> Array:
    """Return eight inputs of a network that describe the level of noise.

    Args:
        fraction: of each row, (n,): 0 at one end of the noise and 1 at the other.

    Returns:
        Sines and cosines of pi / 2, pi, 2 pi and 4 pi times the fraction, (n, 8).
    """
    angle = np.multiply.outer(fraction, np.pi * np.array([0.5, 1.0, 2.0, 4.0]))
    return np.concatenate([np.sin(angle), np.cos(angle)], axis=-1)


def _modes(
    x: ArrayLike,
    keep: float,
    lose: float,
    means: ArrayLike,
    sigma: float,
    weights: ArrayLike,
) -> tuple[Array, Array, float]:
    """Return how a noisy sample keep x0 + lose noise belongs to each mode.

    Returns:
        The probability of each mode given x, (..., k, 1); the distance from its noisy
        centre, (..., k, d); and the variance about it.
    """
    means = checks.array(means, "means", ("k", "d"))
    x = checks.array(x, "x", (means.shape[-1],))
    weights = checks.not_negative(checks.array(weights, "weights", means.shape[:1]),
                                  "weights")  # fmt: skip
    if not np.any(weights):
        raise ValueError("weights are all 0, so no mode has samples")
    sigma = float(checks.not_negative(sigma, "sigma"))
    variance = (keep * sigma) ** 2 + lose**2
    if variance == 0.0:
        raise ValueError("neither noise nor sigma: expected a variance above 0")
    off = x[..., None, :] - keep * means
    logs = np.full(weights.shape, -np.inf)
    np.log(weights, out=logs, where=weights > 0.0)
    logs = logs - 0.5 * np.sum(off**2, axis=-1) / variance
    prob = np.exp(logs - logs.max(axis=-1, keepdims=True))
    return (prob / prob.sum(axis=-1, keepdims=True))[..., None], off, variance


def _count(n: int, name: str) -> None:
    if n < 1:
        raise ValueError(f"{name} is {n}; expected at least 1")


def _fraction(value: ArrayLike, name: str) -> Array:
    """Return numbers from 0 to 1 as float64."""
    value = checks.array(value, name, ())
    if np.any((value < 0.0) | (value > 1.0)):
        raise ValueError(f"{name} is {value.ravel()[0]:g}; expected 0 to 1")
    return value


def _per_row(value: ArrayLike, name: str, like: Array) -> Array:
    """Return fractions as a column for the rows of an array, or as one number."""
    value = _fraction(value, name)
    if value.ndim and value.shape != like.shape[:-1]:
        raise ValueError(f"{name} has shape {value.shape}; expected {like.shape[:-1]}")
    return value[..., None] if value.ndim else value


def _level(abar: ArrayLike, like: Array) -> Array:
    """Return the level of noisy samples, which some of the signal must be left in."""
    abar = _per_row(abar, "abar", like)
    if np.any(abar == 0.0):
        raise ValueError("abar is 0: no signal is left, so no clean sample is known")
    return abar


def _two(a: ArrayLike, b: ArrayLike, first: str, second: str) -> tuple[Array, Array]:
    """Return two arrays of one shape as float64."""
    a, b = checks.array(a, first, ()), checks.array(b, second, ())
    if a.shape != b.shape:
        raise ValueError(f"{first} has shape {a.shape} and {second} {b.shape}; "
                         "expected the same")  # fmt: skip
    return a, b
