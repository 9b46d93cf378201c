"""8.7 `predict_with_sigma(Y, tau, Y_new, rtol)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Vector, draw
from labkit.judge.row import Row
from robo47.identification import predict_with_sigma

from .fit import parts, scaled
from .states import CUT, regressors

row = Row(
    (
        Vector((None,), "N m", called="the torque"),
        Vector((None,), "N m", called="sigma"),
    )
)
CASE = np.ones((4, 1)), np.array([1.0, 3.0, 1.0, 3.0]), np.ones((1, 1)), 1e-9
row.reached_by("fit", "in fit, ")


@row.inputs
def _(rng):
    drawn = []
    for Y in regressors(rng):
        new = draw.numbers(rng, -1, 1, 5, 6) * np.linalg.norm(Y, 2)
        drawn.append((Y, scaled(rng, Y), new, CUT))
    return [CASE, *drawn]


def with_sigma(change):
    """Return the function with another sigma: of (sigma, noise, n, rank, p)."""

    def code(Y, tau, Y_new, rtol):
        torque, sigma = predict_with_sigma(Y, tau, Y_new, rtol)
        U, (n, p) = parts(Y, rtol)[0], Y.shape
        rank = U.shape[1]
        noise = np.linalg.norm(tau - U @ (U.T @ tau)) / np.sqrt(n - rank)
        return torque, change(sigma, noise, n, rank, p)

    return code


for slug, says, redone, change in (
    ("n-for-n-rank", "the noise is divided by n; the fit took rank of the n, so "
     "n - rank are left", "sigma with n",
     lambda sigma, noise, n, rank, p: sigma * np.sqrt((n - rank) / n)),
    ("columns-for-rank", "the noise is divided by n - p; the fit only used rank of the "
     "p columns", "sigma with n - p",
     lambda sigma, noise, n, rank, p: sigma * np.sqrt((n - rank) / (n - p))),
    ("noise-added", "the noise of a new measurement is added; sigma is that of the "
     "prediction", "the root of sigma^2 + noise^2",
     lambda sigma, noise, n, rank, p: np.hypot(sigma, noise)),
    ("variance", "this is the variance; sigma is its root", "sigma squared",
     lambda sigma, noise, n, rank, p: sigma**2),
    ("noise-left-out", "the noise is missing: this is how much a fit amplifies it",
     "sigma over the noise", lambda sigma, noise, n, rank, p: sigma / noise),
    ("noise-for-sigma", "this is the noise for every row; a motion that was never "
     "shown is less sure", "the noise",
     lambda sigma, noise, n, rank, p: noise + 0 * sigma),
):  # fmt: skip
    row.wrong(slug, says, redone)(with_sigma(change))


@row.wrong
def sigma_not_cut(Y, tau, Y_new, rtol):
    """the fit leaves small singular values out, sigma does not, as by Y^T Y inverted =>
    the right torque, sigma with nothing cut"""
    torque, sigma = predict_with_sigma(Y, tau, Y_new, rtol)
    _, s, Vt = parts(Y, rtol)
    _, every, along = np.linalg.svd(Y, full_matrices=False)
    noise = sigma / np.linalg.norm(Y_new @ Vt.T / s, axis=1)
    return torque, noise * np.linalg.norm(Y_new @ along.T / every, axis=1)


@row.right  # By the pseudo-inverse alone: its rows are what multiplies the noise.
def _(Y, tau, Y_new, rtol):
    back = np.linalg.pinv(Y, rcond=rtol)
    r = tau - Y @ (back @ tau)
    rank = np.linalg.matrix_rank(back, tol=1e-9 * np.linalg.norm(back, 2))
    noise = np.sqrt(r @ r / (len(tau) - rank))
    return Y_new @ back @ tau, noise * np.linalg.norm(Y_new @ back, axis=1)
