"""8.5 `identifiable(Y, rtol)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Count, Row, Scalar
from labkit.judge.ask import Case
from labkit.judge.mistake import Finding

from .states import CUT, hidden, regressors, uneven


def of_dust(case: Case) -> Finding | None:
    """Ask whether values that do not count are in the answer: those are rounding."""
    if (case.S[1] <= 1.0 / case.arguments[1]).all():
        return None
    if all(n == Y.shape[1] for n, Y in zip(case.S[0], case.arguments[0], strict=True)):
        return Finding("nothing-cut", "Every value counts: is rtol used at all?")
    says = "The condition is over 1 / rtol: does it end at a value that does not count?"
    return Finding("condition-of-all", says)


row = Row((Count(called="the rank"), Scalar(called="the condition")), unnamed=of_dust)
CASE = np.array([[1.0, 1.0], [2.0, 2.0]])


@row.inputs
def _(rng):
    even = [(Y[:, :k], CUT) for k, Y in zip((1, 2, 3), regressors(rng, 3), strict=True)]
    exact = (hidden(rng), 1e-9)  # squared, its zeros are 1e-8 of the largest
    near = [(uneven(rng, fifth), CUT) for fifth in (5.0, 8.0)]
    return [(CASE, 1e-9), exact, *near, *even, *((Y, CUT) for Y in regressors(rng))]


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
    ("cut-not-squared", "these are eigenvalues of Y^T Y, squares of singular values; "
     "the cut has to be squared, too", "the right one with rtol's square root",
     lambda s, rtol: (n := np.sum(s**2 > rtol * s[0] ** 2), s[0] / s[n - 1])),
    ("condition-squared", "the condition is that of Y^T Y, the square of the one of Y",
     "its square",
     lambda s, rtol: (n := np.sum(s > rtol * s[0]), (s[0] / s[n - 1]) ** 2)),
    ("condition-inverted", "the condition is upside down: it is 1 or more",
     "smallest over largest",
     lambda s, rtol: (n := np.sum(s > rtol * s[0]), s[n - 1] / s[0])),
):  # fmt: skip
    row.wrong(slug, says, redone)(
        lambda Y, rtol, told=told: told(np.linalg.svd(Y, compute_uv=False), rtol)
    )


@row.right  # By the eigenvalues of Y^T Y, the cut squared too.
def _(Y, rtol):
    s2 = np.linalg.eigvalsh(Y.T @ Y)[::-1]
    kept = s2[s2 > max(rtol, 1e-7) ** 2 * s2[0]]
    return len(kept), np.sqrt(kept[0] / kept[-1])
