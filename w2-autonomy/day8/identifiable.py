"""8.5 `identifiable(Y, rtol)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Count, Scalar
from labkit.judge.row import Row

from .states import CUT, regressors

row = Row((Count(called="the rank"), Scalar(called="the condition")))
CASE = np.array([[1.0, 1.0], [2.0, 2.0]])


@row.inputs
def _(rng):
    even = [(Y[:, :k], CUT) for k, Y in zip((1, 2, 3), regressors(rng, 3), strict=True)]
    return [(CASE, 1e-9), *even, *((Y, CUT) for Y in regressors(rng))]


def values(Y):
    """Return the singular values."""
    return np.linalg.svd(Y, compute_uv=False)


@row.wrong
def rtol_absolute(Y, rtol):
    """a value is compared with rtol itself; it counts above rtol times the largest, or
    newtons and millinewtons would have another rank => the right one with rtol
    absolute"""
    s = values(Y)
    rank = np.sum(s > rtol)
    return rank, s[0] / s[rank - 1]


@row.wrong
def condition_of_all(Y, rtol):
    """the condition is that of all values; those that do not count are only rounding,
    so it ends at the last that does => the largest over the smallest of all"""
    s = values(Y)
    return np.sum(s > rtol * s[0]), s[0] / max(s[-1], 1e-300)


@row.wrong
def nothing_cut(Y, rtol):
    """every value counts, so rtol is not used => the number of values, the largest over
    the smallest"""
    s = values(Y)
    return len(s), s[0] / max(s[-1], 1e-300)


@row.wrong
def cut_not_squared(Y, rtol):
    """these are eigenvalues of Y^T Y, squares of singular values; the cut has to be
    squared, too => the right one with rtol's square root"""
    s = values(Y)
    kept = s[s**2 > rtol * s[0] ** 2]
    return len(kept), kept[0] / kept[-1]


@row.wrong
def condition_squared(Y, rtol):
    """the condition is that of Y^T Y, the square of the one of Y => its square"""
    s = values(Y)
    kept = s[s > rtol * s[0]]
    return len(kept), (kept[0] / kept[-1]) ** 2


@row.wrong
def condition_inverted(Y, rtol):
    """the condition is upside down: it is 1 or more => smallest over largest"""
    s = values(Y)
    kept = s[s > rtol * s[0]]
    return len(kept), kept[-1] / kept[0]


@row.wrong
def hidden_counted(Y, rtol):
    """this counts what cannot be seen; the rank is what can => the number of columns
    less the rank"""
    s = values(Y)
    kept = s[s > rtol * s[0]]
    return Y.shape[1] - len(kept), kept[0] / kept[-1]


@row.wrong
def condition_of_the_cut(Y, rtol):
    """the condition is 1 / rtol: it is what the motion shows, not what you allow => 1 /
    rtol"""
    s = values(Y)
    return np.sum(s > rtol * s[0]), 1.0 / rtol


@row.right  # By the eigenvalues of Y^T Y, the cut squared too.
def _(Y, rtol):
    s2 = np.linalg.eigvalsh(Y.T @ Y)[::-1]
    kept = s2[s2 > max(rtol, 1e-7) ** 2 * s2[0]]
    return len(kept), np.sqrt(kept[0] / kept[-1])


@row.right  # NumPy's own rank, and norms.
def _(Y, rtol):
    rank = np.linalg.matrix_rank(Y, tol=rtol * np.linalg.norm(Y, 2))
    return rank, np.linalg.norm(Y, 2) / values(Y)[rank - 1]
