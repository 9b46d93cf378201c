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
row.reached_by("truncated_svd_fit", "in `truncated_svd_fit`, ")


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
    """columns-for-rank: your code divides the sum of the squared residuals by n - p.
      Divide the sum by n - rank instead, because the truncated fit determines only as
      many combinations of parameters as the rank
    one-more-taken-off: your code divides the sum of the squared residuals by n - rank -
      1. Divide the sum by n - rank instead, because the model has no constant term
    mean-of-sizes: your code uses the mean absolute residual as the noise level. Use
      sqrt(r . r / (n - rank)) instead, where r is the vector of residuals
    noise-added: your code adds the noise of a new measurement to sigma. Omit this
      noise, because sigma should include only the uncertainty of the fitted parameters
    mean-taken-off: your noise level is computed from the residuals minus their mean, as
      with np.std. Use the residuals unchanged, because their mean is part of the noise
    rank-taken-off-last: your code divides the sum of the squared residuals by n and
      then subtracts the rank. Divide the sum by n - rank instead
    noise-for-sigma: your code returns the noise level as sigma for every row of Y_new.
      For each row y, multiply the noise level by the norm of y V S^-1, which is also
      the norm of y Y^+
    sigma-by-s-squared: your sigma contains the norm of y V S^-2, which is also the norm
      of y (Y^T Y)^+, where y is a row of Y_new. Use the norm of y V S^-1 instead, which
      is also the norm of y Y^+
    sigma-with-V: your sigma contains V^T in the place of V, whose columns are the right
      singular vectors. The third result of numpy.linalg.svd, for example, is V^T
    sigma-cut-not-squared: in your sigma, the limit of the singular values is sqrt(rtol)
      times the largest one, as if rtol were the limit of the eigenvalues of Y^T Y. Use
      rtol times the largest singular value, which corresponds to rtol^2 times the
      largest of these eigenvalues
    sizes-added: your code uses the sum of the absolute entries of y V S^-1 in sigma,
      where y is a row of Y_new. Use the norm of y V S^-1 instead, because the variances
      of independent errors add
    sizes-added 2: your code uses the sum of the absolute entries of y Y^+ in sigma,
      where y is a row of Y_new. Use the norm of y Y^+ instead, because the variances of
      independent errors add
    sigma-not-cut: your code uses all singular values in sigma. Omit the small singular
      values that the fit also omits
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
        "columns-for-rank": sigma * np.sqrt(left / (n - p)),
        "one-more-taken-off": sigma * np.sqrt(left / (left - 1)),
        "mean-of-sizes": sigma * np.abs(rest).mean() / noise,
        "noise-added": np.hypot(sigma, noise),
        "mean-taken-off": sigma * np.std(rest, ddof=len(s)) / noise,
        "rank-taken-off-last": sigma * np.sqrt(rest @ rest / n - len(s)) / noise,
        "noise-for-sigma": noise + 0 * sigma,
        "sigma-by-s-squared": noise * np.linalg.norm(seen / s**2, axis=1),
        "sigma-with-V": noise * np.linalg.norm(Y_new @ along[:, : len(s)] / s, axis=1),
        "sigma-cut-not-squared": noise
        * np.sqrt(np.einsum("ij,jk,ik->i", Y_new, back, Y_new)),
        "sizes-added": noise * np.abs(seen / s).sum(axis=1),
        "sizes-added 2": noise * np.abs(Y_new @ np.linalg.pinv(Y, rcond=rtol)).sum(1),
        "sigma-not-cut": noise * np.linalg.norm(Y_new @ along.T / every, axis=1),
    }
    return {slug: (torque, one) for slug, one in sigmas.items()}


NOT_USED = Change(
    "rtol-not-used",
    "your code uses a constant as the tolerance. Use the argument `rtol` instead",
    lambda rtol: 1e-9,
    "the result with 1e-9 for rtol",
)
row.of_argument("rtol", NOT_USED)


@row.right  # By the pseudo-inverse alone, whose rows multiply the noise.
def _(Y, tau, Y_new, rtol):
    back = np.linalg.pinv(Y, rcond=rtol)
    r = tau - Y @ (back @ tau)
    rank = np.linalg.matrix_rank(back, tol=1e-9 * np.linalg.norm(back, 2))
    noise = np.sqrt(r @ r / (len(tau) - rank))
    return Y_new @ back @ tau, noise * np.linalg.norm(Y_new @ back, axis=1)
