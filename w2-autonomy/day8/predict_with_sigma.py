"""8.7 `predict_with_sigma(Y, tau, Y_new, rtol)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from labkit.judge.argument_mistakes import Change
from robo47.identification import predict_with_sigma

from .states import CUT, hidden
from .truncated_svd_fit import asked, parts, scaled

row = Row(tuple(Vector((None,), "N m", called=x) for x in ("the torque", "sigma")))
row.at_least_0(rtol="a tolerance")
CASE = np.ones((4, 1)), np.array([1.0, 3.0, 1.0, 3.0]), np.ones((1, 1)), 1e-9
row.reached_by("truncated_svd_fit", "in truncated_svd_fit, ")


@row.inputs
def _(rng):
    exact = hidden(rng)
    new = rng.numbers(-1, 1, 5, 6)
    drawn = [(exact, scaled(rng, exact), new, 1e-9)]
    for Y in asked(rng):
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
    mean-taken-off: the mean of what is left is taken off first, as a standard deviation
      does; it is a part of the noise
    rank-taken-off-last: r.r is divided by n, and the rank is taken off that; n - rank
      needs brackets => sigma with r.r / n - rank
    variance: this is the variance; sigma is its root => sigma squared
    noise-left-out: the noise is missing: this is how much a fit amplifies it
    noise-for-sigma: this is the noise for every row; a motion that was never shown is
      less sure => the noise
    not-divided-by-s: sigma lacks the singular values: what the motion shows little of
      is as sure as the rest => sigma with 1 for s
    times-s: sigma is multiplied by the singular values; the fit divides by them, and so
      does sigma => sigma with s for 1 / s
    sigma-by-s-squared: sigma is divided by s twice: (Y^T Y)^-1 is V S^-2 V^T, and the
      root of y^T (Y^T Y)^-1 y has one S^-1 => sigma with s^2 for s
    sigma-with-V: numpy.linalg.svd returns V^T; in sigma it is taken for V => sigma with
      V for V^T
    sigma-cut-not-squared: in sigma the cut is made on Y^T Y, whose values are squares,
      and is not squared => sigma with the pseudo-inverse of Y^T Y cut at rtol
    sizes-added: the sizes of the row's entries are added up; independent noise adds up
      by squares, so it is the row's length => sigma with the sum of sizes
    sigma-not-cut: the fit leaves small singular values out, sigma does not, as by Y^T Y
      inverted => the right torque, sigma with nothing cut
    """
    torque, sigma = predict_with_sigma(Y, tau, Y_new, rtol)
    U, s, Vt = parts(Y, rtol)
    n, p = Y.shape
    left = n - len(s)
    rest = tau - U @ (U.T @ tau)
    noise = np.linalg.norm(rest) / np.sqrt(left)
    _, every, along = parts(Y, 0.0)
    back = np.linalg.pinv(Y.T @ Y, rcond=rtol)
    seen = Y_new @ Vt.T
    sigmas = {
        "n-for-n-rank": sigma * np.sqrt(left / n),
        "columns-for-rank": sigma * np.sqrt(left / (n - p)),
        "one-more-taken-off": sigma * np.sqrt(left / (left - 1)),
        "mean-of-sizes": sigma * np.abs(rest).mean() / noise,
        "noise-squared": sigma * noise,
        "noise-added": np.hypot(sigma, noise),
        "mean-taken-off": sigma * np.std(rest, ddof=len(s)) / noise,
        "rank-taken-off-last": sigma * np.sqrt(rest @ rest / n - len(s)) / noise,
        "variance": sigma**2,
        "noise-left-out": sigma / noise,
        "noise-for-sigma": noise + 0 * sigma,
        "not-divided-by-s": noise * np.linalg.norm(seen, axis=1),
        "times-s": noise * np.linalg.norm(seen * s, axis=1),
        "sigma-by-s-squared": noise * np.linalg.norm(seen / s**2, axis=1),
        "sigma-with-V": noise * np.linalg.norm(Y_new @ along[:, : len(s)] / s, axis=1),
        "sigma-cut-not-squared": noise
        * np.sqrt(np.einsum("ij,jk,ik->i", Y_new, back, Y_new)),
        "sizes-added": noise * np.abs(seen / s).sum(axis=1),
        "sigma-not-cut": noise * np.linalg.norm(Y_new @ along.T / every, axis=1),
    }
    return {slug: (torque, one) for slug, one in sigmas.items()}


NOT_USED = Change(
    "rtol-not-used",
    "the cut is a fixed one; rtol is an argument, and the lab asks with another one",
    lambda rtol: 1e-9,
    "the right one with 1e-9 for rtol",
)
row.of_argument("rtol", NOT_USED)


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
