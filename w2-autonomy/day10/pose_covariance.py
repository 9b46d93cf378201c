"""10.7 `pose_covariance(J, sigma)`: its questions and its mistakes."""

from functools import partial

import numpy as np

from labkit.judge import Covariance, Row

from .seen import HALF

row = Row(Covariance((6, 6)))


@row.inputs
def _(rng):
    first = np.eye(6).reshape(3, 2, 6)
    drawn = [(rng.numbers(-1, 1, n, 2, 6), rng.numbers(0.5, 2)) for n in (6, 8, 8, 12)]
    return [(first, 2.0), *drawn, (100 * drawn[0][0], 30.0)]


def rows_of(J):
    """Return J with a row for each number of a pixel, (2 n, 6)."""
    return J.reshape(-1, 6)


def covariance(
    J, sigma, *, noise=np.square, rows=rows_of, share=lambda n: 1.0,
    turned=np.linalg.inv, told=lambda C: C,
):  # fmt: skip
    """Return the covariance with other parts."""
    J = rows(J)
    return told(share(len(J)) * noise(sigma) * turned(J.T @ J))


def root(C):
    """Return the roots of the sizes."""
    return np.sqrt(np.abs(C))


for slug, says, redone, other in (
    ("sigma-not-squared", "the noise enters as sigma; a covariance has its square",
     "with sigma", {"noise": lambda sigma: sigma}),
    ("sigma-forgotten", "sigma is not used", "without sigma",
     {"noise": lambda sigma: 1.0}),
    ("noise-divided", "it is divided by sigma^2; more noise makes it less sure",
     "divided by sigma^2", {"noise": lambda sigma: sigma**-2.0}),
    ("sigma-to-the-fourth", "sigma^2 is squared once more", "with sigma^4",
     {"noise": lambda sigma: sigma**4}),
    ("not-inverted", "this is sigma^2 J^T J: the larger J the surer, so it is inverted",
     "without the inverse", {"turned": lambda N: N}),
    ("diagonal-inverted", "each entry of J^T J's diagonal is inverted alone",
     "with 1 / the diagonal", {"turned": lambda N: np.diag(1 / np.diag(N))}),
    ("entries-inverted", "each entry of J^T J is inverted alone, as by 1 / or ** -1",
     "with 1 / each entry", {"turned": lambda N: 1 / N}),
    ("mean-over-points", "it is multiplied by the number of pixels, or J^T J is a mean "
     "over them; each further pixel makes the pose surer", "the right one times 2 n",
     {"share": lambda n: n}),
    ("mean-over-points", "it is multiplied by the number of points, or J^T J is a mean "
     "over them; each further point makes the pose surer", "the right one times n",
     {"share": lambda n: n / 2}),
    ("divided-by-points", "it is divided by the number of points; J^T J adds them up "
     "already", "the right one / n", {"share": lambda n: 2 / n}),
    ("divided-by-points", "it is divided by the number of pixels; J^T J adds them up "
     "already", "the right one / (2 n)", {"share": lambda n: 1 / n}),
    ("reshaped-across", "J is reshaped to (6, 2 n), which only counts its numbers off "
     "anew; it has a row per number of a pixel, (2 n, 6)", "with J.reshape(6, -1)",
     {"rows": lambda J: J.reshape(6, -1).T}),
    ("u-alone", "only the rows of u are used; v shows as much", "with J[:, 0]",
     {"rows": lambda J: J[:, 0]}),
    ("v-alone", "only the rows of v are used; u shows as much", "with J[:, 1]",
     {"rows": lambda J: J[:, 1]}),
    ("sigma-for-variance", "these are roots of the entries: a covariance has squares, "
     "rad^2", "with roots", {"told": root}),
    ("sigma-for-variance", "these are roots of the entries: a covariance has squares, "
     "rad^2", "with np.sqrt, which has no root of what is below 0, ",
     {"told": np.sqrt}),
    ("halves-swapped", "the blocks are those of (v; omega); here omega comes first",
     "with its blocks swapped", {"told": lambda C: C[HALF][:, HALF]}),
    ("diagonal-only", "only the diagonal is there; how the six go together is lost",
     "its diagonal", {"told": lambda C: np.diag(np.diag(C))}),
):  # fmt: skip
    row.wrong(slug, says, redone)(partial(covariance, **other))


@row.wrongs
def _(J, sigma):
    """information: this is the information, J^T J / sigma^2; the covariance is its
      inverse
    by-what-is-left: it is divided by 2 n - 6, the numbers that are left over; that
      belongs to a sigma that is not known
    each-point-alone: each point's covariance is made, and they are added up; what adds
      up is what the points tell, J^T J
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
    "NumPy takes any size below 0 for what is left",
)


@row.right  # By the pseudo-inverse: what lstsq does to the noise, twice.
def _(J, sigma):
    P = np.linalg.pinv(J.reshape(-1, 6))
    return P @ (sigma**2 * np.eye(P.shape[1])) @ P.T


row.spans(  # as small, or as large, as in the lab
    J=(lambda J: 8 * J,),
)
