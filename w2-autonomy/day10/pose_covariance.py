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


for slug, says, other in (
    ("mean-over-points",
     "your code multiplies the result by the number of pixel coordinates, or it "
     "divides J^T J by this number. Omit this factor, because each additional "
     "coordinate should reduce the covariance",
                         {"share": lambda n: n}),
    ("mean-over-points", "your code multiplies the result by the number of points, or "
                         "it divides J^T J by this number. Omit this factor, because "
                         "each additional point should reduce the covariance",
     {"share": lambda n: n / 2}),
    ("divided-by-points", "your code divides the result by the number of points. Omit "
                          "this division, because J^T J is already the sum over all "
                          "points",
     {"share": lambda n: 2 / n}),
    ("divided-by-points", "your code divides the result by the number of pixel "
                          "coordinates. Omit this division, because J^T J is already "
                          "the sum over all coordinates",
     {"share": lambda n: 1 / n}),
    ("reshaped-across",
     "your result is the covariance for J reshaped to (6, 2 n), which mixes entries "
     "from different rows. Reshape J to (2 n, 6) instead, with one row for each pixel "
     "coordinate",
     {"rows": lambda J: J.reshape(6, -1).T}),
    ("u-alone",
     "your code uses only the rows for u. Use the rows for v as well, because they "
     "also contain information about the pose", {"rows": lambda J: J[:, 0]}),
    ("v-alone",
     "your code uses only the rows for v. Use the rows for u as well, because they "
     "also contain information about the pose", {"rows": lambda J: J[:, 1]}),
    ("sigma-for-variance",
     "each entry of your result is the square root of the absolute value of the "
     "correct one. Omit the square root, because a covariance contains variances, for "
     "example in rad^2",
     {"told": lambda C: np.sqrt(np.abs(C))}),
    ("sigma-for-variance",
     "each entry of your result is the square root of the correct one. Omit the square "
     "root, because a covariance contains variances, for example in rad^2",
                           {"told": np.sqrt}),
):  # fmt: skip
    row.wrong(slug, says)(partial(covariance, **other))


@row.wrongs
def _(J, sigma):
    """information: your code returns the information matrix J^T J / sigma^2. Return the
      covariance instead, which is the inverse of this matrix
    by-what-is-left: your code divides the result by the number of degrees of freedom,
      `2 n - 6`. Omit this division, because sigma is given and not estimated from the
      fit
    each-point-alone: your code adds the covariances of the individual points. Add their
      information matrices instead, and invert the sum
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
