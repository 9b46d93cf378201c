"""8.5 `rank_and_condition(Y, rtol)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Count, Row, Scalar
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding

from .states import CUT, hidden, regressors, spread, stairs, steep, uneven


def of_what_counts(case: Case) -> Finding | None:
    """Return which singular values are counted, if the condition is a ratio of two."""
    ranks, conditions = case.S
    if np.allclose(conditions, case.T[1], rtol=1e-6):
        off = np.sum(ranks != case.T[0])
        return Finding(
            "rank-off",
            "The condition number is correct, but the rank is wrong in "
            f"{off} of {len(ranks)} calls. The rank is the number of singular values "
            "above rtol times the largest one.",
        )
    more = fewer = other = dust = 0
    for Y, n, right, condition in zip(
        case.arguments[0], ranks, case.T[0], conditions, strict=True
    ):
        s = np.linalg.svd(Y, compute_uv=False)
        if not 0 <= n <= len(s):
            return None  # it is not a number of singular values
        if n > right and s[int(n) - 1] < 1e-12 * s[0]:
            dust += 1
            continue
        its = s[0] / np.maximum(s, 1e-300)
        sound = its < 1e12  # above, a singular value is a rounding error
        k = 1 + int(np.argmin(np.abs(its - condition)))
        if sound[k - 1] and not np.isclose(its[k - 1], condition, rtol=1e-6):
            return None  # it is not a ratio of two singular values
        more += int(n > right)
        fewer += int(n < right)
        other += int(k != n)
    calls = f"of {len(ranks)} calls"
    if dust and not more and not fewer and not other:
        says = f"Your code counts a rounding error as a singular value in {dust} "
        says += f"{calls}. Square roots of the eigenvalues of Y^T Y have rounding "
        says += "errors of about 1e-8 times the largest singular value. With "
        says += "numpy.linalg.svd, the errors are only about 1e-16 times this value."
        return Finding("rounding-counts", says)
    if dust:
        return None
    if not more and not fewer:
        says = f"The rank is correct. In {other} {calls}, the condition number does "
        says += "not use the smallest singular value that the rank counts."
        return Finding("condition-of-all", says)
    says = miscounted(more, fewer, calls)
    if not other:
        says += " The condition number uses the smallest value that the rank counts."
    return Finding("cut-elsewhere", says)


def miscounted(more: int, fewer: int, calls: str) -> str:
    """Return in how many calls the wrong singular values are counted."""
    parts = [f"too many singular values in {more} {calls}"] * (more > 0)
    parts += [f"too few singular values in {fewer} {calls}"] * (fewer > 0)
    says = f"Your code counts {' and '.join(parts)}. "
    return f"{says}Count the values above rtol times the largest one."


def chained(s, rtol):
    """Return how many singular values stand before the first large gap."""
    gaps = s[1:] <= rtol * s[:-1]
    return int(np.argmax(gaps)) + 1 if gaps.any() else len(s)


KIND = Count(called="the rank"), Scalar(called="the condition number")
row = Row(KIND, unnamed=of_what_counts, unnamed_names=True)
row.at_least_0(rtol="a tolerance", answer="a count, and a ratio of norms")
CASE = np.array([[1.0, 1.0], [2.0, 2.0]])
HIDDEN = {
    "cut-by-the-one-before": "no singular value of the lab is just below the limit",
}


@row.inputs
def _(rng):
    even = [(Y[:, :k], CUT) for k, Y in zip((1, 2, 3), regressors(rng, 3), strict=True)]
    exact = (hidden(rng), 1e-9)  # by Y^T Y its zeros are 1e-8 of the largest
    near = [(Y, CUT) for Y in (uneven(rng, 5.0), uneven(rng, 8.0), stairs(rng))]
    near.append((steep(rng), CUT))
    drawn = [*regressors(rng), *spread(rng)]
    return [(CASE, 1e-9), exact, *near, *even, *((Y, CUT) for Y in drawn)]


for slug, says, told in (
    ("rtol-absolute",
     "your code compares the singular values with rtol itself. Use rtol times the "
     "largest singular value as the limit instead, because otherwise the rank depends "
     "on the unit",
     lambda s, rtol: (n := np.sum(s > rtol), s[0] / s[n - 1])),
    ("condition-of-all",
     "your code divides the largest singular value by the smallest of all singular "
     "values. Divide by the smallest singular value above rtol times the largest one "
     "instead",
     lambda s, rtol: (np.sum(s > rtol * s[0]), s[0] / max(s[-1], 1e-300))),
    ("nothing-cut",
     "your code counts all singular values, so rtol has no effect. Count only the "
     "singular values above rtol times the largest one",
     lambda s, rtol: (len(s), s[0] / max(s[-1], 1e-300))),
    ("cut-by-the-sum",
     "your code compares the singular values with rtol times their sum. Use rtol times "
     "the largest singular value as the limit instead",
     lambda s, rtol: (n := np.sum(s > rtol * s.sum()), s[0] / s[n - 1])),
    ("cut-by-the-norm",
     "your code compares the singular values with rtol times the Frobenius norm of Y. "
     "Use rtol times the largest singular value as the limit instead",
     lambda s, rtol: (n := np.sum(s > rtol * np.linalg.norm(s)), s[0] / s[n - 1])),
    ("cut-by-rows",
     "your function multiplies rtol by the number of rows, as NumPy does with its "
     "default tolerance. Use rtol times the largest singular value as the limit "
     "instead",
     lambda s, rtol, m: (n := np.sum(s > rtol * m * s[0]), s[0] / s[n - 1])),
    ("cut-by-the-one-before",
     "your code compares each singular value with rtol times the one before it. Use "
     "rtol times the largest singular value as the limit instead",
     lambda s, rtol: (n := chained(s, rtol), s[0] / s[n - 1])),
    ("rtol-not-used",
     "your code uses a constant as the tolerance. Use the argument `rtol` instead",
     lambda s, rtol: (n := np.sum(s > 1e-9 * s[0]), s[0] / s[n - 1])),
    ("eigenvalues-of-the-square",
     "your result uses the squares of the singular values, which are the eigenvalues "
     "of Y^T Y. Use the singular values of Y themselves",
     lambda s, rtol: (n := np.sum(s**2 > rtol * s[0] ** 2), (s[0] / s[n - 1]) ** 2)),
    ("cut-not-squared",
     "your limit of the singular values is sqrt(rtol) times the largest one, as if "
     "rtol were the limit of the eigenvalues of Y^T Y. Use rtol times the largest "
     "singular value, which corresponds to rtol^2 times the largest of these "
     "eigenvalues",
     lambda s, rtol: (n := np.sum(s**2 > rtol * s[0] ** 2), s[0] / s[n - 1])),
    ("hidden-for-shown",
     "your code counts the singular values below rtol times the largest one. Count the "
     "singular values above this limit instead",
     lambda s, rtol: (len(s) - (n := np.sum(s > rtol * s[0])), s[0] / s[n - 1])),
    ("condition-squared",
     "your code returns the square of the condition number, which is the condition "
     "number of Y^T Y. Return the ratio of the singular values of Y instead",
     lambda s, rtol: (n := np.sum(s > rtol * s[0]), (s[0] / s[n - 1]) ** 2)),
    ("condition-rooted",
     "your code takes the square root of the ratio of two singular values. Use the "
     "ratio itself, because only the eigenvalues of Y^T Y need a square root",
     lambda s, rtol: (n := np.sum(s > rtol * s[0]), np.sqrt(s[0] / s[n - 1]))),
    ("condition-inverted",
     "your code divides the smallest singular value above the limit by the largest "
     "one. Divide the largest one by this value instead, so that the condition number "
     "is at least 1",
     lambda s, rtol: (n := np.sum(s > rtol * s[0]), s[n - 1] / s[0])),
):  # fmt: skip
    row.wrong(slug, says, HIDDEN.get(slug, ""))(
        lambda Y, rtol, told=told: told(
            np.linalg.svd(Y, compute_uv=False),
            rtol,
            *[max(Y.shape)] * (told.__code__.co_argcount == 3),
        )
    )


@row.wrongs
def _(Y, rtol):
    """columns-scaled: your code first divides the columns of Y by their norms, which
      changes the singular values. Use Y itself instead
    columns-centred: your code first subtracts the mean of each column of Y. Use Y
      itself instead, because the model tau = Y phi has no constant term
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


@row.right  # By the eigenvalues of Y^T Y, with the square of rtol.
def _(Y, rtol):
    s2 = np.linalg.eigvalsh(Y.T @ Y)[::-1]
    kept = s2[s2 > max(rtol, 1e-7) ** 2 * s2[0]]
    return len(kept), np.sqrt(kept[0] / kept[-1])
