"""8.5 `rank_and_condition(Y, rtol)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Count, Row, Scalar
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding

from .states import CUT, hidden, regressors, spread, stairs, uneven


def of_what_counts(case: Case) -> Finding | None:
    """Say which values count, where the condition is that of some of Y's values."""
    ranks, conditions = case.S
    if np.allclose(conditions, case.T[1], rtol=1e-6):
        off = np.sum(ranks != case.T[0])
        says = (
            f"The condition is right; the rank is not, in {off} of {len(ranks)} calls."
        )
        return Finding("rank-off", f"{says} It is the number of values that count.")
    more = fewer = other = dust = 0
    for Y, n, right, condition in zip(
        case.arguments[0], ranks, case.T[0], conditions, strict=True
    ):
        s = np.linalg.svd(Y, compute_uv=False)
        if not 0 <= n <= len(s):
            return None  # it is no number of these values
        if n > right and s[int(n) - 1] < 1e-12 * s[0]:
            dust += 1
            continue
        its = s[0] / np.maximum(s, 1e-300)
        sound = its < 1e12  # above, a value is rounding
        k = 1 + int(np.argmin(np.abs(its - condition)))
        if sound[k - 1] and not np.isclose(its[k - 1], condition, rtol=1e-6):
            return None  # it is no quotient of two values
        more += int(n > right)
        fewer += int(n < right)
        other += int(k != n)
    calls = f"of {len(ranks)} calls"
    if dust and not more and not fewer and not other:
        says = f"Rounding counts as a value in {dust} {calls}. Are the values roots of "
        says += "eigenvalues of Y^T Y? Their rounding is 1e-8 of the largest, that of "
        return Finding("rounding-counts", says + "svd is 1e-16.")
    if dust:
        return None
    if not more and not fewer:
        says = f"The rank is right, but in {other} {calls} the condition does not end "
        return Finding("condition-of-all", says + "at the last value that counts.")
    says = miscounted(more, fewer, calls)
    says += "" if other else " The condition ends at the last that you count."
    return Finding("cut-elsewhere", says)


def miscounted(more: int, fewer: int, calls: str) -> str:
    """Return in how many calls other values count than do."""
    parts = [f"too many values count in {more} {calls}"] * (more > 0)
    parts += [f"too few values count in {fewer} {calls}"] * (fewer > 0)
    says = f"{', and '.join(parts)}: one counts if it is above rtol times the largest."
    return says[0].upper() + says[1:]


KIND = Count(called="the rank"), Scalar(called="the condition")
row = Row(KIND, unnamed=of_what_counts, unnamed_names=True)
row.at_least_0(rtol="a tolerance", answer="a count, a quotient of lengths")
CASE = np.array([[1.0, 1.0], [2.0, 2.0]])


@row.inputs
def _(rng):
    even = [(Y[:, :k], CUT) for k, Y in zip((1, 2, 3), regressors(rng, 3), strict=True)]
    exact = (hidden(rng), 1e-9)  # squared, its zeros are 1e-8 of the largest
    near = [(Y, CUT) for Y in (uneven(rng, 5.0), uneven(rng, 8.0), stairs(rng))]
    drawn = [*regressors(rng), *spread(rng)]
    return [(CASE, 1e-9), exact, *near, *even, *((Y, CUT) for Y in drawn)]


for slug, says, redone, told in (
    ("rtol-absolute", "a value is compared with rtol itself; it counts above rtol "
     "times the largest, or newtons and millinewtons would have another rank",
     "the right one with rtol absolute",
     lambda s, rtol: (n := np.sum(s > rtol), s[0] / s[n - 1])),
    ("condition-of-all", "the condition is that of all values; those that do not count "
     "are only rounding, so it ends at the last that does",
     "the largest over the smallest of all",
     lambda s, rtol: (np.sum(s > rtol * s[0]), s[0] / max(s[-1], 1e-300))),
    ("nothing-cut", "every value counts, so rtol is not used",
     "the number of values, the largest over the smallest",
     lambda s, rtol: (len(s), s[0] / max(s[-1], 1e-300))),
    ("cut-by-the-sum", "a value is compared with rtol times the sum of all; it counts "
     "above rtol times the largest", "the right one with the sum",
     lambda s, rtol: (n := np.sum(s > rtol * s.sum()), s[0] / s[n - 1])),
    ("cut-by-the-norm", "a value is compared with rtol times the norm of Y, the root "
     "of the sum of squares; it counts above rtol times the largest",
     "the right one with that norm",
     lambda s, rtol: (n := np.sum(s > rtol * np.linalg.norm(s)), s[0] / s[n - 1])),
    ("cut-by-rows", "a value is compared with rtol times the number of rows times the "
     "largest, as NumPy does with its own eps; rtol is the whole of it here",
     "the right one with rtol times the rows",
     lambda s, rtol, m: (n := np.sum(s > rtol * m * s[0]), s[0] / s[n - 1])),
    ("rtol-not-used", "the cut is a fixed one; rtol is an argument, and the lab asks "
     "with another one", "the right one with 1e-9 for rtol",
     lambda s, rtol: (n := np.sum(s > 1e-9 * s[0]), s[0] / s[n - 1])),
    ("eigenvalues-of-the-square", "these are eigenvalues of Y^T Y; the singular values "
     "of Y are their roots", "the right one with squares all along",
     lambda s, rtol: (n := np.sum(s**2 > rtol * s[0] ** 2), (s[0] / s[n - 1]) ** 2)),
    ("cut-not-squared", "these are eigenvalues of Y^T Y, squares of singular values; "
     "the cut has to be squared, too", "the right one with rtol's square root",
     lambda s, rtol: (n := np.sum(s**2 > rtol * s[0] ** 2), s[0] / s[n - 1])),
    ("hidden-for-shown", "the rank is the number of combinations that are hidden; it "
     "is that of those that show", "the number of columns less the rank",
     lambda s, rtol: (len(s) - (n := np.sum(s > rtol * s[0])), s[0] / s[n - 1])),
    ("condition-squared", "the condition is that of Y^T Y, the square of the one of Y",
     "its square",
     lambda s, rtol: (n := np.sum(s > rtol * s[0]), (s[0] / s[n - 1]) ** 2)),
    ("condition-rooted", "the condition is the root of the quotient; singular values "
     "are lengths already, and no root is left to take", "its root",
     lambda s, rtol: (n := np.sum(s > rtol * s[0]), np.sqrt(s[0] / s[n - 1]))),
    ("condition-inverted", "the condition is upside down: it is 1 or more",
     "smallest over largest",
     lambda s, rtol: (n := np.sum(s > rtol * s[0]), s[n - 1] / s[0])),
):  # fmt: skip
    row.wrong(slug, says, redone)(
        lambda Y, rtol, told=told: told(
            np.linalg.svd(Y, compute_uv=False),
            rtol,
            *[max(Y.shape)] * (told.__code__.co_argcount == 3),
        )
    )


@row.wrongs
def _(Y, rtol):
    """columns-scaled: each column is divided by its length first; that asks about other
      parameters => with columns of length 1
    columns-centred: each column's mean is taken off first, as in statistics; no torque
      is lost so => with the means taken off
    """
    return {
        "columns-scaled": counted(Y / np.linalg.norm(Y, axis=0), rtol),
        "columns-centred": counted(Y - Y.mean(axis=0), rtol),
    }


def counted(Y, rtol):
    """Return rank and condition."""
    s = np.linalg.svd(Y, compute_uv=False)
    n = np.sum(s > rtol * s[0])
    return n, s[0] / s[n - 1]


@row.right  # By the eigenvalues of Y^T Y, the cut squared too.
def _(Y, rtol):
    s2 = np.linalg.eigvalsh(Y.T @ Y)[::-1]
    kept = s2[s2 > max(rtol, 1e-7) ** 2 * s2[0]]
    return len(kept), np.sqrt(kept[0] / kept[-1])
