"""8.6 `truncated_svd_fit(Y, tau, rtol)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding
from robo47.identification import truncated_svd_fit

from .rank_and_condition import miscounted
from .states import CUT, hidden, regressors, spread, stairs, uneven


def of_the_values(case: Case) -> Finding | None:
    """Say which singular values count, or that all are damped, where that is all."""
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
        if np.abs(lacks).max() > 1e-9:  # else it is too little to show
            added.append(s[sound] ** 2 * lacks)
    if cut:
        says = miscounted(more, fewer, f"of {len(case.S)} calls")
        return Finding("cut-elsewhere", says)
    if all(one[-1] > 0 and np.allclose(one, one[-1], rtol=0.1) for one in added):
        says = f"up to {max(one[-1] for one in added):.3g} is added to the diagonal of "
        return Finding("ridge", f"Every parameter is pulled towards 0: {says}Y^T Y.")
    return columns_left_out(case) or not_the_smallest(case)


def columns_left_out(case: Case) -> Finding | None:
    """Say that whole parameters are 0 where there are values that do not count."""
    count = 0
    for Y, rtol, mine in zip(case.arguments[0], case.arguments[2], case.S, strict=True):
        hides = Y.shape[1] - len(parts(Y, rtol)[1])
        empty = int(np.sum(mine[: Y.shape[1]] == 0.0))
        if (empty > 0) != (hides > 0):
            return None
        count += hides
    if not count:
        return None
    says = (
        "Whole parameters are 0 wherever a value does not count. What a motion hides "
    )
    says += "is a combination of several, and the smallest answer has a part of each."
    return Finding("columns-left-out", says)


def not_the_smallest(case: Case) -> Finding | None:
    """Say that an answer explains the torques as well, but is longer."""
    longest = 0.0
    for Y, tau, mine, its in zip(*case.arguments[:2], case.S, case.T, strict=True):
        S, T = mine[: Y.shape[1]], its[: Y.shape[1]]
        left, least = (np.linalg.norm(tau - Y @ phi) for phi in (S, T))
        ratio = np.linalg.norm(S) / np.linalg.norm(T)
        if left > 1.01 * least + 1e-9 * np.linalg.norm(tau) or ratio < 1 - 1e-9:
            return None
        longest = max(longest, ratio)
    says = "It explains the torques as well as the right one, but is not the smallest "
    says += f"that does: up to {longest:.3g} times as long. What the motion does not "
    return Finding("not-the-smallest", says + "show has to be 0.")


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
    """Return the matrices: what counts, just counts, or just does not."""
    near = [uneven(rng, 5.0), uneven(rng, 8.0), uneven(rng, 3.0), stairs(rng)]
    return [*near, *regressors(rng, 3), *spread(rng, 2), *regressors(rng, 3)]


def scaled(rng, Y):
    """Return torques of the size that parameters of about 1 make, and some noise."""
    size = np.linalg.norm(Y, 2)
    return Y @ rng.numbers(-2, 2, 6) + size * rng.numbers(-0.1, 0.1, len(Y))


def above(Y, tau, limit):
    """Return the fit with the values above a limit, 0 where there are none."""
    U, s, Vt = np.linalg.svd(Y, full_matrices=False)
    kept = s > limit
    return Vt[kept].T @ (U[:, kept].T @ tau / s[kept])


def parts(Y, rtol):
    """Return U, s and V^T of the values that count."""
    U, s, Vt = np.linalg.svd(Y, full_matrices=False)
    kept = s > rtol * s[0]
    return U[:, kept], s[kept], Vt[kept]


@row.wrongs
def _(Y, tau, rtol):
    """nothing-cut: small values are kept as well: what the motion does not show is made
      up of noise, and large => the right one with nothing cut
    rtol-absolute: a value is compared with rtol itself; it counts above rtol times the
      largest => the right one with rtol absolute
    cut-by-the-sum: a value is compared with rtol times the sum of all; it counts above
      rtol times the largest => the right one with the sum
    cut-by-the-norm: a value is compared with rtol times the norm of Y, the root of the
      sum of squares; it counts above rtol times the largest => the right one with
      that norm
    cut-by-rows: a value is compared with rtol times the number of rows times the
      largest, as NumPy does with its own eps; rtol is the whole of it here => the right
      one with rtol times the rows
    V-for-its-transpose: numpy.linalg.svd returns V^T; here it is taken for V => V for
      V^T
    cut-not-squared: the cut is made on eigenvalues of Y^T Y, which are squares, and is
      not squared => the right one with rtol's square root
    ridge: something is added to the diagonal of Y^T Y: every parameter is pulled
      towards 0, also what the motion shows => (Y^T Y + 1)^-1 Y^T tau
    mean-taken-off: the mean of tau is taken off first, as in statistics; no torque is
      lost so => the fit to what is left
    times-s: it is multiplied by the singular values; Y = U S V^T is undone by dividing,
      and Y^T tau alone is no solution => V S U^T tau
    first-columns: only the first columns are fitted, as many as the rank; which ones
      hide one another is not known by their place => the first columns alone, 0 for the
      rest
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


@row.right  # The pseudo-inverse of Y^T Y, cut at the square.
def _(Y, tau, rtol):
    return np.linalg.pinv(Y.T @ Y, rcond=max(rtol, 1e-7) ** 2) @ (Y.T @ tau)
