"""10.7 `pose_covariance(J, sigma)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Covariance, Row

from .seen import HALF

row = Row(Covariance((6, 6)))


@row.inputs
def _(rng):
    first = np.eye(6).reshape(3, 2, 6)
    drawn = [(rng.numbers(-1, 1, n, 2, 6), rng.numbers(0.5, 2)) for n in (6, 8, 8, 12)]
    return [(first, 2.0), *drawn, (100 * drawn[0][0], 30.0)]


@row.wrongs
def _(J, sigma):
    """sigma-not-squared: the noise enters as sigma; a covariance has its square
    not-inverted: this is sigma^2 J^T J: the larger J the surer, so it is inverted
    information: this is the information, J^T J / sigma^2; the covariance is its inverse
    sigma-for-variance: these are roots of the entries: a covariance has squares, rad^2
    sigma-forgotten: sigma is not used
    noise-divided: it is divided by sigma^2; more noise makes it less sure
    mean-over-points: it is multiplied by the number of pixels, or J^T J is a mean over
      them; each further pixel makes the pose surer => the right one times 2 n
    divided-by-points: it is divided by the number of points; J^T J adds them up
      already => the right one / n
    divided-by-points 2: it is divided by the number of pixels; J^T J adds them up
      already => the right one / (2 n)
    reshaped-across: J is reshaped to (6, 2 n), which only counts its numbers off anew;
      it has a row per number of a pixel, (2 n, 6) => with J.reshape(6, -1)
    u-alone: only the rows of u are used; v shows as much
    sigma-for-variance 2: these are roots of the entries: a covariance has squares,
      rad^2 => with np.sqrt, which has no root of what is below 0
    halves-swapped: the blocks are those of (v; omega); here omega comes first
    diagonal-only: only the diagonal is there; how the six go together is lost
    diagonal-inverted: each entry of J^T J's diagonal is inverted alone => with 1 / the
      diagonal
    """
    u = J[:, 0]
    across = J.reshape(6, -1)
    J = J.reshape(-1, 6)
    N = J.T @ J
    C = sigma**2 * np.linalg.inv(N)
    return {
        "sigma-not-squared": C / sigma,
        "not-inverted": sigma**2 * N,
        "information": N / sigma**2,
        "sigma-for-variance": np.sqrt(np.abs(C)),
        "sigma-forgotten": C / sigma**2,
        "noise-divided": C / sigma**4,
        "mean-over-points": C * len(J),
        "divided-by-points": C / (len(J) / 2),
        "divided-by-points 2": C / len(J),
        "reshaped-across": lambda: sigma**2 * np.linalg.inv(across @ across.T),
        "u-alone": lambda: sigma**2 * np.linalg.inv(u.T @ u),
        "sigma-for-variance 2": np.sqrt(C),
        "halves-swapped": C[HALF][:, HALF],
        "diagonal-only": np.diag(np.diag(C)),
        "diagonal-inverted": np.diag(sigma**2 / np.diag(N)),
    }


row.at_least_0(sigma="it enters as a square")
row.same(
    "J = J.reshape(-1, 6) => J = J.reshape(-2, 6)",
    "NumPy takes any size below 0 for what is left",
)


@row.right  # By the pseudo-inverse: what lstsq does to the noise, twice.
def _(J, sigma):
    P = np.linalg.pinv(J.reshape(-1, 6))
    return P @ (sigma**2 * np.eye(P.shape[1])) @ P.T
