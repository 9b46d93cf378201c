"""8.7 `predict_with_sigma(Y, tau, Y_new, rtol)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from robo47.identification import predict_with_sigma

from .fit import parts, scaled
from .states import CUT, regressors, uneven

row = Row(tuple(Vector((None,), "N m", called=x) for x in ("the torque", "sigma")))
CASE = np.ones((4, 1)), np.array([1.0, 3.0, 1.0, 3.0]), np.ones((1, 1)), 1e-9
row.reached_by("fit", "in fit, ")


@row.inputs
def _(rng):
    drawn = []
    for Y in [uneven(rng, 5.0), uneven(rng, 8.0), *regressors(rng)]:
        new = rng.numbers(-1, 1, 5, 6) * np.linalg.norm(Y, 2)
        drawn.append((Y, scaled(rng, Y), new, CUT))
    return [CASE, *drawn]


@row.wrongs
def _(Y, tau, Y_new, rtol):
    """n-for-n-rank: the noise is divided by n; the fit took rank of the n, so n - rank
      are left => sigma with n
    columns-for-rank: the noise is divided by n - p; the fit only used rank of the p
      columns => sigma with n - p
    one-more-taken-off: the noise is divided by n - rank - 1; no mean was taken off,
      n - rank are left => sigma with n - rank - 1
    mean-of-sizes: the noise is the mean of the sizes of what is left; it is the root of
      the mean square => sigma with the mean of |r|
    noise-squared: the noise is not rooted: r.r / (n - rank) is its square => sigma
      times the noise
    noise-added: the noise of a new measurement is added; sigma is that of the
      prediction => the root of sigma^2 + noise^2
    mean-taken-off: the mean of what is left is taken off first; it is noise as well,
      and the rank has counted it already
    variance: this is the variance; sigma is its root => sigma squared
    noise-left-out: the noise is missing: this is how much a fit amplifies it
    noise-for-sigma: this is the noise for every row; a motion that was never shown is
      less sure => the noise
    sigma-not-cut: the fit leaves small singular values out, sigma does not, as by Y^T Y
      inverted => the right torque, sigma with nothing cut
    """
    torque, sigma = predict_with_sigma(Y, tau, Y_new, rtol)
    U, s, _ = parts(Y, rtol)
    n, p = Y.shape
    left = n - len(s)
    rest = tau - U @ (U.T @ tau)
    noise = np.linalg.norm(rest) / np.sqrt(left)
    _, every, along = parts(Y, 0.0)
    sigmas = {
        "n-for-n-rank": sigma * np.sqrt(left / n),
        "columns-for-rank": sigma * np.sqrt(left / (n - p)),
        "one-more-taken-off": sigma * np.sqrt(left / (left - 1)),
        "mean-of-sizes": sigma * np.abs(rest).mean() / noise,
        "noise-squared": sigma * noise,
        "noise-added": np.hypot(sigma, noise),
        "mean-taken-off": sigma * np.std(rest, ddof=len(s)) / noise,
        "variance": sigma**2,
        "noise-left-out": sigma / noise,
        "noise-for-sigma": noise + 0 * sigma,
        "sigma-not-cut": noise * np.linalg.norm(Y_new @ along.T / every, axis=1),
    }
    return {slug: (torque, one) for slug, one in sigmas.items()}


@row.wrong("answers-swapped", "the two answers are swapped: the torque comes first")
def _(Y, tau, Y_new, rtol):
    return predict_with_sigma(Y, tau, Y_new, rtol)[::-1]


@row.right  # By the pseudo-inverse alone: its rows are what multiplies the noise.
def _(Y, tau, Y_new, rtol):
    back = np.linalg.pinv(Y, rcond=rtol)
    r = tau - Y @ (back @ tau)
    rank = np.linalg.matrix_rank(back, tol=1e-9 * np.linalg.norm(back, 2))
    noise = np.sqrt(r @ r / (len(tau) - rank))
    return Y_new @ back @ tau, noise * np.linalg.norm(Y_new @ back, axis=1)
