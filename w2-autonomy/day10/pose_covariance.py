"""10.7 `pose_covariance(J, sigma)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Covariance, Row

row = Row(Covariance((6, 6)))


@row.inputs
def _(rng):
    first = np.eye(6).reshape(3, 2, 6)
    drawn = [(rng.numbers(-1, 1, n, 2, 6), rng.numbers(0.5, 2)) for n in (6, 8, 8, 12)]
    return [(first, 2.0), *drawn, (100 * drawn[0][0], 30.0)]


def rows_of(J):
    """Return J with one row per pixel coordinate, (2 n, 6)."""
    return J.reshape(-1, 6)


def covariance(
    J, sigma, *, rows=rows_of, share=lambda n: 1.0, told=lambda C: C
):  # fmt: skip
    """Return the covariance with other rows, another factor or another output."""
    J = rows(J)
    return told(share(len(J)) * sigma**2 * np.linalg.inv(J.T @ J))


for slug, says, redone, other in (
    ("mean-over-points", "the result is multiplied by the number of pixel coordinates, "
     "or J^T J is divided by it. Each further pixel should reduce the covariance",
     "the covariance times 2 n", {"share": lambda n: n}),
    ("mean-over-points", "the result is multiplied by the number of points, or J^T J "
     "is divided by it. Each further point should reduce the covariance",
     "the covariance times n", {"share": lambda n: n / 2}),
    ("divided-by-points", "the result is divided by the number of points; J^T J is "
     "already the sum over all points", "the covariance over n",
     {"share": lambda n: 2 / n}),
    ("divided-by-points", "the result is divided by the number of pixel coordinates; "
     "J^T J is already the sum over all of them", "the covariance over 2 n",
     {"share": lambda n: 1 / n}),
    ("reshaped-across", "J is reshaped to (6, 2 n), which mixes its rows; it has one "
     "row per pixel coordinate, (2 n, 6)", "J.reshape(6, -1)",
     {"rows": lambda J: J.reshape(6, -1).T}),
    ("u-alone", "only the rows of u are used; the rows of v contain information as "
     "well", "J[:, 0]", {"rows": lambda J: J[:, 0]}),
    ("v-alone", "only the rows of v are used; the rows of u contain information as "
     "well", "J[:, 1]", {"rows": lambda J: J[:, 1]}),
    ("sigma-for-variance", "the square root of each entry is taken; a covariance "
     "contains variances, for example in rad^2", "the square root",
     {"told": lambda C: np.sqrt(np.abs(C))}),
    ("sigma-for-variance", "the square root of each entry is taken; a covariance "
     "contains variances, for example in rad^2", "np.sqrt", {"told": np.sqrt}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(covariance, **other))


@row.wrongs
def _(J, sigma):
    """information: the result is the information matrix J^T J / sigma^2; the covariance
      is its inverse
    by-what-is-left: the result is divided by 2 n - 6 degrees of freedom; this division
      belongs to the estimate of an unknown sigma
    each-point-alone: the covariances of the single points are added. Add their
      information matrices J^T J
    """
    rows = rows_of(J)
    left = len(rows) - 6
    alone = [np.linalg.pinv(one.T @ one) for one in J]
    return {
        "information": rows.T @ rows / sigma**2,
        "by-what-is-left": covariance(J, sigma) / left
        if left
        else np.full((6, 6), np.inf),
        "each-point-alone": sigma**2 * np.sum(alone, axis=0),
    }


row.at_least_0(sigma="it enters as a square")
row.same(
    "J = J.reshape(-1, 6) => J = J.reshape(-2, 6)",
    "NumPy infers any negative size",
)


@row.right  # By the pseudo-inverse, which propagates the noise.
def _(J, sigma):
    P = np.linalg.pinv(J.reshape(-1, 6))
    return P @ (sigma**2 * np.eye(P.shape[1])) @ P.T


row.spans(  # as small, or as large, as in the lab
    J=(lambda J: 8 * J,),
)
