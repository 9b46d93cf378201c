"""8.6 `truncated_svd_fit(Y, tau, rtol)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.identification import truncated_svd_fit

from .rank_and_condition import miscounted
from .states import CUT, hidden, regressors, spread, stairs, uneven


def of_the_values(case: Case) -> Finding | None:
    """Return which singular values are kept, or that the fit is a ridge regression."""
    more = fewer = 0
    cut = True
    added = []
    for Y, tau, rtol, mine in zip(*case.arguments, case.S, strict=True):
        U, s, Vt = np.linalg.svd(Y, full_matrices=False)
        sound = s > 1e-12 * s[0]
        right = (s > rtol * s[0])[sound]
        share = (Vt @ mine[: Y.shape[1]] * s)[sound] / (U.T @ tau)[sound]
        kept = np.isclose(share, 1.0, rtol=1e-4)
        cut = cut and bool((kept | (np.abs(share) < 1e-4)).all())
        more += int((kept & ~right).any())
        fewer += int((~kept & right).any())
        lacks = 1.0 / np.where(share, share, 1e-9) - 1.0
        if np.abs(lacks).max() > 1e-9:  # else it is too small to be measured
            added.append(s[sound] ** 2 * lacks)
    if cut:
        says = miscounted(more, fewer, f"of {len(case.S)} calls")
        return Finding("cut-elsewhere", says)
    if all(one[-1] > 0 and np.allclose(one, one[-1], rtol=0.1) for one in added):
        most = max(one[-1] for one in added)
        says = f"Your result is a ridge regression, with up to {most:.3g} added to the "
        says += "diagonal of Y^T Y, which shrinks all combinations of parameters."
        return Finding("ridge", says)
    return columns_left_out(case) or not_the_smallest(case)


def columns_left_out(case: Case) -> Finding | None:
    """Return that individual parameters are 0 where singular values are left out."""
    count = 0
    for Y, rtol, mine in zip(case.arguments[0], case.arguments[2], case.S, strict=True):
        hides = Y.shape[1] - len(parts(Y, rtol)[1])
        empty = int(np.sum(mine[: Y.shape[1]] == 0.0))
        if (empty > 0) != (hides > 0):
            return None
        count += hides
    if not count:
        return None
    says = "In your result, individual parameters are 0 whenever Y has small singular "
    says += "values. The data leave combinations of parameters undetermined, and the "
    says += "solution of minimum norm distributes each of them over several parameters."
    return Finding("columns-left-out", says)


def not_the_smallest(case: Case) -> Finding | None:
    """Return that an answer has the same residual, but a larger norm."""
    longest = 0.0
    for Y, tau, mine, its in zip(*case.arguments[:2], case.S, case.T, strict=True):
        S, T = mine[: Y.shape[1]], its[: Y.shape[1]]
        left, least = (np.linalg.norm(tau - Y @ phi) for phi in (S, T))
        ratio = np.linalg.norm(S) / np.linalg.norm(T)
        if left > 1.01 * least + 1e-9 * np.linalg.norm(tau) or ratio < 1 - 1e-9:
            return None
        longest = max(longest, ratio)
    says = "In all calls that were tried, the residual of your parameters is at most 1 "
    says += "% larger than that of the correct ones, but their norm is up to "
    says += f"{longest:.3g} times as large. A combination that the data do not "
    says += "determine should be 0 in your result."
    return Finding("not-the-smallest", says)


row = Row(Vector((None,)), unnamed=of_the_values, unnamed_names=True)
row.at_least_0(rtol="a tolerance")
CASE = np.array([[1.0, 1.0], [2.0, 2.0]]), np.array([2.0, 4.0]), 1e-9


@row.inputs
def _(rng):
    exact = hidden(rng)
    return [
        CASE,
        (exact, scaled(rng, exact), 1e-9),
        *((Y, scaled(rng, Y), CUT) for Y in asked(rng)),
    ]


def asked(rng):
    """Return matrices with singular values near the limit, and with others."""
    near = [uneven(rng, 5.0), uneven(rng, 8.0), uneven(rng, 3.0), stairs(rng)]
    return [*near, *regressors(rng, 3), *spread(rng, 2), *regressors(rng, 3)]


def scaled(rng, Y):
    """Return torques of parameters of about 1, with some noise."""
    size = np.linalg.norm(Y, 2)
    return Y @ rng.numbers(-2, 2, 6) + size * rng.numbers(-0.1, 0.1, len(Y))


def above(Y, tau, limit):
    """Return the fit with the singular values above a limit; 0 if there are none."""
    U, s, Vt = np.linalg.svd(Y, full_matrices=False)
    kept = s > limit
    return Vt[kept].T @ (U[:, kept].T @ tau / s[kept])


def parts(Y, rtol):
    """Return U, s and V^T of the singular values that are kept."""
    U, s, Vt = np.linalg.svd(Y, full_matrices=False)
    kept = s > rtol * s[0]
    return U[:, kept], s[kept], Vt[kept]


@row.wrongs
def _(Y, tau, rtol):
    """nothing-cut: your code uses all singular values. Omit the singular values below
      rtol times the largest one, because noise dominates the corresponding combinations
      of parameters
    rtol-absolute: your code compares the singular values with rtol itself. Use rtol
      times the largest singular value as the limit instead
    cut-by-the-sum: your code compares the singular values with rtol times their sum.
      Use rtol times the largest singular value as the limit instead
    cut-by-the-norm: your code compares the singular values with rtol times the
      Frobenius norm of Y. Use rtol times the largest singular value as the limit
      instead
    cut-by-rows: your function multiplies rtol by the number of rows, as NumPy does with
      its default tolerance. Use rtol times the largest singular value as the limit
      instead
    V-for-its-transpose: your result contains V^T in the place of V, whose columns are
      the right singular vectors. The third result of numpy.linalg.svd, for example, is
      V^T
    cut-not-squared: your limit of the singular values is sqrt(rtol) times the largest
      one, as if rtol were the limit of the eigenvalues of Y^T Y. Use rtol times the
      largest singular value, which corresponds to rtol^2 times the largest of these
      eigenvalues
    ridge: your result is a ridge regression, with a constant added to the diagonal of
      Y^T Y, which shrinks the estimates of all combinations of parameters. Omit the
      small singular values instead, so that the estimates of the other combinations do
      not shrink
    mean-taken-off: your result is the fit to tau minus its mean. Use tau unchanged,
      because the model tau = Y phi has no constant term
    times-s: your result multiplies U^T tau by the singular values, as in Y^T tau.
      Divide U^T tau by the singular values instead, as in the pseudo-inverse of Y
    first-columns: your code fits only the first r columns of Y, where r is the rank.
      These columns need not be linearly independent, so use all columns and the SVD
    """
    U, s, Vt = parts(Y, rtol)
    _, every, turned = np.linalg.svd(Y, full_matrices=False)
    p = Y.shape[1]
    first = np.linalg.lstsq(Y[:, : len(s)], tau, rcond=None)[0]
    return {
        "nothing-cut": truncated_svd_fit(Y, tau, 1e-12),
        "rtol-absolute": above(Y, tau, rtol),
        "cut-by-the-sum": truncated_svd_fit(Y, tau, rtol * every.sum() / every[0]),
        "cut-by-the-norm": truncated_svd_fit(
            Y, tau, rtol * np.linalg.norm(every) / every[0]
        ),
        "cut-by-rows": above(Y, tau, rtol * max(Y.shape) * every[0]),
        "V-for-its-transpose": turned[:, : len(s)] @ (U.T @ tau / s),
        "cut-not-squared": truncated_svd_fit(Y, tau, np.sqrt(rtol)),
        "ridge": np.linalg.solve(Y.T @ Y + np.eye(p), Y.T @ tau),
        "times-s": Vt.T @ (s * (U.T @ tau)),
        "mean-taken-off": truncated_svd_fit(Y, tau - tau.mean(), rtol),
        "first-columns": np.pad(first, (0, p - len(s))),
    }


@row.right  # The pseudo-inverse of Y^T Y, with the square of rtol.
def _(Y, tau, rtol):
    return np.linalg.pinv(Y.T @ Y, rcond=max(rtol, 1e-7) ** 2) @ (Y.T @ tau)
